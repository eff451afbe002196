#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/fitting/handle/handle_state.h"

namespace foresight {

/// The frame of a lever on its door: z = the door's normal, x along the lever, the origin on the
/// door under the pivot.
DoorFrame LeverFrame(const Plane& door, const HandleCandidate& handle);

/// Height over a door: a + b x + c y, and d more beyond an edge.
using DoorHeights = Eigen::Vector4d;

/// A straight edge across a lever.
struct DoorEdge {
  Eigen::Vector2d across = Eigen::Vector2d::UnitX();
  double place_m = 0.0;

  bool Beyond(const Eigen::Vector3d& at) const { return across.dot(at.head<2>()) > place_m; }
};

/// One way to explain points of a door.
struct DoorExplanation {
  DoorHeights heights = DoorHeights::Zero();
  std::optional<DoorEdge> edge;
  double cost = 0.0;  ///< half the sum of squared deviations, each at most kAgreeSigmas

  double Above(const Eigen::Vector3d& at) const;
};

/// Where edges may lie, across the lever.
struct EdgePlaces {
  double low_m = -std::numeric_limits<double>::infinity();
  double high_m = std::numeric_limits<double>::infinity();
};

/// Points of a door without its handle, in the lever's frame, and what explains them: one plane, or
/// two parallel ones 5 to 60 mm apart with an edge between them.
class DoorPoints {
 public:
  /// @param sigma_m of a height
  /// @param worth independent measurements behind a point
  DoorPoints(std::vector<Eigen::Vector3d> points, double sigma_m, double worth)
      : points_(std::move(points)), sigma_m_(sigma_m), worth_(worth) {}

  std::size_t size() const { return points_.size(); }
  /// The door's normal is z already, to so much: slopes are held near 0 by that.
  void ExpectSlopes(double sigma_rad) { slope_sigma_rad_ = sigma_rad; }
  /// Keeps at most about `most` of them, every n-th of them.
  void Thin(std::size_t most);

  /// Least squares over the points that agree with the start, again and again.
  DoorExplanation Improved(DoorExplanation start) const;

  /// The best edge within 10 deg of a right angle to the lever, which lies along x from 0 to
  /// `length_m`, and beside it; without one where none has enough points to either side.
  /// O(points x edges that are tried).
  DoorExplanation WithEdge(const DoorExplanation& flat, double length_m,
                           const EdgePlaces& places = {}) const;

  /// How much the points speak for the edge against none, in nats, beyond what is asked of it
  /// (Schwarz's criterion and 5 nats); -infinity without an edge.
  double ForEdge(const DoorExplanation& flat, const DoorExplanation& edged) const;

 private:
  /// Least and largest place across.
  std::pair<double, double> Extent(const Eigen::Vector2d& across) const;
  /// Takes the edge where it explains the points better.
  void Try(const DoorEdge& edge, double length_m, const EdgePlaces& places,
           DoorExplanation& best) const;
  std::size_t LeastSide() const;
  template <typename Agrees>
  DoorHeights LeastSquares(const std::optional<DoorEdge>& edge, const Agrees& agrees) const;
  double CostOf(const DoorExplanation& explanation) const;

  std::vector<Eigen::Vector3d> points_;
  double sigma_m_;
  double worth_;
  double slope_sigma_rad_ = std::numeric_limits<double>::infinity();
};

/// The points of rays that end near a door and not on its handle, in the lever's frame.
/// @param within what of the frame counts
DoorPoints PointsRound(const RaySet& rays, const Plane& door, const HandleCandidate& handle,
                       const std::function<bool(const Eigen::Vector3d&)>& within);

}  // namespace foresight
