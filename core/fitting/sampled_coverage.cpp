#include "core/fitting/sampled_coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace foresight {
namespace {

/// One ray's samples as they are added up.
class Samples {
 public:
  explicit Samples(const SampleEdge& edge) : edge_(edge) {}

  void Add(double clearance_m, double range_m) {
    if (!(clearance_m <= edge_.Reach())) return;
    const double beyond = (clearance_m - edge_.shift_m) / edge_.width_m;
    const double part = 0.5 * std::erfc(beyond / std::numbers::sqrt2);
    if (!(part > 0.0)) return;
    sum_.fraction += part;
    sum_.range_m += part / sum_.fraction * (range_m - sum_.range_m);
  }
  void Add(const std::optional<BeamIntersection>& intersection) {
    if (intersection) Add(intersection->clearance_m, intersection->range_m);
  }

  BeamCoverage MeanOf(std::size_t count) const {
    return {sum_.fraction / static_cast<double>(count), sum_.range_m};
  }

 private:
  SampleEdge edge_;
  BeamCoverage sum_;  ///< its range is a weighted mean so far
};

}  // namespace

CoverBeam CoverBySamples(IntersectBeam object) {
  return [object = std::move(object)](const BeamFootprints& footprints,
                                      std::size_t i) -> std::optional<BeamCoverage> {
    const RangeRay& ray = footprints.Rays().rays[i];
    const SampleEdge edge = footprints.EdgeOf(i);
    Samples samples(edge);
    const auto directions = footprints.SampleDirections(i);
    if (directions.empty()) {
      samples.Add(object(ray, edge.Reach()));
      return samples.MeanOf(1);
    }
    const auto middle = object(ray, edge.Reach() + footprints.HalfHeight(i));
    if (!middle) return std::nullopt;
    RangeRay sample = ray;
    for (std::size_t k = 0; k < directions.size(); ++k) {
      sample.direction = directions[k];
      samples.Add(2 * k + 1 == directions.size() ? middle : object(sample, edge.Reach()));
    }
    return samples.MeanOf(directions.size());
  };
}

CoverBeams CoverAllBySamples(IntersectBeams object) {
  return [object = std::move(object)](const BeamFootprints& footprints,
                                      std::span<BeamCoverage> of_rays) {
    const RayColumns& columns = footprints.Samples();
    std::vector<double> clearance_m(columns.Padded()), range_m(columns.Padded());
    object(columns, clearance_m, range_m);
    if (columns.count == of_rays.size()) {  // a sample each, and most see nothing
      for (std::size_t i = 0; i < of_rays.size(); ++i)
        if (std::isfinite(clearance_m[i])) {
          Samples sample(footprints.EdgeOf(i));
          sample.Add(clearance_m[i], range_m[i]);
          of_rays[i] = sample.MeanOf(1);
        }
      return;
    }
    std::size_t next = 0;
    for (std::size_t i = 0; i < of_rays.size(); ++i) {
      const std::size_t count = std::max<std::size_t>(1, footprints.SampleDirections(i).size());
      Samples samples(footprints.EdgeOf(i));
      for (const std::size_t end = next + count; next < end; ++next)
        samples.Add(clearance_m[next], range_m[next]);
      of_rays[i] = samples.MeanOf(count);
    }
  };
}

}  // namespace foresight
