#pragma once

#include "ui/render/point_set.h"
#include "ui/viewmodels/clip_box_model.h"
#include "ui/viewmodels/fit_view_model.h"
#include "ui/viewmodels/map_view_model.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"
#include "ui/views/cloud_canvas.h"
#include "ui/views/pane.h"

class QComboBox;
class QToolButton;

namespace foresight {

/// The view-models of the cloud pane.
struct CloudModels {
  SessionModel* session;
  FitViewModel* fit;
  MapViewModel* map;
  ClipBoxModel* clip;
};

/// The scan in 3D: the lidar's points as they arrive, the masked depth as a cloud, or a map of
/// several scans, of which a budget of points is drawn: coarse from afar, every one when near.
class CloudPane : public Pane {
  Q_OBJECT

 public:
  explicit CloudPane(const CloudModels& models, QWidget* parent = nullptr);

  CloudCanvas* Canvas() { return canvas_; }
  QToolButton* ResidualButton() { return residuals_; }
  /// How many points are drawn.
  std::size_t PointCount() const { return point_count_; }

 private:
  enum class Source { kLidar, kDepth, kMap };

  void BindMap();
  void BuildControls();
  void FillColors();
  void Prepare();
  void PrepareMap();
  void ShowMap(std::size_t count);
  void ShowNewMap();
  /// What belongs to one scan's frame is not drawn over a map.
  void ShowOverlays();
  void ShowClip();
  Source Shown() const;
  void PrepareResiduals();
  void Show(const PointSet& set);
  PointColor Color() const;
  bool ShowsLidar() const;
  bool HasData() const;

  SessionModel* session_;
  MapViewModel* map_;
  ClipBoxModel* clip_;
  CloudCanvas* canvas_;
  TaskRunner runner_{session_->Tasks()};
  TaskRunner residual_runner_{session_->Tasks()};
  QComboBox* source_;
  QComboBox* color_;
  QToolButton* residuals_;
  bool home_wanted_ = false;  ///< the view of a map begins anew
  bool outdated_ = false;     ///< newer data came while the last were being prepared
  std::size_t point_count_ = 0;
};

}  // namespace foresight
