#include "ui/viewmodels/options_model.h"

#include <algorithm>

#include "core/depth/depth_option_table.h"
#include "core/detection/fit_option_table.h"

namespace foresight {
namespace {

template <class T>
std::vector<OptionRow> RowsOf(OptionTable<T> table, const T& options, const T& usual) {
  std::vector<OptionRow> rows;
  for (const Option<T>& option : table)
    if (!option.info.flag.empty() && option.AppliesTo(options))
      rows.push_back({option.info, option.get(options), option.get(usual)});
  return rows;
}

}  // namespace

bool OptionsModel::AnyChanged() const {
  const std::vector<OptionRow> rows = Rows();
  return std::any_of(rows.begin(), rows.end(), [](const OptionRow& row) { return row.Changed(); });
}

DepthOptionsModel::DepthOptionsModel(DepthViewModel* depth, QObject* parent)
    : OptionsModel(parent), depth_(depth) {
  connect(depth, &DepthViewModel::optionsChanged, this, &OptionsModel::changed);
  connect(depth, &DepthViewModel::thresholdChanged, this, &OptionsModel::changed);
}

QString DepthOptionsModel::Title() const {
  return tr("Depth: %1").arg(QString::fromUtf8(InfoOf(depth_->Method()).title));
}

std::vector<OptionRow> DepthOptionsModel::Rows() const {
  return RowsOf(DepthOptionTable(), depth_->Options(), DefaultsOf(depth_->Method()));
}

Status DepthOptionsModel::Set(const std::string& key, const OptionValue& value) {
  return depth_->SetOption(key, value);
}

void DepthOptionsModel::Reset() {
  depth_->resetOptions();
}

FitOptionsModel::FitOptionsModel(FitViewModel* fit, QObject* parent)
    : OptionsModel(parent), fit_(fit) {
  connect(fit, &FitViewModel::changed, this, &OptionsModel::changed);
}

QString FitOptionsModel::Title() const {
  switch (fit_->Kind()) {
    case ObjectKind::kValve:
      return tr("Fit: valve");
    case ObjectKind::kDrill:
      return tr("Fit: drill");
    case ObjectKind::kHandle:
      return tr("Fit: door handle");
    case ObjectKind::kCylinder:
      return tr("Fit: cylinder");
    case ObjectKind::kTerrain:
      break;
  }
  return tr("Fit: terrain");
}

std::vector<OptionRow> FitOptionsModel::Rows() const {
  const ObjectKind kind = fit_->Kind();
  return RowsOf(FitOptionTable(kind), fit_->OptionsFor(kind), fit_->UsualOptionsFor(kind));
}

Status FitOptionsModel::Set(const std::string& key, const OptionValue& value) {
  return fit_->SetOption(key, value);
}

void FitOptionsModel::Reset() {
  fit_->resetOptions();
}

}  // namespace foresight
