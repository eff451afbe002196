#pragma once

#include "ui/render/point_set.h"
#include "ui/viewmodels/fit_view_model.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"
#include "ui/views/cloud_canvas.h"
#include "ui/views/pane.h"

class QComboBox;
class QToolButton;

namespace foresight {

/// The scan in 3D: the lidar's points as they arrive, or the masked depth as a cloud.
class CloudPane : public Pane {
  Q_OBJECT

 public:
  CloudPane(SessionModel* session, FitViewModel* fit, QWidget* parent = nullptr);

  CloudCanvas* Canvas() { return canvas_; }
  QToolButton* ResidualButton() { return residuals_; }
  /// How many points are drawn.
  std::size_t PointCount() const { return point_count_; }

 private:
  enum class Source { kLidar, kDepth };

  void BuildControls();
  void FillColors();
  void Prepare();
  void PrepareResiduals();
  void Show(const PointSet& set);
  PointColor Color() const;
  bool ShowsLidar() const;
  bool HasData() const;

  SessionModel* session_;
  CloudCanvas* canvas_;
  TaskRunner runner_{session_->Tasks()};
  TaskRunner residual_runner_{session_->Tasks()};
  QComboBox* source_;
  QComboBox* color_;
  QToolButton* residuals_;
  bool outdated_ = false;  ///< newer data came while the last were being prepared
  std::size_t point_count_ = 0;
};

}  // namespace foresight
