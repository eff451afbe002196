#pragma once

#include <QWidget>
#include <functional>
#include <vector>

#include "ui/viewmodels/command_table.h"
#include "ui/viewmodels/head_view_model.h"

class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;

namespace foresight {

/// The next scan: scope, speed, images, what they will give, and the buttons that start it.
class HeadPanel : public QWidget {
  Q_OBJECT

 public:
  HeadPanel(HeadViewModel* head, CommandTable* commands, QWidget* parent = nullptr);

  /// Docks ask for this one, and not for the minimum width: nothing scrolls sideways here.
  QSize minimumSizeHint() const override;

 private:
  QWidget* BuildPlan();
  QWidget* BuildPrediction();
  QWidget* BuildButtons(CommandTable* commands);
  QDoubleSpinBox* AddField(QFormLayout* form, const QString& label, double low, double high,
                           double step, const QString& unit, double PlanFields::*field);
  void AddChoice(QFormLayout* form, const QString& label, const QStringList& choices,
                 bool PlanFields::*field);
  void TakeAngles();
  void ShowPlan();
  void ShowStatus();

  HeadViewModel* head_;
  QWidget* plan_;
  std::vector<std::function<void(const PlanFields&)>> show_fields_;  ///< of the plan, one each
  QLineEdit* angles_;
  QLabel* time_;
  QLabel* lines_;
  QLabel* coverage_;
  QLabel* sigma_;
  QLabel* sigma_title_;
  QLabel* exposure_;
  QPushButton* fastest_button_;
  QWidget* warning_row_;
  QLabel* warning_;
};

}  // namespace foresight
