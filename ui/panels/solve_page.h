#pragma once

#include <QWidget>

#include "ui/viewmodels/chain_calibration_model.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace foresight {

class BoardBars;
class CoverageMap;
class LidarImageView;
class StandLamps;
class VerdictView;

/// Third step of "Calibrate head": the solve, its verdict, and where the residuals are.
class SolvePage : public QWidget {
  Q_OBJECT

 public:
  explicit SolvePage(ChainCalibrationModel* model, QWidget* parent = nullptr);

  void Refresh();
  void ShowProgress();

 private:
  QWidget* BuildSolve();
  QWidget* BuildPlots();
  void ShowPlot();

  ChainCalibrationModel* model_;
  QComboBox* stage_ = nullptr;
  QPushButton* solve_ = nullptr;
  QPushButton* cancel_ = nullptr;
  QLabel* graph_;
  VerdictView* verdict_;
  QLabel* weakest_;
  QWidget* plots_ = nullptr;
  QComboBox* plot_ = nullptr;
  StandLamps* lamps_;
  CoverageMap* corners_;
  LidarImageView* lidar_;
  BoardBars* boards_;
  std::shared_ptr<const ChainSolution> shown_;  ///< in the plots of all corners
};

}  // namespace foresight
