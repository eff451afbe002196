#pragma once

#include <span>

#include "core/fitting/terrain/block_rectangle.h"

namespace foresight {

class BlockOutline;

/// How much better the size of a block (within 4 % of each side) explains the measurements of a
/// plane than any that is a tenth to a third longer or shorter, as a fraction of the block's area;
/// of the side that is known worse. Near 0 where an edge is not seen, negative where another size
/// explains them better.
///
/// Each side is measured for itself: the score that FitRectangles asks of a rectangle is asked of
/// all places of both its ends. What lies in one of the `others`, rectangles on the same plane, is
/// not the block's. Where an image shows the plane (else `outline` is null), a line that looks like
/// an edge speaks for an end there.
double SizeMargin(const PlaneView& view, const BlockRectangle& rectangle,
                  std::span<const BlockRectangle> others, const BlockOutline* outline);

}  // namespace foresight
