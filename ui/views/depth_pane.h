#pragma once

#include "ui/viewmodels/compare_view_model.h"
#include "ui/viewmodels/fit_view_model.h"
#include "ui/viewmodels/layers_view_model.h"
#include "ui/viewmodels/live_depth_view_model.h"
#include "ui/views/corner_tags.h"
#include "ui/views/depth_canvas.h"
#include "ui/views/pane.h"

class QComboBox;
class QLabel;
class QSlider;
class QToolButton;

namespace foresight {

class IterationBar;

/// The view-models of the depth pane.
struct DepthModels {
  SessionModel* session;
  DepthViewModel* depth;
  FitViewModel* fit;
  LayersViewModel* layers;
  CompareViewModel* compare;
  LiveDepthViewModel* live;  ///< nullptr where no scan arrives
};

/// The tool to judge a depth map: the choice of the method, what lies over the map, a second one
/// beside it, the threshold of the mask, and what is known about the pixel under the cursor.
class DepthPane : public Pane {
  Q_OBJECT

 public:
  explicit DepthPane(const DepthModels& models, QWidget* parent = nullptr);

  DepthCanvas* Canvas() { return canvas_; }
  QSlider* ThresholdSlider() { return slider_; }
  IterationBar* Iterations() { return iterations_; }
  /// What is said about the pixel under the cursor.
  QString Readout() const;
  /// What speaks against the map as a whole; empty while nothing does.
  QString Warning() const;

 private:
  void BuildControls();
  void BuildFooter();
  QWidget* BuildWarning();
  void Bind();
  /// The depth on the screen: result A where two results are compared, that of the session, else
  /// the preview of a running scan.
  std::shared_ptr<const DepthResult> Shown() const;
  const MaskImage* ShownMask() const;
  void ShowNewDepth();
  void Paint();
  ColorImage Painted(const DepthResult& result, const MaskImage* mask) const;
  void PaintSecond();
  void ShowMarks();
  void ShowWarning();
  void ShowColors();
  void ShowState();
  void ShowMethod();
  void ShowThreshold();
  void ShowReadout(const Eigen::Vector2d& pixel);

  SessionModel* session_;
  DepthViewModel* depth_;
  LayersViewModel* layers_;
  CompareViewModel* compare_;
  LiveDepthViewModel* live_;
  DepthCanvas* canvas_;
  CornerTags* tags_;
  ValueRange depth_range_;
  QComboBox* method_;
  QToolButton* compare_button_;
  IterationBar* iterations_;
  QSlider* slider_;
  QLabel* threshold_value_;
  QLabel* readout_;
  QWidget* warning_row_;
  QLabel* warning_;
};

}  // namespace foresight
