#include "core/selfcheck/depth_edges.h"

#include <algorithm>
#include <cmath>

namespace foresight {
namespace {

class EdgeFinder {
 public:
  EdgeFinder(const RegisteredScan& cloud, const DepthEdgeOptions& options)
      : cloud_(cloud), options_(options) {}

  std::vector<DepthEdge> Run() {
    for (int line = 0; line < cloud_.lines; ++line)
      for (int beam = 1; beam + 2 < cloud_.beams; ++beam) Try(line, beam);
    return std::move(edges_);
  }

 private:
  double Range(int line, int beam) const { return cloud_.range_m[cloud_.Index(line, beam)]; }

  /// Between the beam and the next one.
  void Try(int line, int beam) {
    const double range = Range(line, beam), next = Range(line, beam + 1);
    const double jump = std::abs(range - next);
    // NaN fails each comparison.
    if (!(jump >= options_.least_jump_m &&
          jump >= options_.least_jump_of_range * std::min(range, next) &&
          jump <= options_.most_jump_m))
      return;
    const double before = std::abs(range - Range(line, beam - 1));
    const double after = std::abs(next - Range(line, beam + 2));
    const double slopes = !options_.near_alone ? std::max(before, after)
                          : range < next       ? before
                                               : after;
    if (!(slopes * options_.least_jump_of_slope < jump)) return;
    range < next ? Add(line, beam, beam + 1) : Add(line, beam + 1, beam);
  }

  void Add(int line, int near, int far) {
    const Eigen::Vector3d origin = cloud_.origins[static_cast<std::size_t>(line)].cast<double>();
    const Eigen::Vector3d to_near = cloud_.points[cloud_.Index(line, near)].cast<double>() - origin;
    const Eigen::Vector3d to_far = cloud_.points[cloud_.Index(line, far)].cast<double>() - origin;
    const double range = to_near.norm();
    const Eigen::Vector3d across = range * (to_far.normalized() - to_near / range);
    edges_.push_back({origin + to_near + 0.5 * across, across, to_far.norm() - range});
  }

  const RegisteredScan& cloud_;
  const DepthEdgeOptions& options_;
  std::vector<DepthEdge> edges_;
};

}  // namespace

DepthEdgeOptions DepthEdgeOptions::OfImported() {
  DepthEdgeOptions options;
  options.least_jump_of_range = 0.02;
  options.least_jump_of_slope = 2.0;
  options.near_alone = true;
  return options;
}

std::vector<DepthEdge> FindDepthEdges(const RegisteredScan& cloud,
                                      const DepthEdgeOptions& options) {
  return EdgeFinder(cloud, options).Run();
}

}  // namespace foresight
