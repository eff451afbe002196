#pragma once

#include <vtkActor.h>
#include <vtkOrientationMarkerWidget.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "core/pictures/color_map.h"
#include "ui/render/point_set.h"
#include "ui/viewmodels/box_region.h"
#include "ui/views/orbit_camera.h"
#include "ui/views/outline_actors.h"
#include "ui/views/vtk_canvas.h"

class QRubberBand;

namespace foresight {

/// Points and templates in 3D, in the robot's frame. Left button orbits about the point looked at,
/// right or middle pans, wheel zooms, a double click looks at the point under the mouse. In drawing
/// mode left draws a rectangle, with Shift one that cuts, and right orbits.
class CloudCanvas : public VtkCanvas {
  Q_OBJECT

 public:
  explicit CloudCanvas(QWidget* parent = nullptr);

  void SetPoints(const PointSet& set, ColorMap map, const ValueRange& range);
  void SetOutlines(const std::vector<RobotOutline>& outlines);
  /// In robot.
  void SetRegion(const Wireframe& lines);
  void SetDrawing(bool drawing);
  /// Larger points over the others, with colours of their own; none = an empty set.
  void SetResiduals(const PointSet& set);
  /// Looks at the middle of what lies ahead of the robot.
  void ResetView();
  /// Whether the operator has moved the camera since the last reset.
  bool Moved() const { return moved_; }
  const OrbitCamera& Camera() const { return camera_; }
  /// Looks from where another canvas does; tells nobody.
  void SetCamera(const OrbitCamera& camera);
  /// Where a point of robot is on this widget.
  QPoint WidgetFromRobot(const Eigen::Vector3d& point) const;

 Q_SIGNALS:
  /// The operator has moved the camera, or a reset has.
  void cameraMoved();
  void rectangleDrawn(const foresight::CloudRectangle& rectangle, bool cut);

 protected:
  bool event(QEvent* event) override;
  void Prepare() override;

 private:
  void OnPress(const QMouseEvent& event);
  void OnMove(const QMouseEvent& event);
  void OnRelease(const QMouseEvent& event);
  bool OnKey(const QKeyEvent& event);
  Eigen::Matrix4d ClipFromRobot() const;
  Eigen::Vector2d ClipFrom(const QPoint& position) const;
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
  OutlineActors region_;
  vtkSmartPointer<vtkOrientationMarkerWidget> compass_;
  OrbitCamera camera_;
  OrbitCamera home_;
  QPointF last_position_;
  QRubberBand* rectangle_;  ///< shown while one is drawn
  QPoint rectangle_begin_;
  bool drawing_ = false;
  bool moved_ = false;
};

}  // namespace foresight
