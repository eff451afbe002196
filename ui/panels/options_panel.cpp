#include "ui/panels/options_panel.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/options/option_text.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

QString TipOf(const OptionRow& row) {
  return OptionsPanel::tr("%1\nUsual: %2. On the command line: %3")
      .arg(OptionsModel::tr(row.info.help.c_str()),
           row.info.type == OptionType::kDocument
               ? OptionsModel::tr(row.info.automatic.c_str())
               : QString::fromStdString(OptionText(row.info, row.usual)),
           QString::fromStdString(row.info.flag));
}

/// Rows of one group stand together, groups in the order in which they come first.
std::vector<OptionRow> ByGroup(std::vector<OptionRow> rows) {
  std::vector<std::string> groups;
  for (const OptionRow& row : rows)
    if (std::find(groups.begin(), groups.end(), row.info.group) == groups.end())
      groups.push_back(row.info.group);
  const auto place = [&groups](const OptionRow& row) {
    return std::find(groups.begin(), groups.end(), row.info.group) - groups.begin();
  };
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const OptionRow& a, const OptionRow& b) { return place(a) < place(b); });
  return rows;
}

}  // namespace

OptionsForm::OptionsForm(OptionsModel* model, QWidget* parent)
    : QWidget(parent),
      model_(model),
      title_(new QLabel),
      reset_(new QPushButton(tr("Usual values"))) {
  model->setParent(this);
  title_->setObjectName(QStringLiteral("sectionTitle"));
  title_->setWordWrap(true);
  reset_->setToolTip(tr("Take back every change of these options"));
  connect(reset_, &QPushButton::clicked, model, &OptionsModel::Reset);
  connect(model, &OptionsModel::changed, this, &OptionsForm::ShowRowsInSight);
  auto* head = new QHBoxLayout;
  head->addWidget(title_, 1);
  head->addWidget(reset_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addLayout(head);
  ShowRows();
}

void OptionsForm::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  ShowRows();
}

void OptionsForm::ShowRowsInSight() {
  if (isVisible()) ShowRows();
}

void OptionsForm::ShowRows() {
  const std::vector<OptionRow> rows = ByGroup(model_->Rows());
  title_->setText(model_->Title());
  reset_->setEnabled(
      std::any_of(rows.begin(), rows.end(), [](const OptionRow& row) { return row.Changed(); }));
  const auto same = [](const OptionRow& row, const OptionField* field) {
    return row.info.key == field->Key();
  };
  if (!std::equal(rows.begin(), rows.end(), fields_.begin(), fields_.end(), same)) {
    Build(rows);
    return;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) fields_[i]->Show(rows[i]);
}

void OptionsForm::Build(const std::vector<OptionRow>& rows) {
  // Not at once: a field of the old form may be the one that asked.
  if (form_ != nullptr) {
    form_->hide();
    form_->deleteLater();
  }
  fields_.clear();
  form_ = new QWidget;
  auto* grid = new QGridLayout(form_);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  grid->setColumnStretch(0, 3);
  grid->setColumnStretch(1, 4);
  std::string group;
  int line = 0;
  for (const OptionRow& row : rows) {
    if (row.info.group != group) {
      auto* heading = new QLabel(OptionsModel::tr(row.info.group.c_str()));
      heading->setObjectName(QStringLiteral("faint"));
      grid->addWidget(heading, line++, 0, 1, 2);
      group = row.info.group;
    }
    auto* label = new QLabel(OptionsModel::tr(row.info.title.c_str()));
    label->setWordWrap(true);
    auto* field = new OptionField(model_, row);
    for (QWidget* widget : {static_cast<QWidget*>(label), static_cast<QWidget*>(field)})
      widget->setToolTip(TipOf(row));
    grid->addWidget(label, line, 0, Qt::AlignTop);
    grid->addWidget(field, line++, 1);
    fields_.push_back(field);
  }
  layout()->addWidget(form_);
}

OptionField* OptionsForm::Field(const std::string& key) const {
  const auto at = std::find_if(fields_.begin(), fields_.end(),
                               [&](const OptionField* field) { return field->Key() == key; });
  return at == fields_.end() ? nullptr : *at;
}

OptionsPanel::OptionsPanel(DepthViewModel* depth, FitViewModel* fit, QWidget* parent)
    : QWidget(parent),
      depth_(new OptionsForm(new DepthOptionsModel(depth))),
      fit_(new OptionsForm(new FitOptionsModel(fit))) {
  auto* inner = new QWidget;
  auto* layout = new QVBoxLayout(inner);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(16);
  layout->addWidget(depth_);
  layout->addWidget(fit_);
  layout->addStretch(1);
  FillWithScroll(this, inner);
  setMinimumWidth(200);
}

}  // namespace foresight
