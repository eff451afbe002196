#include "ui/views/depth_canvas.h"

#include <vtkCamera.h>
#include <vtkImageMapper3D.h>
#include <vtkImageProperty.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <QMouseEvent>
#include <algorithm>
#include <cmath>

#include "ui/render/vtk_data.h"
#include "ui/views/overlay_style.h"

namespace foresight {
namespace {

vtkSmartPointer<vtkActor> LineActor(Rgb8 color, float width) {
  auto actor = vtkSmartPointer<vtkActor>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(VtkLinesOf({}));
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color.r / 255.0, color.g / 255.0, color.b / 255.0);
  actor->GetProperty()->SetLineWidth(width);
  actor->GetProperty()->LightingOff();
  actor->SetPosition(0.0, 0.0, 1.0);  // in front of the image
  return actor;
}

constexpr double kCanvasGrip_px = 7.0;  ///< how near to the wipe line counts as on it
constexpr double kWipeStep = 0.02;      ///< of the width, for an arrow key
constexpr double kWipeBigStep = 0.10;   ///< the same with Shift

void SetLines(vtkActor* actor, const Polylines& lines) {
  static_cast<vtkPolyDataMapper*>(actor->GetMapper())->SetInputData(VtkLinesOf(lines));
}

}  // namespace

DepthCanvas::DepthCanvas(QWidget* parent)
    : VtkCanvas(parent),
      renderer_(vtkSmartPointer<vtkRenderer>::New()),
      image_(vtkSmartPointer<vtkImageActor>::New()),
      wipe_(renderer_),
      marks_(renderer_),
      second_marks_(renderer_),
      outlines_(renderer_, 0.9),
      measurements_(renderer_, 0.94),
      labels_(renderer_),
      region_(LineActor(kRoiColor, 2.0f)),
      gesture_actor_(LineActor(kRoiColor, 2.0f)) {
  renderWindow()->AddRenderer(renderer_);
  renderer_->SetBackground(0.09, 0.10, 0.12);
  renderer_->GetActiveCamera()->ParallelProjectionOn();
  image_->GetMapper()->SetInputData(VtkImageOf(ColorImage(1, 1)));
  renderer_->AddActor(image_);
  for (const auto& actor : {region_, gesture_actor_}) renderer_->AddActor(actor);
  PartMarks();
  setMinimumSize(120, 54);
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);  // the wipe line moves by keys alone
  setAccessibleName(tr("Depth map"));
}

void DepthCanvas::SetImage(const ColorImage& image) {
  const bool same_size = image.width() == image_width_ && image.height() == image_height_;
  image_width_ = std::max(1, image.width());
  image_height_ = std::max(1, image.height());
  image_->GetMapper()->SetInputData(VtkImageOf(image));
  if (!same_size) shows_all_ = true;
  if (shows_all_) ShowAll();
  Redraw();
}

void DepthCanvas::SetSecond(const ColorImage* image) {
  wipe_.SetImage(image);
  PartMarks();
  Redraw();
}

void DepthCanvas::SetWipe(double fraction) {
  wipe_.SetFraction(fraction);
  PartMarks();
  Redraw();
}

void DepthCanvas::SetMarks(std::vector<SampleMark> marks) {
  marks_.Set(std::move(marks), image_height_);
  Redraw();
}

void DepthCanvas::SetSecondMarks(std::optional<std::vector<SampleMark>> marks) {
  second_has_marks_ = marks.has_value();
  second_marks_.Set(marks ? std::move(*marks) : std::vector<SampleMark>(), image_height_);
  PartMarks();
  Redraw();
}

void DepthCanvas::PartMarks() {
  if (wipe_.Shown() && second_has_marks_) {
    marks_.ShowLeftOf(wipe_.Column());
    second_marks_.ShowRightOf(wipe_.Column());
  } else {
    marks_.ShowEverywhere();
    second_marks_.Hide();
  }
}

void DepthCanvas::SetRegion(const PixelLines& lines) {
  SetLines(region_, InWorld(lines));
  Redraw();
}

Polylines DepthCanvas::InWorld(const PixelLines& lines) const {
  Polylines in_world;
  for (const auto& line : lines) {
    auto& world_line = in_world.emplace_back();
    for (const auto& pixel : line)
      world_line.emplace_back(pixel.x(), image_height_ - 1 - pixel.y(), 0.0);
  }
  return in_world;
}

