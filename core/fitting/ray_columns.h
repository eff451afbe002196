#pragma once

#include <cstddef>
#include <vector>

namespace foresight {

/// Rays side by side, for vector instructions: a column a coordinate, in base. Padded to a multiple
/// of kLanes with rays that are far from everything.
struct RayColumns {
  static constexpr std::size_t kLanes = 8;

  std::vector<double> origin_x, origin_y, origin_z;
  std::vector<double> direction_x, direction_y, direction_z;  ///< length 1
  std::vector<double> reach_m;  ///< how close an object has to come before it changes anything
  std::size_t count = 0;        ///< without the padding

  void Reserve(std::size_t rays);
  void Add(const double* origin, const double* direction, double reach);
  /// Once all are added.
  void Pad();
  std::size_t Padded() const { return reach_m.size(); }
};

}  // namespace foresight
