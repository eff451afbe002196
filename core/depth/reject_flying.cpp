#include "core/depth/reject_flying.h"

#include <cmath>

namespace foresight {

Status FlyingPointOptions::Check() const {
  if (!(threshold_m > 0.0) || !std::isfinite(threshold_m))
    return Fail(ErrorCode::kInvalidOptions, "flying points: threshold_m {} is not positive",
                threshold_m);
  if (!(threshold_per_metre >= 0.0) || !std::isfinite(threshold_per_metre))
    return Fail(ErrorCode::kInvalidOptions, "flying points: threshold_per_metre {} is negative",
                threshold_per_metre);
  return {};
}

Status RejectFlying(AlignedSamples& samples, const FlyingPointOptions& options) {
  FORESIGHT_CHECK(options.Check());
  if (options.rule == FlyingPointOptions::Rule::kOff) return {};
  const Image<std::int32_t> grid = GridOf(samples, true);

  /// 1 = far, 0 = near, -1 = no neighbour there.
  const auto far_from = [&](const AlignedSample& here, int beam) {
    if (beam < 0 || beam >= grid.width() || grid(beam, here.line) < 0) return -1;
    const AlignedSample& there = samples.samples[static_cast<std::size_t>(grid(beam, here.line))];
    const double distance = options.distance == FlyingPointOptions::Distance::kDepth
                                ? std::abs(here.depth_m - there.depth_m)
                                : (here.point - there.point).norm();
    const double threshold = options.threshold_m + options.threshold_per_metre * here.depth_m;
    return distance > threshold ? 1 : 0;
  };
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    if (samples.reasons[i] != RejectReason::kKept) continue;
    const AlignedSample& here = samples.samples[i];
    const int before = far_from(here, here.beam - 1);
    const int after = far_from(here, here.beam + 1);
    const bool any = before == 1 || after == 1;
    const bool none_near = any && before != 0 && after != 0;
    if (options.rule == FlyingPointOptions::Rule::kAnyNeighbourFar ? any : none_near)
      samples.reasons[i] = RejectReason::kFlying;
  }
  return {};
}

}  // namespace foresight
