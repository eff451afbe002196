#include "ui/views/image_canvas.h"

#include <QGraphicsPathItem>
#include <QGraphicsPixmapItem>
#include <QGraphicsTextItem>
#include <QMouseEvent>
#include <QPainterPath>
#include <cmath>

#include "ui/render/paint_mark.h"
#include "ui/render/qimage_of.h"
#include "ui/views/overlay_style.h"

namespace foresight {
namespace {

QPen CosmeticPen(const QColor& color, double width, Qt::PenStyle style = Qt::SolidLine) {
  QPen pen(color, width, style);
  pen.setCosmetic(true);
  return pen;
}

QColor ColorFrom(Rgb8 color) {
  return {color.r, color.g, color.b};
}

template <class Points>
QPainterPath PathThrough(const Points& points, bool closed) {
  QPolygonF polygon;
  for (const Eigen::Vector2d& point : points) polygon << QPointF(point.x(), point.y());
  QPainterPath path;
  path.addPolygon(polygon);
  if (closed) path.closeSubpath();
  return path;
}

}  // namespace

ImageCanvas::ImageCanvas(QWidget* parent) : QGraphicsView(parent) {
  setScene(new QGraphicsScene(this));
  setFrameShape(QFrame::NoFrame);
  setRenderHint(QPainter::SmoothPixmapTransform);
  setRenderHint(QPainter::Antialiasing);
  setTransformationAnchor(AnchorUnderMouse);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setDragMode(ScrollHandDrag);
  setMinimumSize(120, 54);
  setAccessibleName(tr("Camera image"));

  image_ = scene()->addPixmap({});
  image_->setTransformationMode(Qt::SmoothTransformation);
  image_->setOffset(-0.5, -0.5);
  region_ = scene()->addPath({}, CosmeticPen(ColorFrom(kRoiColor), 1.5));
  gesture_item_ = scene()->addPath({}, CosmeticPen(ColorFrom(kRoiColor), 1.5, Qt::DashLine),
                                   QColor(255, 255, 255, 40));
}

void ImageCanvas::SetImage(const ColorImage& image) {
  const bool same_size = image_->pixmap().size() == QSize(image.width(), image.height());
  image_->setPixmap(QPixmap::fromImage(QImageOf(image)));
  scene()->setSceneRect(-0.5, -0.5, image.width(), image.height());
  if (!same_size) ShowAll();
}

void ImageCanvas::SetRegion(const PixelLines& lines) {
  QPainterPath path;
  for (const auto& line : lines) path.addPath(PathThrough(line, false));
  region_->setPath(path);
}

void ImageCanvas::SetOutlines(const std::vector<PixelOutline>& outlines) {
  for (QGraphicsPathItem* item : outlines_) delete item;
  outlines_.clear();
  for (const PixelOutline& outline : outlines) {
    QPainterPath path;
    for (const auto& line : outline.lines) path.addPath(PathThrough(line, false));
    const double width = outline.style.width_px;
    outlines_.push_back(scene()->addPath(path, CosmeticPen(QColor(12, 14, 18), width + 2.0)));
    outlines_.push_back(scene()->addPath(path, CosmeticPen(ColorFrom(outline.style.color), width)));
  }
}

void ImageCanvas::SetMarks(std::vector<SampleMark> marks) {
  marks_ = std::move(marks);
  viewport()->update();
}

void ImageCanvas::drawForeground(QPainter* painter, const QRectF&) {
  if (marks_.empty()) return;
  const QTransform view_from_scene = painter->worldTransform();
  const QRect visible = viewport()->rect();
  const MarkSize size = MarkSizeAt(view_from_scene.m11());
  painter->save();
  painter->resetTransform();  // symbols keep their size on the screen
  for (const SampleMark& mark : marks_) {
    const QPointF at = view_from_scene.map(QPointF(mark.pixel.x(), mark.pixel.y()));
    if (visible.contains(at.toPoint())) PaintMark(painter, mark.kind, mark.color, at, size);
  }
  painter->restore();
}

void ImageCanvas::SetDrawing(bool drawing, RegionShape shape) {
  if (drawing != drawing_) gesture_.Cancel();
  drawing_ = drawing;
  gesture_.SetShape(shape);
  setDragMode(drawing ? NoDrag : ScrollHandDrag);
  ShowCursor();
  DrawGesture();
}

void ImageCanvas::SetPicking(bool picking) {
  picking_ = picking;
  ShowCursor();
}

void ImageCanvas::ShowCursor() {
  viewport()->setCursor(drawing_ || picking_ ? Qt::CrossCursor : Qt::OpenHandCursor);
}

void ImageCanvas::SetMeasurements(const std::vector<PixelMeasurement>& measurements) {
  for (QGraphicsItem* item : measurements_) delete item;
  measurements_.clear();
  for (const PixelMeasurement& one : measurements) {
    QPainterPath path;
    for (const PixelLines* lines : {&one.lines, &one.points})
      for (const auto& line : *lines) path.addPath(PathThrough(line, false));
    const double width = one.style.width_px;
    const QColor color = ColorFrom(one.style.color);
    measurements_.push_back(scene()->addPath(path, CosmeticPen(QColor(12, 14, 18), width + 2.0)));
    measurements_.push_back(scene()->addPath(path, CosmeticPen(color, width)));
    if (one.label.empty() || !one.label_at) continue;
    auto* label = new QGraphicsTextItem;
    label->setHtml(
        QStringLiteral("<div style='background:rgba(12,14,18,190);'>&nbsp;%1&nbsp;</div>")
            .arg(QString::fromStdString(one.label).toHtmlEscaped()));
    label->setDefaultTextColor(color);
    label->setFlag(QGraphicsItem::ItemIgnoresTransformations);
    label->setPos(one.label_at->x(), one.label_at->y());
    scene()->addItem(label);
    measurements_.push_back(label);
  }
}

void ImageCanvas::CentreOn(const Eigen::Vector2d& pixel) {
  if (shows_all_) return;  // it is seen already
  centerOn(QPointF(pixel.x(), pixel.y()));
}

void ImageCanvas::ShowAll() {
  shows_all_ = true;
  if (!sceneRect().isEmpty()) fitInView(sceneRect(), Qt::KeepAspectRatio);
}

QPoint ImageCanvas::WidgetFromPixel(const Eigen::Vector2d& pixel) const {
  return mapFromScene(QPointF(pixel.x(), pixel.y()));
}

Eigen::Vector2d ImageCanvas::PixelAt(const QPoint& position) const {
  const QPointF scene_point = mapToScene(position);
  return {scene_point.x(), scene_point.y()};
}

void ImageCanvas::mousePressEvent(QMouseEvent* event) {
  pressed_at_ = event->pos();
  if (!drawing_ || event->button() != Qt::LeftButton) {
    QGraphicsView::mousePressEvent(event);
    return;
  }
  setFocus();
  Finish(gesture_.Press(PixelAt(event->pos())));
}

void ImageCanvas::mouseMoveEvent(QMouseEvent* event) {
  if (gesture_.Active()) {
    gesture_.Move(PixelAt(event->pos()));
    DrawGesture();
  } else {
    QGraphicsView::mouseMoveEvent(event);
  }
}

void ImageCanvas::mouseReleaseEvent(QMouseEvent* event) {
  if (drawing_ && event->button() == Qt::LeftButton)
    Finish(gesture_.Release(PixelAt(event->pos())));
  else
    QGraphicsView::mouseReleaseEvent(event);
  const bool moved = (event->pos() - pressed_at_).manhattanLength() > kClickSlack_px;
  if (picking_ && !drawing_ && !moved && event->button() == Qt::LeftButton)
    Q_EMIT pixelClicked(PixelAt(event->pos()));
  if (picking_) ShowCursor();
}

void ImageCanvas::mouseDoubleClickEvent(QMouseEvent* event) {
  pressed_at_ = {-1000, -1000};  // of two quick clicks only the first is one
  if (drawing_)
    Finish(gesture_.Close());
  else
    QGraphicsView::mouseDoubleClickEvent(event);
}

void ImageCanvas::keyPressEvent(QKeyEvent* event) {
  if (const auto handled = gesture_.Key(event->key()))
    Finish(*handled);
  else
    event->ignore();  // arrows and letters belong to the window's shortcuts
}

void ImageCanvas::Finish(const std::optional<RegionGesture::Points>& points) {
  DrawGesture();
  if (points) Q_EMIT regionDrawn(*points);
}

void ImageCanvas::wheelEvent(QWheelEvent* event) {
  const double factor = std::pow(1.0015, event->angleDelta().y());
  shows_all_ = false;
  scale(factor, factor);
}

void ImageCanvas::resizeEvent(QResizeEvent* event) {
  QGraphicsView::resizeEvent(event);
  if (shows_all_) ShowAll();
}

void ImageCanvas::showEvent(QShowEvent* event) {
  QGraphicsView::showEvent(event);
  if (shows_all_) ShowAll();
}

void ImageCanvas::DrawGesture() {
  const RegionGesture::Points preview = gesture_.Preview();
  gesture_item_->setPath(preview.empty() ? QPainterPath() : PathThrough(preview, true));
}

}  // namespace foresight
