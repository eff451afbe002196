#include "core/fitting/terrain/plane_reach.h"

#include <algorithm>

namespace foresight {
namespace {

constexpr double kReach_m = 0.060;
constexpr int kMaxReach = 12;  // cells

}  // namespace

std::vector<int> PlaneReach::Around(const std::vector<int>& own) {
  std::vector<int> around = own;
  if (own.empty()) return around;
  const int mark = searches_++;
  double range_m = 0.0;
  for (const int i : own) {
    visited_[static_cast<std::size_t>(i)] = mark;
    range_m += grid_[i].range_m;
  }
  range_m /= static_cast<double>(own.size());
  const int rings = std::clamp(static_cast<int>(kReach_m / (range_m * grid_.step_rad().maxCoeff())),
                               1, kMaxReach);
  std::size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = around.size();
    for (; begin < end; ++begin)
      for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        const int j = grid_.Neighbor(around[begin], dx, dy);
        if (j < 0 || visited_[static_cast<std::size_t>(j)] == mark) continue;
        visited_[static_cast<std::size_t>(j)] = mark;
        around.push_back(j);
      }
  }
  return around;
}

}  // namespace foresight
