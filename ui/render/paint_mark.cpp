#include "ui/render/paint_mark.h"

#include <algorithm>

namespace foresight {

MarkSize MarkSizeAt(double zoom) {
  const double half = std::clamp(4.0 * zoom, 2.2, 6.0);
  const double line = std::clamp(0.3 * half, 1.0, 1.8);
  return {half, line, line + std::min(1.6, 0.35 * half)};
}

void PaintMark(QPainter* painter, RejectReason kind, Rgb8 color, const QPointF& center,
               const MarkSize& size) {
  const QColor ink(color.r, color.g, color.b);
  const QColor rim(0, 0, 0, 170);
  if (kind == RejectReason::kKept) {
    for (const auto& [side, fill] :
         {std::pair(size.line_px + 2.2, rim), std::pair(size.line_px + 0.8, ink)})
      painter->fillRect(QRectF(center.x() - side / 2, center.y() - side / 2, side, side), fill);
    return;
  }
  for (const auto& [pen_color, width] :
       {std::pair(rim, size.rim_px), std::pair(ink, size.line_px)}) {
    painter->setPen(QPen(pen_color, width));
    for (const auto& stroke : StrokesOf(kind)) {
      QPolygonF line;
      for (const Eigen::Vector2d& corner : stroke)
        line << center + size.half_px * QPointF(corner.x(), corner.y());
      painter->drawPolyline(line);
    }
  }
}

}  // namespace foresight
