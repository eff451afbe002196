#include "ui/views/cloud_canvas.h"

#include <vtkAxesActor.h>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkPointPicker.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <QMouseEvent>
#include <QRubberBand>
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/render/vtk_data.h"
#include "ui/views/overlay_style.h"

namespace foresight {
namespace {

constexpr double kOrbitPerPixel_rad = 0.008;
constexpr int kSmallestRectangle_px = 5;

vtkPolyDataMapper* MapperOf(vtkActor* actor) {
  return static_cast<vtkPolyDataMapper*>(actor->GetMapper());
}

vtkSmartPointer<vtkActor> MakeActor(const vtkSmartPointer<vtkPolyData>& data) {
  auto actor = vtkSmartPointer<vtkActor>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetPointSize(2.0f);
  return actor;
}

/// So that the shaders of points are made when the window opens and not in the first scan.
PointSet OnePoint() {
  PointSet set;
  set.points = {Eigen::Vector3f::Zero()};
  set.values = {0.0f};
  return set;
}

/// The middle of the points ahead of the robot (within 35 deg of its x axis), or of all of them.
Eigen::Vector3d MiddleOf(const PointSet& set) {
  std::array<std::vector<float>, 3> ahead, all;
  const std::size_t stride = std::max<std::size_t>(1, set.points.size() / 20'000);
  for (std::size_t i = 0; i < set.points.size(); i += stride) {
    const Eigen::Vector3f way = set.points[i] - set.viewpoint;
    const bool is_ahead = way.x() > 0.8f * way.norm();
    for (int axis = 0; axis < 3; ++axis) {
      all[static_cast<std::size_t>(axis)].push_back(set.points[i][axis]);
      if (is_ahead) ahead[static_cast<std::size_t>(axis)].push_back(set.points[i][axis]);
    }
  }
  auto& chosen = ahead[0].empty() ? all : ahead;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    auto& values = chosen[static_cast<std::size_t>(axis)];
    if (values.empty()) return middle;
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    middle[axis] = *half;
  }
  return middle;
}

vtkSmartPointer<vtkAxesActor> MakeAxes(double length_m, bool labels) {
  auto axes = vtkSmartPointer<vtkAxesActor>::New();
  axes->SetTotalLength(length_m, length_m, length_m);
  axes->SetAxisLabels(labels ? 1 : 0);
  return axes;
}

}  // namespace

CloudCanvas::CloudCanvas(QWidget* parent)
    : VtkCanvas(parent),
      renderer_(vtkSmartPointer<vtkRenderer>::New()),
      overlay_(vtkSmartPointer<vtkRenderer>::New()),
      points_(MakeActor(VtkPointsOf(OnePoint(), 1))),
      sample_(MakeActor(VtkPointsOf({}, 0))),
      residuals_(MakeActor(VtkPointsOf(OnePoint(), 1))),
      outlines_(overlay_, 0.0),
      region_(overlay_, 0.0),
      compass_(vtkSmartPointer<vtkOrientationMarkerWidget>::New()),
      rectangle_(new QRubberBand(QRubberBand::Rectangle, this)) {
  renderWindow()->AddRenderer(renderer_);
  renderer_->SetBackground(0.07, 0.08, 0.10);
  renderer_->SetBackground2(0.15, 0.17, 0.20);
  renderer_->GradientBackgroundOn();
  sample_->VisibilityOff();
  renderer_->AddActor(points_);
  renderer_->AddActor(sample_);
  // Outlines lie among the points they were fitted to: a layer of their own keeps them visible.
  residuals_->VisibilityOff();
  residuals_->GetProperty()->SetPointSize(5.0f);
  overlay_->AddActor(residuals_);
  overlay_->SetLayer(1);
  overlay_->SetActiveCamera(renderer_->GetActiveCamera());
  overlay_->InteractiveOff();
  renderWindow()->SetNumberOfLayers(2);
  renderWindow()->AddRenderer(overlay_);
  renderer_->AddActor(MakeAxes(0.2, false));
  compass_->SetOrientationMarker(MakeAxes(1.0, true));
  compass_->SetInteractor(interactor());
  compass_->SetViewport(0.0, 0.0, 0.16, 0.32);
  compass_->EnabledOn();
  compass_->InteractiveOff();
  setMinimumSize(120, 70);
  setFocusPolicy(Qt::ClickFocus);
  setAccessibleName(tr("3D cloud"));
}

void CloudCanvas::SetPoints(const PointSet& set, ColorMap map, const ValueRange& range) {
  const auto table = VtkTableOf(map, range);
  for (const auto& [actor, limit] :
       {std::pair(points_, set.points.size()), std::pair(sample_, kSamplePoints)}) {
    MapperOf(actor)->SetInputData(VtkPointsOf(set, limit));
    MapperOf(actor)->SetLookupTable(table);
    MapperOf(actor)->SetScalarRange(range.low, range.high);
  }
  home_.focal = MiddleOf(set);
  home_.distance_m = std::max(0.5, 2.1 * (home_.focal - set.viewpoint.cast<double>()).norm());
  home_.azimuth_rad = -0.25;
  home_.elevation_rad = 0.45;
  if (!moved_) ResetView();
  Redraw();
}

void CloudCanvas::SetOutlines(const std::vector<RobotOutline>& outlines) {
  outlines_.Clear();
  for (const RobotOutline& outline : outlines) outlines_.Add(outline.lines, outline.style);
  Redraw();
}

void CloudCanvas::SetRegion(const Wireframe& lines) {
  region_.Clear();
  if (!lines.empty()) region_.Add(lines, {kRoiColor, 1.5f});
  Redraw();
}

void CloudCanvas::SetDrawing(bool drawing) {
  drawing_ = drawing;
  rectangle_->hide();
  setCursor(drawing ? Qt::CrossCursor : Qt::ArrowCursor);
}

void CloudCanvas::SetResiduals(const PointSet& set) {
  residuals_->SetVisibility(set.points.empty() ? 0 : 1);
  if (!set.points.empty()) MapperOf(residuals_)->SetInputData(VtkPointsOf(set, set.points.size()));
  Redraw();
}

void CloudCanvas::ResetView() {
  camera_ = home_;
  moved_ = false;
  PlaceCamera();
  Q_EMIT cameraMoved();
  Redraw();
}

bool CloudCanvas::event(QEvent* event) {
  switch (event->type()) {
    case QEvent::MouseButtonPress:
      OnPress(*static_cast<QMouseEvent*>(event));
      return true;
    case QEvent::MouseMove:
      OnMove(*static_cast<QMouseEvent*>(event));
      return true;
    case QEvent::MouseButtonRelease:
      OnRelease(*static_cast<QMouseEvent*>(event));
      return true;
    case QEvent::MouseButtonDblClick:
      LookAtPointUnder(static_cast<QMouseEvent*>(event)->localPos());
      return true;
    case QEvent::Wheel:
      camera_.Zoom(std::pow(0.9985, static_cast<QWheelEvent*>(event)->angleDelta().y()));
      moved_ = true;
      PlaceCamera();
      Q_EMIT cameraMoved();
      Redraw();
      return true;
    case QEvent::KeyPress:
      return OnKey(*static_cast<QKeyEvent*>(event));
    default:
      return VtkCanvas::event(event);
  }
}

void CloudCanvas::OnPress(const QMouseEvent& event) {
  setFocus();
  last_position_ = event.localPos();
  if (drawing_ && event.button() == Qt::LeftButton) {
    rectangle_begin_ = event.pos();
    rectangle_->setGeometry(QRect(rectangle_begin_, QSize()));
    rectangle_->show();
  } else {
    ShowSample(true);
  }
}

void CloudCanvas::OnMove(const QMouseEvent& event) {
  if (rectangle_->isVisible()) {
    rectangle_->setGeometry(QRect(rectangle_begin_, event.pos()).normalized());
    return;
  }
  const QPointF way = event.localPos() - last_position_;
  last_position_ = event.localPos();
  if (event.buttons() == Qt::NoButton) return;
  const bool orbits =
      drawing_ ? event.buttons() & Qt::RightButton
               : event.buttons() & Qt::LeftButton && !(event.modifiers() & Qt::ShiftModifier);
  if (orbits) {
    camera_.Orbit(kOrbitPerPixel_rad * way.x(), kOrbitPerPixel_rad * way.y());
  } else {
    const double view_angle = renderer_->GetActiveCamera()->GetViewAngle() * M_PI / 180.0;
    const double metres_per_pixel =
        2.0 * camera_.distance_m * std::tan(0.5 * view_angle) / std::max(1, height());
    camera_.Pan(-metres_per_pixel * way.x(), metres_per_pixel * way.y());
  }
  moved_ = true;
  PlaceCamera();
  Q_EMIT cameraMoved();
  Redraw();
}

void CloudCanvas::OnRelease(const QMouseEvent& event) {
  if (!rectangle_->isVisible() || event.button() != Qt::LeftButton) {
    ShowSample(false);
    return;
  }
  rectangle_->hide();
  const QRect drawn = QRect(rectangle_begin_, event.pos()).normalized();
  if (drawn.width() < kSmallestRectangle_px || drawn.height() < kSmallestRectangle_px) return;
  CloudRectangle rectangle;
  rectangle.clip_from_robot = ClipFromRobot();
  rectangle.corners = {ClipFrom(drawn.bottomLeft()), ClipFrom(drawn.topRight())};
  Q_EMIT rectangleDrawn(rectangle, event.modifiers() & Qt::ShiftModifier);
}

bool CloudCanvas::OnKey(const QKeyEvent& event) {
  if (event.key() == Qt::Key_Escape && rectangle_->isVisible()) {
    rectangle_->hide();
    return true;
  }
  return false;  // VTK's own keys (e, q, w) must not reach an operator
}

Eigen::Matrix4d CloudCanvas::ClipFromRobot() const {
  vtkMatrix4x4* matrix = renderer_->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
      renderer_->GetTiledAspectRatio(), -1.0, 1.0);
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(matrix->GetData());
}

