#pragma once

#include <vtkActor.h>
#include <vtkOrientationMarkerWidget.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <QTimer>

#include "core/pictures/color_map.h"
#include "ui/render/point_set.h"
#include "ui/viewmodels/box_region.h"
#include "ui/views/clip_handles.h"
#include "ui/views/label_actors.h"
#include "ui/views/measurement_lines.h"
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

  /// Looks at their middle until the operator moves the camera.
  void SetPoints(const PointSet& set, ColorMap map, const ValueRange& range);
  /// Other points of what is shown already: the camera stays.
  void ReplacePoints(const PointSet& set);
  void SetOutlines(const std::vector<RobotOutline>& outlines);
  /// In robot.
  void SetRegion(const Wireframe& lines);
  void SetDrawing(bool drawing);
  /// Larger points over the others, with colours of their own; none = an empty set.
  void SetResiduals(const PointSet& set);
  /// A click is told, and while a plane is wanted left with Shift draws a rectangle over it;
  /// dragging orbits as ever.
  void SetMeasuring(bool measuring, bool wants_plane);
  /// False: the points are not those of a scan (a map), so no region is drawn into it.
  void SetShowsScan(bool shows) { shows_scan_ = shows; }
  void SetMeasurements(const std::vector<RobotMeasurement>& measurements);
  /// Only what is inside is drawn and picked; the sides are dragged by their handles.
  void SetClipBox(const std::optional<Eigen::AlignedBox3d>& box);
  const ClipHandles& Clip() const { return clip_; }
  /// How the scene is looked at now.
  Eigen::Matrix4d ClipFromRobot() const;
  /// Turns about this place from now on.
  void LookAt(const Eigen::Vector3d& place);
  const Eigen::Vector3d& LooksAt() const { return camera_.focal; }
  /// Looks at the middle of what lies ahead of the robot.
  void ResetView();
  /// The same without telling that the view rests there.
  void GoHome();
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
  void pointClicked(const foresight::CloudClick& click);
  /// A region where the points are not those of a scan.
  void refused();
  void planeDrawn(const foresight::CloudRectangle& rectangle);
  void clipBoxDragged(const Eigen::AlignedBox3d& box);
  /// The operator has looked elsewhere and rests there.
  void viewRested();

 protected:
  bool event(QEvent* event) override;
  void Prepare() override;

 private:
  void OnPress(const QMouseEvent& event);
  void OnMove(const QMouseEvent& event);
  void OnRelease(const QMouseEvent& event);
  bool OnKey(const QKeyEvent& event);
  Eigen::Vector2d ClipFrom(const QPoint& position) const;
  CloudClick ClickAt(const QPoint& position) const;
  void LookAtPointUnder(const QPointF& position);
  QPointF WidgetPointFromRobot(const Eigen::Vector3d& point) const;
  void PutPoints(const PointSet& set);
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
  OutlineActors measurements_;
  LabelActors labels_;
  ClipHandles clip_;
  QTimer rest_;
  vtkSmartPointer<vtkOrientationMarkerWidget> compass_;
  OrbitCamera camera_;
  OrbitCamera home_;
  QPointF last_position_;
  QRubberBand* rectangle_;  ///< shown while one is drawn
  QPoint rectangle_begin_;
  QPoint pressed_at_;
  bool shows_scan_ = true;
  bool measuring_ = false;
  bool wants_plane_ = false;
  bool drawing_ = false;
  bool moved_ = false;
};

}  // namespace foresight
