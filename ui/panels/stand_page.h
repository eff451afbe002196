#pragma once

#include <QWidget>

#include "ui/viewmodels/chain_calibration_model.h"

class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSpinBox;

namespace foresight {

class BoardFields;

/// First step of "Calibrate head": the session, the boards of the stand, and the motor's stops.
class StandPage : public QWidget {
  Q_OBJECT

 public:
  explicit StandPage(ChainCalibrationModel* model, QWidget* parent = nullptr);

  void Refresh();

 private:
  QWidget* BuildSession();
  QWidget* BuildPlan();
  void TakeBoards();
  void TakePlan();
  void ChooseSession();

  ChainCalibrationModel* model_;
  QPushButton* last_ = nullptr;
  QLabel* folder_ = nullptr;
  BoardFields* a_;
  BoardFields* b_;
  QDoubleSpinBox* hinge_mm_;
  BoardFields* single_;
  QLabel* fault_;
  QDoubleSpinBox* first_ = nullptr;
  QDoubleSpinBox* last_stop_ = nullptr;
  QDoubleSpinBox* step_ = nullptr;
  QSpinBox* lines_ = nullptr;
  QDoubleSpinBox* exposure_ = nullptr;
  QDoubleSpinBox* speed_ = nullptr;
};

}  // namespace foresight
