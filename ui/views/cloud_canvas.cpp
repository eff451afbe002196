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

#include "core/base/quantile.h"
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
    middle[axis] = UpperMedian(std::move(values));
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
      measurements_(overlay_, 0.0),
      labels_(overlay_),
      clip_(overlay_, {points_, sample_, residuals_}),
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
  rest_.setSingleShot(true);
  rest_.setInterval(150);
  connect(&rest_, &QTimer::timeout, this, &CloudCanvas::viewRested);
  setMinimumSize(120, 54);
  setFocusPolicy(Qt::ClickFocus);
  setAccessibleName(tr("3D cloud"));
}

void CloudCanvas::SetPoints(const PointSet& set, ColorMap map, const ValueRange& range) {
  PutPoints(set);
  const auto table = VtkTableOf(map, range);
  for (vtkActor* actor : {points_.Get(), sample_.Get()}) {
    MapperOf(actor)->SetLookupTable(table);
    MapperOf(actor)->SetScalarRange(range.low, range.high);
  }
  home_.focal = MiddleOf(set);
  home_.distance_m = std::max(0.5, 2.1 * (home_.focal - set.viewpoint.cast<double>()).norm());
  home_.azimuth_rad = -0.25;
  home_.elevation_rad = 0.45;
  if (!moved_) GoHome();
  Redraw();
}

void CloudCanvas::PutPoints(const PointSet& set) {
  MapperOf(points_)->SetInputData(VtkPointsOf(set, set.points.size()));
  MapperOf(sample_)->SetInputData(VtkPointsOf(set, kSamplePoints));
}

void CloudCanvas::ReplacePoints(const PointSet& set) {
  PutPoints(set);
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

void CloudCanvas::SetMeasuring(bool measuring, bool wants_plane) {
  measuring_ = measuring;
  wants_plane_ = wants_plane;
  setCursor(measuring || drawing_ ? Qt::CrossCursor : Qt::ArrowCursor);
}

void CloudCanvas::SetMeasurements(const std::vector<RobotMeasurement>& measurements) {
  measurements_.Clear();
  labels_.Clear();
  for (const RobotMeasurement& one : measurements) {
    measurements_.Add(one.lines, one.style);
    measurements_.Add(one.points, one.style);
    if (!one.label.empty()) labels_.Add(one.label_at, one.label, one.style.color);
  }
  Redraw();
}

void CloudCanvas::LookAt(const Eigen::Vector3d& place) {
  camera_.focal = place;
  moved_ = true;
  rest_.start();
  PlaceCamera();
  Q_EMIT cameraMoved();
  Redraw();
}

void CloudCanvas::SetResiduals(const PointSet& set) {
  residuals_->SetVisibility(set.points.empty() ? 0 : 1);
  if (!set.points.empty()) MapperOf(residuals_)->SetInputData(VtkPointsOf(set, set.points.size()));
  Redraw();
}

void CloudCanvas::GoHome() {
  camera_ = home_;
  moved_ = false;
  PlaceCamera();
  Q_EMIT cameraMoved();
  Redraw();
}

void CloudCanvas::ResetView() {
  GoHome();
  rest_.start();
}

void CloudCanvas::SetClipBox(const std::optional<Eigen::AlignedBox3d>& box) {
  clip_.Set(box);
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
      pressed_at_ = {-1000, -1000};  // of two quick clicks only the first is one
      if (measuring_) return true;
      LookAtPointUnder(static_cast<QMouseEvent*>(event)->localPos());
      return true;
    case QEvent::Wheel:
      camera_.Zoom(std::pow(0.9985, static_cast<QWheelEvent*>(event)->angleDelta().y()));
      moved_ = true;
      rest_.start();
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
  pressed_at_ = event.pos();
  const bool grabs = event.button() == Qt::LeftButton &&
                     clip_.Grab(event.localPos(), [this](const Eigen::Vector3d& point) {
                       return WidgetPointFromRobot(point);
                     });
  if (grabs) return;
  const bool draws_plane = measuring_ && wants_plane_ && event.modifiers() & Qt::ShiftModifier;
  if (drawing_ && event.button() == Qt::LeftButton && !shows_scan_) {
    Q_EMIT refused();
  } else if ((drawing_ || draws_plane) && event.button() == Qt::LeftButton) {
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
  if (clip_.Grabbed()) {
    const Eigen::AlignedBox3d box =
        clip_.Drag(event.localPos(),
                   [this](const Eigen::Vector3d& point) { return WidgetPointFromRobot(point); });
    Q_EMIT clipBoxDragged(box);
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
  if (clip_.Grabbed()) {
    clip_.Release();
    Q_EMIT viewRested();
    return;
  }
  if (!rectangle_->isVisible() || event.button() != Qt::LeftButton) {
    ShowSample(false);
    rest_.start();
    const bool clicked = (event.pos() - pressed_at_).manhattanLength() <= kClickSlack_px;
    if (measuring_ && clicked && event.button() == Qt::LeftButton)
      Q_EMIT pointClicked(ClickAt(event.pos()));
    return;
  }
  rectangle_->hide();
  const QRect drawn = QRect(rectangle_begin_, event.pos()).normalized();
  if (drawn.width() < kSmallestRectangle_px || drawn.height() < kSmallestRectangle_px) return;
  CloudRectangle rectangle;
  rectangle.clip_from_robot = ClipFromRobot();
  rectangle.corners = {ClipFrom(drawn.bottomLeft()), ClipFrom(drawn.topRight())};
  if (measuring_)
    Q_EMIT planeDrawn(rectangle);
  else
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

CloudClick CloudCanvas::ClickAt(const QPoint& position) const {
  constexpr double kReach_px = 10.0;
  CloudClick click;
  click.clip_from_robot = ClipFromRobot();
  click.at = ClipFrom(position);
  click.reach = {2.0 * kReach_px / std::max(1, width()), 2.0 * kReach_px / std::max(1, height())};
  if (const auto box = clip_.Box())
    click.shown = [box](const Eigen::Vector3d& point) { return box->contains(point); };
  return click;
}

QPointF CloudCanvas::WidgetPointFromRobot(const Eigen::Vector3d& point) const {
  const Eigen::Vector4d clip = ClipFromRobot() * point.homogeneous();
  const Eigen::Vector2d at = clip.head<2>() / clip.w();
  return {0.5 * (at.x() + 1.0) * width(), 0.5 * (1.0 - at.y()) * height()};
}

QPoint CloudCanvas::WidgetFromRobot(const Eigen::Vector3d& point) const {
  const QPointF at = WidgetPointFromRobot(point);
  return {static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y()))};
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
  LookAt({picked[0], picked[1], picked[2]});
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
