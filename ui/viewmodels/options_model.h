#pragma once

#include <QObject>
#include <vector>

#include "core/options/option.h"
#include "ui/viewmodels/depth_view_model.h"
#include "ui/viewmodels/fit_view_model.h"

namespace foresight {

/// One option as a panel shows it.
struct OptionRow {
  OptionInfo info;
  OptionValue value;
  OptionValue usual;  ///< without the operator's doing

  bool Changed() const { return value != usual; }
};

/// The options of one thing as a list that any panel can show: made from the tables in core.
class OptionsModel : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// "Depth: Foresight".
  virtual QString Title() const = 0;
  /// Those that do anything now, in the order of their groups.
  virtual std::vector<OptionRow> Rows() const = 0;
  /// Takes effect at once. Fails with kInvalidOptions or kBadData; nothing is changed then.
  virtual Status Set(const std::string& key, const OptionValue& value) = 0;
  virtual void Reset() = 0;
  bool AnyChanged() const;

 Q_SIGNALS:
  void changed();
};

/// Options of the depth method that is chosen.
class DepthOptionsModel : public OptionsModel {
  Q_OBJECT

 public:
  explicit DepthOptionsModel(DepthViewModel* depth, QObject* parent = nullptr);

  QString Title() const override;
  std::vector<OptionRow> Rows() const override;
  Status Set(const std::string& key, const OptionValue& value) override;
  void Reset() override;

 private:
  DepthViewModel* depth_;
};

/// Options of the next fit of the object that is chosen.
class FitOptionsModel : public OptionsModel {
  Q_OBJECT

 public:
  explicit FitOptionsModel(FitViewModel* fit, QObject* parent = nullptr);

  QString Title() const override;
  std::vector<OptionRow> Rows() const override;
  Status Set(const std::string& key, const OptionValue& value) override;
  void Reset() override;

 private:
  FitViewModel* fit_;
};

}  // namespace foresight
