#pragma once

#include <QWidget>
#include <vector>

#include "ui/panels/option_field.h"
#include "ui/viewmodels/options_model.h"

class QGridLayout;
class QLabel;
class QPushButton;

namespace foresight {

/// One options model as a form: a row an option, under the headings of their groups; what differs
/// from the usual value stands out.
class OptionsForm : public QWidget {
  Q_OBJECT

 public:
  explicit OptionsForm(OptionsModel* model, QWidget* parent = nullptr);

  /// The field of an option; nullptr where it does nothing now.
  OptionField* Field(const std::string& key) const;

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  /// A fit's options say that they changed with each look at a growing scan.
  void ShowRowsInSight();
  void ShowRows();
  void Build(const std::vector<OptionRow>& rows);

  OptionsModel* model_;
  QLabel* title_;
  QPushButton* reset_;
  QWidget* form_ = nullptr;
  std::vector<OptionField*> fields_;
};

/// All options of the depth map and of the fit.
class OptionsPanel : public QWidget {
  Q_OBJECT

 public:
  OptionsPanel(DepthViewModel* depth, FitViewModel* fit, QWidget* parent = nullptr);

  OptionsForm* Depth() { return depth_; }
  OptionsForm* Fit() { return fit_; }

 private:
  OptionsForm* depth_;
  OptionsForm* fit_;
};

}  // namespace foresight
