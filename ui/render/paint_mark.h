#pragma once

#include <QPainter>

#include "core/pictures/sample_marks.h"

namespace foresight {

/// How large a symbol and its lines are on the screen. Small where the whole image is seen, or
/// thousands of symbols would hide it.
struct MarkSize {
  double half_px = 6.0;
  double line_px = 1.8;
  double rim_px = 3.5;  ///< of the dark line below, which keeps a mark readable on any ground
};
/// @param zoom pixels of the screen in a pixel of the image
MarkSize MarkSizeAt(double zoom);

/// Draws the mark with its middle at `center`.
void PaintMark(QPainter* painter, RejectReason kind, Rgb8 color, const QPointF& center,
               const MarkSize& size = {});

}  // namespace foresight