void DepthCanvas::SetOutlines(const std::vector<PixelOutline>& outlines) {
  outlines_.Clear();
  for (const PixelOutline& outline : outlines) outlines_.Add(InWorld(outline.lines), outline.style);
  Redraw();
}

void DepthCanvas::SetDrawing(bool drawing, RegionShape shape) {
  if (drawing != drawing_) gesture_.Cancel();
  drawing_ = drawing;
  gesture_.SetShape(shape);
  setCursor(drawing ? Qt::CrossCursor : Qt::OpenHandCursor);
  DrawGesture();
}

void DepthCanvas::SetPicking(bool picking) {
  picking_ = picking;
  setCursor(drawing_ || picking_ ? Qt::CrossCursor : Qt::OpenHandCursor);
}

void DepthCanvas::SetMeasurements(const std::vector<PixelMeasurement>& measurements) {
  measurements_.Clear();
  labels_.Clear();
  for (const PixelMeasurement& one : measurements) {
    measurements_.Add(InWorld(one.lines), one.style);
    measurements_.Add(InWorld(one.points), one.style);
    if (!one.label.empty() && one.label_at)
      labels_.Add({one.label_at->x(), image_height_ - 1 - one.label_at->y(), 1.1}, one.label,
                  one.style.color);
  }
  Redraw();
}

void DepthCanvas::CentreOn(const Eigen::Vector2d& pixel) {
  if (shows_all_) return;  // it is seen already
  center_ = {pixel.x(), image_height_ - 1 - pixel.y()};
  PlaceCamera();
  Redraw();
}

void DepthCanvas::ShowAll() {
  shows_all_ = true;
  const double scale = std::max(static_cast<double>(image_width_) / std::max(1, width()),
                                static_cast<double>(image_height_) / std::max(1, height()));
  half_height_ = 0.5 * scale * height();
  center_ = {0.5 * (image_width_ - 1), 0.5 * (image_height_ - 1)};
  PlaceCamera();
}

