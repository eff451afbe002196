#pragma once

#include <cstdint>
#include <map>
#include <span>

namespace foresight {

/// How far one method is ahead of another on the same scenes.
struct PairedLead {
  int scenes = 0;       ///< that both were tried on
  int only_first = 0;   ///< right answers of the first beyond those of the second, over the scenes
  int only_second = 0;  ///< ... and the other way round
  double lead = 0.0;    ///< of the first: mean difference of right answers a scene; NaN without any
  /// 95 % of the mean difference, from its spread over the scenes with one more scene that speaks
  /// for either (Agresti and Min 2005): ten scenes without a difference are no certainty.
  double low = 0.0;
  double high = 0.0;
};

/// `first` and `second` = right answers in each scene. O(scenes).
/// @pre both have the same size
PairedLead PairedLeadOf(std::span<const int> first, std::span<const int> second);

/// Right answers of each scene, by its seed.
using RightOfScenes = std::map<std::uint64_t, int>;

/// Over the scenes that both were tried on.
PairedLead LeadOverSharedScenes(const RightOfScenes& first, const RightOfScenes& second);

}  // namespace foresight
