#pragma once

#include <QTimer>
#include <QWidget>
#include <vector>

#include "ui/viewmodels/camera_calibration_model.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace foresight {

class BoardFields;
class CalibrationImageList;
class CameraModelTable;
class CoverageMap;
class FieldMap;
class RigVersionRow;
class VerdictView;
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
  QWidget* BuildSources();
  QWidget* BuildMaps();
  QWidget* BuildSolve();
  void TakeBoard();
  void TakeModels();
  void ShowSoon();
  void ShowAll();
  void WantMap();
  void ShowMap();
  void ShowModels();
  void ShowProgress();
  void ShowButtons();
  void ChooseImages(bool folder);

  CameraCalibrationModel* model_;
  TaskQueue* tasks_;
  BoardFields* board_;
  QPushButton* take_ = nullptr;
  QPushButton* capture_ = nullptr;
  QPushButton* last_ = nullptr;
  QLabel* next_;
  QLabel* state_;
  QProgressBar* progress_;
  CalibrationImageList* images_;
  QComboBox* which_map_ = nullptr;
  QDoubleSpinBox* map_distance_ = nullptr;
  CoverageMap* map_;
  FieldMap* field_;
  ViewBars* bars_;
  std::vector<QCheckBox*> wanted_;
  QPushButton* solve_ = nullptr;
  QPushButton* cancel_ = nullptr;
  CameraModelTable* table_;
  QLabel* why_;
  QLabel* parameters_;
  VerdictView* verdict_;
  RigVersionRow* rig_;
  QTimer soon_;
};

}  // namespace foresight
