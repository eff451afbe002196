#pragma once

#include <QGraphicsView>

#include "core/base/image.h"
#include "core/pictures/sample_marks.h"
#include "ui/viewmodels/region_gesture.h"
#include "ui/views/measurement_lines.h"
#include "ui/views/outlines.h"

class QGraphicsItem;
class QGraphicsPathItem;
class QGraphicsPixmapItem;

namespace foresight {

/// A camera image with regions and templates drawn over it. Scene coordinates are pixels: (0, 0)
/// is the centre of the first one. Wheel zooms, dragging pans or, in drawing mode, draws a region.
class ImageCanvas : public QGraphicsView {
  Q_OBJECT

 public:
  explicit ImageCanvas(QWidget* parent = nullptr);

  void SetImage(const ColorImage& image);
  void SetRegion(const PixelLines& lines);
  void SetOutlines(const std::vector<PixelOutline>& outlines);
  void SetMarks(std::vector<SampleMark> marks);
  void SetDrawing(bool drawing, RegionShape shape);
  /// A click on a pixel is told; dragging pans as ever.
  void SetPicking(bool picking);
  void SetMeasurements(const std::vector<PixelMeasurement>& measurements);
  void CentreOn(const Eigen::Vector2d& pixel);
  void ShowAll();
  /// Where a pixel of the image is on this widget.
  QPoint WidgetFromPixel(const Eigen::Vector2d& pixel) const;

 Q_SIGNALS:
  void regionDrawn(const std::vector<Eigen::Vector2d>& points);
  void pixelClicked(const Eigen::Vector2d& pixel);

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void drawForeground(QPainter* painter, const QRectF& rect) override;

 private:
  Eigen::Vector2d PixelAt(const QPoint& position) const;
  void Finish(const std::optional<RegionGesture::Points>& points);
  void DrawGesture();
  void ShowCursor();

  QGraphicsPixmapItem* image_;
  std::vector<SampleMark> marks_;
  std::vector<QGraphicsPathItem*> outlines_;
  QGraphicsPathItem* region_;
  QGraphicsPathItem* gesture_item_;
  RegionGesture gesture_;
  std::vector<QGraphicsItem*> measurements_;
  QPoint pressed_at_;
  bool picking_ = false;
  bool drawing_ = false;
  bool shows_all_ = true;
};

}  // namespace foresight
