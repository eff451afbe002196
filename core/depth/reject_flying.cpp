#include "core/depth/reject_flying.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"

namespace foresight {
namespace {

using Rule = FlyingPointOptions::Rule;

/// Median distance at 1 m between the rays of neighbours on a line; 0 when there are none.
double MedianRayStep(const AlignedSamples& samples, const Image<std::int32_t>& grid) {
  std::vector<double> steps;
  const auto ray = [&](std::int32_t index) -> Eigen::Vector2f {
    return samples.samples[static_cast<std::size_t>(index)].point.hnormalized();
  };
  for (int line = 0; line < grid.height(); ++line)
    for (int beam = 0; beam + 1 < grid.width(); ++beam)
      if (grid(beam, line) >= 0 && grid(beam + 1, line) >= 0)
        steps.push_back((ray(grid(beam, line)) - ray(grid(beam + 1, line))).norm());
  return steps.empty() ? 0.0 : UpperMedian(std::move(steps));
}

double DistanceBetween(const AlignedSample& a, const AlignedSample& b,
                       const FlyingPointOptions& options) {
  return options.distance == FlyingPointOptions::Distance::kDepth ? std::abs(a.depth_m - b.depth_m)
                                                                  : (a.point - b.point).norm();
}

}  // namespace

FlyingPointOptions FlyingPointOptions::RangeAdaptive() {
  FlyingPointOptions options;
  options.distance = Distance::kDepth;
  options.threshold_per_step = 2.0;
  return options;
}

Status FlyingPointOptions::Check() const {
  if (!(threshold_m > 0.0) || !std::isfinite(threshold_m))
    return Fail(ErrorCode::kInvalidOptions, "flying points: threshold_m {} is not positive",
                threshold_m);
  if (!(threshold_per_metre >= 0.0) || !std::isfinite(threshold_per_metre))
    return Fail(ErrorCode::kInvalidOptions, "flying points: threshold_per_metre {} is negative",
                threshold_per_metre);
  if (!(threshold_per_step >= 0.0) || !std::isfinite(threshold_per_step))
    return Fail(ErrorCode::kInvalidOptions, "flying points: threshold_per_step {} is negative",
                threshold_per_step);
  return {};
}

Status RejectFlying(AlignedSamples& samples, const FlyingPointOptions& options) {
  FORESIGHT_CHECK(options.Check());
  if (options.rule == Rule::kOff) return {};
  const Image<std::int32_t> grid = GridOf(samples, true);
  double per_metre = options.threshold_per_metre;
  if (options.threshold_per_step > 0.0)
    per_metre += options.threshold_per_step * MedianRayStep(samples, grid);

  /// 1 = far, 0 = near, -1 = no neighbour there.
  const auto far_from = [&](const AlignedSample& here, int beam) {
    if (beam < 0 || beam >= grid.width() || grid(beam, here.line) < 0) return -1;
    const AlignedSample& there = samples.samples[static_cast<std::size_t>(grid(beam, here.line))];
    const double threshold = options.threshold_m + per_metre * here.depth_m;
    return DistanceBetween(here, there, options) > threshold ? 1 : 0;
  };
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    if (samples.reasons[i] != RejectReason::kKept) continue;
    const AlignedSample& here = samples.samples[i];
    const int before = far_from(here, here.beam - 1);
    const int after = far_from(here, here.beam + 1);
    const bool any = before == 1 || after == 1;
    const bool none_near = any && before != 0 && after != 0;
    if (options.rule == Rule::kAnyNeighbourFar ? any : none_near)
      samples.reasons[i] = RejectReason::kFlying;
  }
  return {};
}

}  // namespace foresight
