#pragma once

#include <array>

#include "core/fitting/terrain/block_rectangle.h"
#include "core/fitting/terrain/terrain_detection.h"

namespace foresight {

/// What the bands on both sides of a block's edge hold, as fractions of the bands' areas.
struct BlockEdge {
  double inner_support = 0.0;
  double outer_support = 0.0;
  double outer_through = 0.0;   ///< beams that went on behind the plane
  double outer_occupied = 0.0;  ///< returns of something that rises or lies there

  /// Support inside, none outside, and beams that show it.
  bool Confirmed() const;
  /// ... because the surface drops there, not because something rises beside it.
  bool Drops() const;
};

/// All that speaks for and against a rectangle.
struct RectangleEvidence {
  BlockEvidence block;
  std::array<BlockEdge, 4> edges;  ///< towards +x, +y, -x, -y of the rectangle
  int dropping_edges = 0;
  /// How far the support's own extent is from the block's size, the larger of both directions.
  double size_error_m = 0.0;
  /// Whether it stands in rows with its neighbours (kNone: there are no rows), and how far its own
  /// edges have it from there.
  enum class Row { kNone, kIn, kOut };
  Row row = Row::kNone;
  double row_gap_sigmas = 0.0;
  bool in_image = false;  ///< an image shows at least half of its sides
};

RectangleEvidence GatherEvidence(const SurfaceGrid& grid, const PlaneView& view,
                                 const BlockRectangle& rectangle);

/// What the plane's points say of tilts, times what they do not know, that a top is no plane and
/// its points err together. Chosen on training scenes of home and of varied conditions, so that the
/// spreads over predicted that `evaluate-fits terrain` prints are near 1
/// (docs/evaluation/terrain.md, "Sigmas of terrain"). The verdict's weights know the tilt without
/// this factor.
inline constexpr double kTiltSigmaFactor = 1.35;

/// Of a small move and turn about the block's own axes: height and tilts from the plane's points,
/// place and yaw from its confirmed edges. `blur_m`: how well a point on an edge tells where it is.
PoseCovariance BlockCovariance(const SurfaceGrid& grid, const PlaneView& view,
                               const BlockRectangle& rectangle, const RectangleEvidence& evidence,
                               double blur_m);

}  // namespace foresight
