#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

namespace foresight {

/// The group, 0 to `groups` - 1, of each of some things, for deviations by leaving out a group:
/// neighbours in azimuth share one, so that one object's mistake is one group's. Groups are of as
/// many things each.
inline std::vector<int> NeighbourGroups(std::span<const double> azimuths_rad, int groups) {
  std::vector<std::size_t> order(azimuths_rad.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return azimuths_rad[a] < azimuths_rad[b]; });
  std::vector<int> group_of(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    group_of[order[i]] = static_cast<int>(i * static_cast<std::size_t>(groups) / order.size());
  return group_of;
}

}  // namespace foresight
