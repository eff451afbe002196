#pragma once

#include <QTimer>
#include <QWidget>
#include <functional>

#include "ui/viewmodels/camera_calibration_model.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QListWidget;
class QListWidgetItem;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QTableWidget;
class QVBoxLayout;

namespace foresight {

class CoverageMap;
class ViewBars;

/// "Calibrate camera": everything of CameraCalibrationModel from the board to the rig in force, one
/// below the other. Blocks nothing: its dialogues are not modal.
class CameraCalibrationPanel : public QWidget {
  Q_OBJECT

 public:
  CameraCalibrationPanel(CameraCalibrationModel* model, TaskQueue* tasks,
                         QWidget* parent = nullptr);

  CoverageMap* Map() { return map_; }

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* BuildBoard();
  QWidget* BuildSources();
  QWidget* BuildSolve();
  QWidget* BuildRig();
  QPushButton* Button(const char* name, const QString& text, const QString& tip);
  void TakeBoard();
  void TakeModels();
  void TakeCheck(const QListWidgetItem* item);
  void ShowSoon();
  void ShowAll();
  void ShowBoard();
  void ShowImages();
  void ShowModels();
  void ShowVerdict();
  void ShowProgress();
  void ShowButtons();
  void ChooseImages(bool folder);
  void ChooseRigFile();

  CameraCalibrationModel* model_;
  TaskQueue* tasks_;
  QComboBox* kind_ = nullptr;
  QSpinBox* columns_ = nullptr;
  QSpinBox* rows_ = nullptr;
  QDoubleSpinBox* square_mm_ = nullptr;
  QPushButton* take_ = nullptr;
  QPushButton* last_ = nullptr;
  QLabel* next_;
  QLabel* state_;
  QProgressBar* progress_;
  QListWidget* images_;
  CoverageMap* map_;
  ViewBars* bars_;
  std::vector<QCheckBox*> wanted_;
  QPushButton* solve_ = nullptr;
  QPushButton* cancel_ = nullptr;
  QTableWidget* table_;
  QLabel* why_;
  QLabel* parameters_;
  QLabel* verdict_;
  QLabel* checks_;
  QPushButton* save_ = nullptr;
  QPushButton* force_ = nullptr;
  QPushButton* back_ = nullptr;
  QLabel* saved_ = nullptr;
  QTimer soon_;
};

}  // namespace foresight
