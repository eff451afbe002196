#pragma once

#include <QGraphicsView>

#include "core/base/image.h"
#include "core/fitting/roi.h"
#include "core/pictures/projected_wireframe.h"
#include "core/pictures/sample_marks.h"
#include "ui/views/roi_drag.h"

class QGraphicsPathItem;
class QGraphicsPixmapItem;

namespace foresight {

/// A camera picture with regions and templates drawn over it. Scene coordinates are pixels: (0, 0)
/// is the centre of the first one. Wheel zooms, dragging pans or, in drawing mode, draws a region.
class ImageCanvas : public QGraphicsView {
  Q_OBJECT

 public:
  explicit ImageCanvas(QWidget* parent = nullptr);

  void SetPicture(const ColorImage& picture);
  void SetRoi(const std::optional<ImageRoi>& roi);
  void SetTemplates(const PixelLines& lines);
  void SetMarks(std::vector<SampleMark> marks);
  void SetDrawing(bool drawing);
  void ShowAll();
  /// Where a pixel of the picture is on this widget.
  QPoint WidgetFromPixel(const Eigen::Vector2d& pixel) const;

 Q_SIGNALS:
  void roiDrawn(const Eigen::Vector2d& corner_a, const Eigen::Vector2d& corner_b);

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void drawForeground(QPainter* painter, const QRectF& rect) override;

 private:
  Eigen::Vector2d PixelAt(const QPoint& position) const;
  void DrawDrag();

  QGraphicsPixmapItem* picture_;
  std::vector<SampleMark> marks_;
  QGraphicsPathItem* templates_shadow_;
  QGraphicsPathItem* templates_;
  QGraphicsPathItem* roi_;
  QGraphicsPathItem* drag_item_;
  RoiDrag drag_;
  bool drawing_ = false;
  bool shows_all_ = true;
};

}  // namespace foresight