void DepthCanvas::PlaceCamera() {
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->SetFocalPoint(center_.x(), center_.y(), 0.0);
  camera->SetPosition(center_.x(), center_.y(), 10.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
  camera->SetParallelScale(half_height_);
  camera->SetClippingRange(1.0, 20.0);
  for (MarkActors* marks : {&marks_, &second_marks_}) marks->SetScale(Scale());
}

double DepthCanvas::Scale() const {
  return 2.0 * half_height_ / std::max(1, height());
}

Eigen::Vector2d DepthCanvas::PixelAt(const QPointF& position) const {
  const double x = center_.x() + (position.x() - 0.5 * width()) * Scale();
  const double y = center_.y() - (position.y() - 0.5 * height()) * Scale();
  return {x, image_height_ - 1 - y};
}

QPoint DepthCanvas::WidgetFromPixel(const Eigen::Vector2d& pixel) const {
  const double y = image_height_ - 1 - pixel.y();
  return {static_cast<int>(std::lround(0.5 * width() + (pixel.x() - center_.x()) / Scale())),
          static_cast<int>(std::lround(0.5 * height() - (y - center_.y()) / Scale()))};
}

bool DepthCanvas::event(QEvent* event) {
  switch (event->type()) {
    case QEvent::MouseButtonPress:
      if (OnPress(*static_cast<QMouseEvent*>(event))) return true;
      break;
    case QEvent::MouseMove:
      if (OnMove(*static_cast<QMouseEvent*>(event))) return true;
      break;
    case QEvent::MouseButtonRelease:
      if (OnRelease(*static_cast<QMouseEvent*>(event))) return true;
      break;
    case QEvent::MouseButtonDblClick:
      if (drawing_) Finish(gesture_.Close());
      return true;
    case QEvent::Wheel:
      OnWheel(*static_cast<QWheelEvent*>(event));
      return true;
    case QEvent::KeyPress:
      if (OnKey(*static_cast<QKeyEvent*>(event))) return true;
      event->ignore();  // VTK's own keys (e, q, w) must not reach an operator
      return false;
    default:
      break;
  }
  return VtkCanvas::event(event);
}

bool DepthCanvas::OnKey(const QKeyEvent& event) {
  if (const auto handled = gesture_.Key(event.key())) {
    Finish(*handled);
    return true;
  }
  const bool left = event.key() == Qt::Key_Left, right = event.key() == Qt::Key_Right;
  if (!wipe_.Shown() || !(left || right)) return false;
  const double step = event.modifiers() & Qt::ShiftModifier ? kWipeBigStep : kWipeStep;
  Q_EMIT wiped(wipe_.Fraction() + (right ? step : -step));
  return true;
}

bool DepthCanvas::OnWipeLine(const QPointF& position) const {
  if (!wipe_.Shown()) return false;
  return std::abs(position.x() - WidgetFromPixel({wipe_.Column(), 0.0}).x()) <= kCanvasGrip_px;
}

void DepthCanvas::WipeTo(const QPointF& position) {
  Q_EMIT wiped((PixelAt(position).x() + 0.5) / image_width_);
}

void DepthCanvas::ShowCursor(const QPointF& position) {
  const Qt::CursorShape shape = wiping_ || OnWipeLine(position) ? Qt::SplitHCursor
                                : drawing_ || picking_          ? Qt::CrossCursor
                                                                : Qt::OpenHandCursor;
  if (cursor().shape() != shape) setCursor(shape);
}

bool DepthCanvas::OnPress(const QMouseEvent& event) {
  setFocus();
  pressed_at_ = event.localPos();
  if (event.button() == Qt::LeftButton && OnWipeLine(event.localPos())) {
    wiping_ = true;
  } else if (drawing_ && event.button() == Qt::LeftButton) {
    Finish(gesture_.Press(PixelAt(event.localPos())));
  } else {
    panning_ = true;
    pan_from_ = event.localPos();
  }
  return true;
}

bool DepthCanvas::OnMove(const QMouseEvent& event) {
  if (wiping_) {
    WipeTo(event.localPos());
  } else if (gesture_.Active()) {
    gesture_.Move(PixelAt(event.localPos()));
    DrawGesture();
  } else if (panning_) {
    const QPointF way = event.localPos() - pan_from_;
    pan_from_ = event.localPos();
    shows_all_ = false;
    center_ += Scale() * Eigen::Vector2d(-way.x(), way.y());
    PlaceCamera();
    Redraw();
  }
  ShowCursor(event.localPos());
  Q_EMIT pixelPointedAt(PixelAt(event.localPos()));
  return true;
}

bool DepthCanvas::OnRelease(const QMouseEvent& event) {
  const bool clicked =
      panning_ && (event.localPos() - pressed_at_).manhattanLength() <= kClickSlack_px;
  panning_ = wiping_ = false;
  if (picking_ && clicked && event.button() == Qt::LeftButton) {
    const Eigen::Vector2d pixel = PixelAt(event.localPos());
    Q_EMIT pixelClicked(pixel, wipe_.Shown() && pixel.x() > wipe_.Column());
  }
  if (event.button() == Qt::LeftButton) Finish(gesture_.Release(PixelAt(event.localPos())));
  return true;
}

void DepthCanvas::OnWheel(const QWheelEvent& event) {
  const QPointF middle(0.5 * width(), 0.5 * height());
  const QPointF off = event.position() - middle;
  const Eigen::Vector2d offset(off.x(), -off.y());
  const Eigen::Vector2d under_mouse = center_ + Scale() * offset;
  half_height_ = std::clamp(half_height_ * std::pow(0.9985, event.angleDelta().y()), 5.0, 1e5);
  center_ = under_mouse - Scale() * offset;
  shows_all_ = false;
  PlaceCamera();
  Redraw();
}

void DepthCanvas::resizeEvent(QResizeEvent* event) {
  VtkCanvas::resizeEvent(event);
  if (shows_all_)
    ShowAll();
  else
    PlaceCamera();
}

void DepthCanvas::Finish(const std::optional<RegionGesture::Points>& points) {
  DrawGesture();
  if (points) Q_EMIT regionDrawn(*points);
}

void DepthCanvas::DrawGesture() {
  RegionGesture::Points preview = gesture_.Preview();
  if (!preview.empty()) preview.push_back(preview.front());
  SetLines(gesture_actor_, preview.empty() ? Polylines() : InWorld({preview}));
  Redraw();
}

}  // namespace foresight
