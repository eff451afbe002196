#pragma once

#include <QWidget>

#include "ui/viewmodels/chain_calibration_model.h"

class QComboBox;
class QLabel;
class QListWidget;
class QPushButton;

namespace foresight {

class StandLamps;

/// Second step of "Calibrate head": what was captured, and what to capture next.
class RecordPage : public QWidget {
  Q_OBJECT

 public:
  explicit RecordPage(ChainCalibrationModel* model, QWidget* parent = nullptr);

  void Refresh();
  StandLamps* Lamps() { return lamps_; }

 private:
  QWidget* BuildStand();
  QWidget* BuildCaptures();
  void ToggleSelected();
  void TogglePlace();
  void CaptureAgain();
  const StopLamp* Selected() const;
  void ShowStand();
  void ShowSelected();
  void ShowBoardImages();

  ChainCalibrationModel* model_;
  QLabel* next_;
  QComboBox* stand_at_ = nullptr;  ///< nullptr where the stand is moved by hand
  QPushButton* all_ = nullptr;
  QPushButton* stops_ = nullptr;
  QPushButton* sweep_ = nullptr;
  QPushButton* place_ = nullptr;
  QPushButton* same_place_ = nullptr;  ///< while it is in question whether the stand was moved
  QPushButton* image_ = nullptr;
  QPushButton* end_ = nullptr;
  StandLamps* lamps_;
  QLabel* selected_;
  QPushButton* leave_out_;
  QPushButton* leave_place_out_;
  QPushButton* again_;
  QLabel* images_title_;
  QListWidget* images_;
};

}  // namespace foresight
