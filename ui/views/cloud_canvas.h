#pragma once

#include <vtkActor.h>
#include <vtkOrientationMarkerWidget.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "core/pictures/color_map.h"
#include "ui/render/point_set.h"
#include "ui/views/orbit_camera.h"
#include "ui/views/outline_actors.h"
#include "ui/views/vtk_canvas.h"

namespace foresight {

/// Points and templates in 3D, in the robot's frame. Left button orbits about the point looked at,
/// right or middle pans, wheel zooms, a double click looks at the point under the mouse.
class CloudCanvas : public VtkCanvas {
  Q_OBJECT

 public:
  explicit CloudCanvas(QWidget* parent = nullptr);

  void SetPoints(const PointSet& set, ColorMap map, const ValueRange& range);
  void SetOutlines(const std::vector<RobotOutline>& outlines);
  /// Larger points over the others, with colours of their own; none = an empty set.
  void SetResiduals(const PointSet& set);
  /// Looks at the middle of what lies ahead of the robot.
  void ResetView();
  /// Whether the operator has moved the camera since the last reset.
  bool Moved() const { return moved_; }

 protected:
  bool event(QEvent* event) override;
  void Prepare() override;

 private:
  void OnMove(const QMouseEvent& event);
  void LookAtPointUnder(const QPointF& position);
  void ShowSample(bool sample);
  void PlaceCamera();

  /// While the camera moves only this many points are drawn, or software rendering stutters.
  static constexpr std::size_t kSamplePoints = 100'000;

  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkRenderer> overlay_;
  vtkSmartPointer<vtkActor> points_;
  vtkSmartPointer<vtkActor> sample_;
  vtkSmartPointer<vtkActor> residuals_;
  OutlineActors outlines_;
  vtkSmartPointer<vtkOrientationMarkerWidget> compass_;
  OrbitCamera camera_;
  OrbitCamera home_;
  QPointF last_position_;
  bool moved_ = false;
};

}  // namespace foresight
