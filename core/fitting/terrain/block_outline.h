#pragma once

#include <Eigen/Core>

#include "core/fitting/solids/image_edges.h"
#include "core/fitting/terrain/block_rectangle.h"

namespace foresight {

/// A rectangle and how well it is placed.
struct PlacedRectangle {
  BlockRectangle rectangle;
  /// Of its middle along its own sides, and of its turn; metres and radians.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double yaw_sigma_rad = 1.0;
};

/// A line as the image shows it.
struct LineInImage {
  double nats = 0.0;   ///< how much it looks like an edge: mean of ImageEdges::NatsOf where shown
  double shown = 0.0;  ///< fraction of it

  /// With what the rest of it is taken for.
  double NatsOr(double otherwise) const { return shown * nats + (1.0 - shown) * otherwise; }
};

/// What an image says of a rectangle's outline.
struct RectangleInImage {
  /// How much more its four sides look like edges than lines across the top do; 0 in an image that
  /// shows nothing, and of sides that it does not show.
  double nats = 0.0;
  double shown = 0.0;  ///< fraction of the sides
};

/// The sides of rectangles on a plane as an image shows them: a camera sees the edges of a top
/// several times finer than beams touch it. What it is given must outlive it. What hides a line
/// from the camera is not known here.
class BlockOutline {
 public:
  BlockOutline(const ImageEdges& image, const PlaneView& view) : image_(image), view_(view) {}

  /// Of the line across the rectangle's side `axis`, `at_m` from its middle, but for its corners.
  LineInImage Line(const BlockRectangle& rectangle, int axis, double at_m) const;

  RectangleInImage Outline(const BlockRectangle& rectangle) const;

  /// The rectangle moved and turned to where the image has its sides, as far as what is known of
  /// its place allows; 60 mm and 0.1 rad at most. O(pixels of the sides).
  PlacedRectangle Place(const PlacedRectangle& start) const;

 private:
  BlockRectangle MovedToSides(const PlacedRectangle& start) const;
  /// What the sides that are seen tell of where it is.
  PlacedRectangle WithSides(PlacedRectangle placed) const;
  /// How far the rectangle moves along its side `axis` for its edge to move by a pixel.
  double MetresPerPixel(const BlockRectangle& rectangle, int axis) const;

  const ImageEdges& image_;
  const PlaneView& view_;
};

}  // namespace foresight
