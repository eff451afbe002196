#include "core/selfcheck/depth_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace foresight {
namespace {

class EdgeFinder {
 public:
  EdgeFinder(const RegisteredScan& cloud, const DepthEdgeOptions& options)
      : cloud_(cloud), options_(options) {}

  std::vector<DepthEdge> Run() {
    for (int line = 0; line < cloud_.lines; ++line) {
      first_of_line_.push_back(edges_.size());
      for (int beam = 1; beam + 2 < cloud_.beams; ++beam) Try(line, beam);
    }
    first_of_line_.push_back(edges_.size());
    if (!options_.on_several_lines) return std::move(edges_);
    for (std::size_t i = 0; i < edges_.size(); ++i) edges_[i].along = Along(i);
    std::erase_if(edges_, [](const DepthEdge& edge) { return edge.along.isZero(); });
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
    edges_.push_back(
        {origin + to_near + 0.5 * across, across, Eigen::Vector3d::Zero(), to_far.norm() - range});
    places_.push_back({line, near, far - near});
  }

  /// Where a surface ends among the beams.
  struct Place {
    int line = 0;
    int beam = 0;
    int outward = 0;  ///< 1 or -1 beam
  };

  Eigen::Vector3d Along(std::size_t edge) const {
    return edges_[Followed(edge, 1)].point - edges_[Followed(edge, -1)].point;
  }

  /// The edge of the same surface two lines on, or one; the edge itself where there is none.
  std::size_t Followed(std::size_t edge, int line_step) const {
    constexpr int kLines = 2;
    for (int i = 0; i < kLines; ++i) {
      const auto next = OnNeighbour(edge, line_step);
      if (!next) break;
      edge = *next;
    }
    return edge;
  }

  std::optional<std::size_t> OnNeighbour(std::size_t edge, int line_step) const {
    constexpr int kMostBeams = 8;
    constexpr double kMostApart = 0.1;  // of the range
    const Place& place = places_[edge];
    const int line = place.line + line_step;
    if (line < 0 || line >= cloud_.lines) return std::nullopt;
    std::optional<std::size_t> nearest;
    int least = kMostBeams + 1;
    const double range = Range(place.line, place.beam);
    // A line's edges are in the order of their beams.
    const auto of_line =
        std::span(places_).subspan(first_of_line_[static_cast<std::size_t>(line)],
                                   first_of_line_[static_cast<std::size_t>(line) + 1] -
                                       first_of_line_[static_cast<std::size_t>(line)]);
    const auto first = std::partition_point(of_line.begin(), of_line.end(), [&](const Place& p) {
      return p.beam < place.beam - kMostBeams;
    });
    for (auto at = first; at != of_line.end() && at->beam <= place.beam + kMostBeams; ++at) {
      const Place& other = *at;
      const int beams = std::abs(other.beam - place.beam);
      if (other.outward != place.outward || beams >= least ||
          !(std::abs(Range(line, other.beam) - range) < kMostApart * range))
        continue;
      least = beams;
      nearest = static_cast<std::size_t>(&other - places_.data());
    }
    return nearest;
  }

  const RegisteredScan& cloud_;
  const DepthEdgeOptions& options_;
  std::vector<DepthEdge> edges_;
  std::vector<Place> places_;               ///< one an edge
  std::vector<std::size_t> first_of_line_;  ///< and one more
};

}  // namespace

DepthEdgeOptions DepthEdgeOptions::OfImported() {
  DepthEdgeOptions options;
  options.least_jump_of_range = 0.02;
  options.least_jump_of_slope = 2.0;
  options.near_alone = true;
  options.on_several_lines = false;
  return options;
}

std::vector<DepthEdge> FindDepthEdges(const RegisteredScan& cloud,
                                      const DepthEdgeOptions& options) {
  return EdgeFinder(cloud, options).Run();
}

}  // namespace foresight