Eigen::Vector2d CloudCanvas::ClipFrom(const QPoint& position) const {
  return {2.0 * position.x() / std::max(1, width()) - 1.0,
          1.0 - 2.0 * position.y() / std::max(1, height())};
}

QPoint CloudCanvas::WidgetFromRobot(const Eigen::Vector3d& point) const {
  const Eigen::Vector4d clip = ClipFromRobot() * point.homogeneous();
  const Eigen::Vector2d at = clip.head<2>() / clip.w();
  return {static_cast<int>(std::lround(0.5 * (at.x() + 1.0) * width())),
          static_cast<int>(std::lround(0.5 * (1.0 - at.y()) * height()))};
}

void CloudCanvas::LookAtPointUnder(const QPointF& position) {
  vtkNew<vtkPointPicker> picker;  // the hardware selector takes a second a million points here
  picker->SetTolerance(0.01);
  picker->PickFromListOn();
  picker->AddPickList(points_);
  const double ratio = devicePixelRatioF();
  if (!picker->Pick(position.x() * ratio, (height() - 1 - position.y()) * ratio, 0.0, renderer_))
    return;
  double picked[3];
  picker->GetPickPosition(picked);
  camera_.focal = {picked[0], picked[1], picked[2]};
  moved_ = true;
  PlaceCamera();
  Q_EMIT cameraMoved();
  Redraw();
}

void CloudCanvas::ShowSample(bool sample) {
  points_->SetVisibility(sample ? 0 : 1);
  sample_->SetVisibility(sample ? 1 : 0);
  if (!sample) Redraw();
}

void CloudCanvas::SetCamera(const OrbitCamera& camera) {
  camera_ = camera;
  moved_ = true;
  PlaceCamera();
  Redraw();
}

void CloudCanvas::PlaceCamera() {
  vtkCamera* camera = renderer_->GetActiveCamera();
  const Eigen::Vector3d position = camera_.Position();
  camera->SetFocalPoint(camera_.focal.data());
  camera->SetPosition(position.data());
  camera->SetViewUp(0.0, 0.0, 1.0);
}

void CloudCanvas::Prepare() {
  renderer_->ResetCameraClippingRange();
}

}  // namespace foresight
