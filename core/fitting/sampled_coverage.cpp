#include "core/fitting/sampled_coverage.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace foresight {
namespace {

constexpr double kReachWidths = 3.0;  // an object further from a ray than this changes nothing

/// One ray's samples as they are added up.
class Samples {
 public:
  Samples(double shift_m, double width_m) : shift_m_(shift_m), width_m_(width_m) {}

  double Reach() const { return shift_m_ + kReachWidths * width_m_; }

  void Add(const std::optional<BeamIntersection>& intersection) {
    if (!intersection || intersection->clearance_m > Reach()) return;
    const double beyond = (intersection->clearance_m - shift_m_) / width_m_;
    const double part = 0.5 * std::erfc(beyond / std::numbers::sqrt2);
    if (!(part > 0.0)) return;
    sum_.fraction += part;
    sum_.range_m += part / sum_.fraction * (intersection->range_m - sum_.range_m);
  }

  BeamCoverage MeanOf(std::size_t count) const {
    return {sum_.fraction / static_cast<double>(count), sum_.range_m};
  }

 private:
  double shift_m_, width_m_;
  BeamCoverage sum_;  ///< its range is a weighted mean so far
};

}  // namespace

CoverBeam CoverBySamples(IntersectBeam object) {
  return [object = std::move(object)](const BeamFootprints& footprints,
                                      std::size_t i) -> std::optional<BeamCoverage> {
    const RangeRay& ray = footprints.Rays().rays[i];
    const double half_m = footprints.HalfWidth(i);
    const BeamOptions& options = footprints.Options();
    Samples samples(options.early_return * half_m, 0.5 * half_m + options.edge_error_m);
    const auto directions = footprints.SampleDirections(i);
    if (directions.empty()) {
      samples.Add(object(ray, samples.Reach()));
      return samples.MeanOf(1);
    }
    const auto middle = object(ray, samples.Reach() + footprints.HalfHeight(i));
    if (!middle) return std::nullopt;
    RangeRay sample = ray;
    for (std::size_t k = 0; k < directions.size(); ++k) {
      sample.direction = directions[k];
      samples.Add(2 * k + 1 == directions.size() ? middle : object(sample, samples.Reach()));
    }
    return samples.MeanOf(directions.size());
  };
}

}  // namespace foresight
