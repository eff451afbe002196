#pragma once

#include "core/pictures/depth_picture.h"
#include "ui/viewmodels/depth_view_model.h"
#include "ui/viewmodels/fit_view_model.h"
#include "ui/views/depth_canvas.h"
#include "ui/views/pane.h"

class QCheckBox;
class QLabel;
class QSlider;
class QToolButton;

namespace foresight {

/// The dense depth or its confidence, with the mask and its threshold.
class DepthPane : public Pane {
  Q_OBJECT

 public:
  DepthPane(SessionModel* session, DepthViewModel* depth, FitViewModel* fit,
            QWidget* parent = nullptr);

  DepthCanvas* Canvas() { return canvas_; }
  QSlider* ThresholdSlider() { return slider_; }
  void ToggleMask();
  void ToggleLayer();

 private:
  void BuildControls();
  void BuildThreshold();
  void Paint();
  void ShowThreshold();
  void ShowReadout(const Eigen::Vector2d& pixel);
  void UpdateHint();

  SessionModel* session_;
  DepthViewModel* depth_;
  DepthCanvas* canvas_;
  ValueRange depth_range_;
  QToolButton* depth_button_;
  QToolButton* confidence_button_;
  QCheckBox* mask_box_;
  QSlider* slider_;
  QLabel* threshold_value_;
  QLabel* readout_;
};

}  // namespace foresight
