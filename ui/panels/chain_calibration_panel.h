#pragma once

#include <QTimer>
#include <QWidget>

#include "ui/viewmodels/chain_calibration_model.h"

class QButtonGroup;
class QLabel;
class QProgressBar;
class QStackedWidget;

namespace foresight {

class RecordPage;
class RigVersionRow;
class SolvePage;
class StandPage;
class VerdictView;

/// "Calibrate head": the steps of ChainCalibrationModel, each a page that can be gone to at any
/// time. Blocks nothing: its dialogues are not modal.
class ChainCalibrationPanel : public QWidget {
  Q_OBJECT

 public:
  enum Step { kStand, kRecord, kSolve, kRig };

  ChainCalibrationPanel(ChainCalibrationModel* model, TaskQueue* tasks, QWidget* parent = nullptr);

  void GoTo(Step step);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* BuildSteps();
  QWidget* BuildRig();
  void ShowSoon();
  void ShowAll();
  void ShowProgress();

  ChainCalibrationModel* model_;
  QButtonGroup* steps_ = nullptr;
  QLabel* state_;
  QProgressBar* progress_;
  QStackedWidget* pages_;
  StandPage* stand_;
  RecordPage* record_;
  SolvePage* solve_;
  VerdictView* verdict_;
  RigVersionRow* rig_;
  QTimer soon_;
};

}  // namespace foresight
