#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/rigid.h"

namespace foresight {

/// A rectangle of pixels along the image's sides.
struct PixelBox {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d high = Eigen::Vector2d::Zero();
};

/// What the operator drew on the image or the depth map: a closed polygon in pixels of one image.
struct ImageRoi {
  double motor_rad = 0.0;                ///< which image: the motor's angle it was taken at
  std::vector<Eigen::Vector2d> polygon;  ///< at least 3 corners, pixels

  static ImageRoi Rectangle(double motor_rad, const Eigen::Vector2d& corner_a,
                            const Eigen::Vector2d& corner_b);

  /// What two clicks on opposite sides of an object mean: a circle around both, three tenths wider
  /// than they are apart.
  static ImageRoi AroundTwoClicks(double motor_rad, const Eigen::Vector2d& click_a,
                                  const Eigen::Vector2d& click_b);

  /// Even-odd rule; the boundary counts as inside.
  bool Contains(const Eigen::Vector2d& pixel) const;

  /// The smallest rectangle around all corners.
  PixelBox Bounds() const;

  /// Fails with kInvalidInput: fewer than 3 corners, not finite, or less than 4 px wide or high.
  Status Check() const;
};

/// A box that the operator put round something in the cloud.
struct BoxRoi {
  Rigid<frame::Base, frame::Object> base_from_box;  ///< the origin is the box's centre
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();

  /// The boundary counts as inside.
  bool Contains(const Eigen::Vector3d& point_in_base) const;

  /// Whether the straight way between two points in base touches the box.
  bool Crosses(const Eigen::Vector3d& from_in_base, const Eigen::Vector3d& to_in_base) const;

  /// Fails with kInvalidInput: not finite, or a side below a centimetre or beyond 100 m.
  Status Check() const;
};

/// The same region serves every object, source and method.
using Roi = std::variant<ImageRoi, BoxRoi>;

Status CheckRoi(const Roi& roi);

}  // namespace foresight
