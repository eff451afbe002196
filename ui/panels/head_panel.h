#pragma once

#include <QWidget>

#include "ui/viewmodels/head_view_model.h"

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;

namespace foresight {

/// The next scan: scope, speed, pictures, what they will give, and the buttons that start it.
class HeadPanel : public QWidget {
  Q_OBJECT

 public:
  explicit HeadPanel(HeadViewModel* head, QWidget* parent = nullptr);

 private:
  QWidget* BuildPlan();
  QWidget* BuildPrediction();
  QWidget* BuildButtons();
  QDoubleSpinBox* AddField(QFormLayout* form, const QString& label, double low, double high,
                           double step, const QString& unit, double PlanFields::*field);
  QComboBox* AddChoice(QFormLayout* form, const QString& label, const QStringList& choices,
                       bool PlanFields::*field);
  void TakeAngles();
  void ShowPlan();
  void ShowStatus();

  HeadViewModel* head_;
  QWidget* plan_;
  QDoubleSpinBox* speed_;
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
  QPushButton* scan_button_;
  QPushButton* abort_button_;
  QPushButton* home_button_;
};

}  // namespace foresight
