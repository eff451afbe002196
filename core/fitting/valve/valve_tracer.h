#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/fitting/ray_set.h"
#include "core/fitting/valve/valve_state.h"

namespace foresight {

enum class ValvePart { kRim, kHub, kSpoke, kDisc, kLever, kStem };

/// How a ray passes the part of a valve that it intersects first, or that it misses by least. Each
/// part is a tube of elliptic section around its middle line.
struct ValveIntersection {
  ValvePart part = ValvePart::kRim;
  double middle_m = 0.0;  ///< range at which the ray is closest to the middle line
  double offset_m = 0.0;  ///< how close that is
  double radius_m = 0.0;  ///< half the section's width as seen along the ray
  double depth_m = 0.0;   ///< half the section's depth along a ray through its middle
  double lean = 0.0;      ///< how much nearer to the viewer (< 0) it is in the middle, per offset
  double stretch = 1.0;   ///< 1 / sine of the angle between ray and middle line
  /// In base, length 1: across both ray and middle line, from this to the ray. 0 for a disc, which
  /// has no sides.
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  Eigen::Vector2d on_rim = Eigen::Vector2d::Zero();  ///< closest point of a rim, object's frame
  double along_m = 0.0;  ///< of the closest point of a spoke, lever or stem, from its beginning
  int spoke = 0;         ///< which one

  /// How far round a rim its closest point lies, 0 to 1 from -x over -y.
  double FractionOfRim() const {
    return std::atan2(on_rim.y(), on_rim.x()) / (2.0 * std::numbers::pi) + 0.5;
  }
  /// Gap between ray and part; negative when the ray intersects it.
  double Clearance() const { return offset_m - radius_m; }
  /// Range at which the ray enters the part, or passes it closest.
  double Range() const;
};

/// A valve made ready for many rays: closed forms for ray against tube, several times faster than
/// tracing spheres through ValveModel::Distance and smooth enough for numeric derivatives.
class ValveTracer {
 public:
  ValveTracer(const ValveCandidate& valve, ValveParts parts);

  /// False for a ray that stays further than `margin_m` from all of the valve, so that Intersect
  /// can be saved.
  bool Near(const RangeRay& ray, double margin_m) const;

  /// Ranges count from the ray's origin; a valve behind it has a negative one. Of a ray that stays
  /// further than `reach_m` from all parts only that is known: its clearance is larger.
  ValveIntersection Intersect(const RangeRay& ray,
                              double reach_m = std::numeric_limits<double>::infinity()) const;

 private:
  struct LocalRay {
    Eigen::Vector3d origin;
    Eigen::Vector3d direction;
  };
  struct Bar {
    Eigen::Vector3d begin = Eigen::Vector3d::Zero();
    Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
    double length_m = 0.0;
    double radius_m = 0.0;
    double depth_m = 0.0;                                   ///< half of it, along ...
    Eigen::Vector3d depth_axis = Eigen::Vector3d::UnitZ();  ///< ... this, across direction
  };

  static bool StaysWithin(const LocalRay& ray, const Eigen::Vector3d& point, double reach_m);
  /// False for a ray that stays further than `reach_m` from the rim.
  bool PassesRim(const LocalRay& ray, double reach_m) const;
  ValveIntersection IntersectRim(const LocalRay& ray) const;
  ValveIntersection IntersectHub(const LocalRay& ray) const;
  /// Where along a bar a ray is closest to it.
  static double AlongBar(const LocalRay& ray, const Bar& bar);
  static ValveIntersection IntersectBar(ValvePart part, const LocalRay& ray, const Bar& bar,
                                        double along);
  ValveIntersection IntersectStem(const LocalRay& ray) const;
  ValveIntersection IntersectWheel(const LocalRay& ray, double reach_m) const;
  ValveIntersection IntersectLever(const LocalRay& ray) const;
  bool IntersectDisc(const LocalRay& ray, ValveIntersection& intersection) const;

  Eigen::Matrix3d object_from_base_;
  Eigen::Vector3d center_;
  ValveModel model_;
  ValveParts parts_;
  Eigen::Vector3d hub_;
  double reach_m_ = 0.0;
  std::array<Bar, 6> spokes_;
  Bar lever_;
  Bar stem_;
};

}  // namespace foresight
