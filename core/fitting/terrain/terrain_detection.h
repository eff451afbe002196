#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/fitting/fit_origin.h"
#include "core/fitting/verdict.h"
#include "core/geometry/rigid.h"

namespace foresight {

/// How well the measurements support a block's top.
struct BlockEvidence {
  int points = 0;            ///< of its plane, inside the rectangle
  double cover = 0.0;        ///< fraction of the rectangle with support
  double see_through = 0.0;  ///< ... with beams that went through
  double outside = 0.0;      ///< support beyond the rectangle, as a fraction of its area
  int confirmed_edges = 0;   ///< 0 to 4: support inside, none outside
  double rms_m = 0.0;        ///< of the points from the plane
  /// How much more its sides look like edges in the image than lines across it do
  /// (BlockOutline::Outline); 0 where no image shows half of them.
  double outline_nats = 0.0;
  /// How much better a block's size explains it than any that is a tenth and more longer or
  /// shorter, as a fraction of its area; negative where another explains it better. An image that
  /// shows it has its say.
  double size_margin = 0.0;
  /// The odds, in nats, that it has a block's size, by its own margin and those of the other tops
  /// of the region (NatsAmongOthers).
  double size_nats = 0.0;
};

/// Where a foot may stand: the rectangle shrunk by a margin.
struct Toehold {
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();  ///< along the surface's x and y; 0 = none
  double slope_rad = 0.0;                            ///< of the surface against level
  /// Height of its centre above that of the nearest other block, within 0.7 m, else above the
  /// ground below it; NaN = neither.
  double step_m = std::nan("");
  double sigma_height_m = 0.0;
  double sigma_tilt_rad = 0.0;
};

/// One surface of rough terrain.
struct TerrainSurface {
  enum class Kind {
    kBlock,    ///< the top of a block of the known size
    kGround,   ///< level, and nothing level that is as large as a block's top lies below it
    kUnknown,  ///< a plane that is neither; never a foothold
  };

  Kind kind = Kind::kUnknown;
  /// The origin is the middle of the top, z its normal (up), x along its long side,
  /// pointing right. Which side is the long one cannot be seen where they differ by little. In
  /// base.
  Rigid<frame::Base, frame::Object> base_from_object;
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();  ///< along x and y
  PoseCovariance covariance = PoseCovariance::Constant(std::nan(""));
  BlockEvidence evidence;
  Toehold toehold;
  Verdict verdict;
  /// How far its centre is from the block of the last accepted scan that it matches; NaN = none.
  double shift_m = std::nan("");
  double turn_rad = std::nan("");
};
/// "block", "ground", "unknown".
const char* ToString(TerrainSurface::Kind kind);

/// All surfaces of a region.
struct TerrainDetection {
  std::vector<TerrainSurface> surfaces;  ///< offered blocks, other blocks, the rest; nearest first
  /// Which surface each ray of the region belongs to, for colours; -1 = none.
  std::vector<int> labels;
  Verdict verdict;  ///< of the whole: as good as its worst block that is offered as a foothold
  FitOrigin origin;
};

}  // namespace foresight
