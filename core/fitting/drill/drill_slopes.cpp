#include "core/fitting/drill/drill_slopes.h"

#include <cmath>
#include <vector>

#include "core/fitting/beam_model.h"
#include "core/fitting/solids/solid_tracer.h"

namespace foresight {
namespace {

/// The error of a ray in deviations: of its range, or of an outline that it should have missed or
/// hit.
double ErrorOf(const RangeRay& ray, const SolidIntersection& intersection, bool outline,
               double sigma_m, double width_m) {
  const double range_error = (ray.range_m - intersection.range_m) / sigma_m;
  if (!outline) return range_error;
  const bool returned = std::abs(range_error) < BeamModel::kAgreeSigmas;
  return returned == intersection.Hits() ? 0.0 : -intersection.clearance_m / width_m;
}

}  // namespace

DrillSlopes SlopesOf(const RaySet& rays, const DrillState& drill, const TableFrame& base_from_table,
                     const DrillPrior& prior) {
  constexpr double kStep = 1e-3;        // metres and radians
  constexpr double kNearMiss_m = 0.02;  // beside the drill, of a ray that may graze it
  const double sigma = SigmaOf(rays, kDrillBeams);
  const auto tracer_at = [&](const DrillState& state) {
    return SolidTracer(state.Model().parts, state.Pose(base_from_table));
  };
  const SolidTracer here = tracer_at(drill);
  std::vector<SolidTracer> moved;
  for (int p = 0; p < kDrillParameters; ++p) {
    DrillState state = drill;
    state.values[p] += kStep;
    moved.push_back(tracer_at(state));
  }
  DrillSlopes slopes;
  slopes.scores = Eigen::MatrixXd::Zero(std::ssize(rays.rays), kDrillParameters);
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const RangeRay& ray = rays.rays[i];
    const SolidIntersection intersection = here.IntersectWithDepth(ray, kNearMiss_m);
    if (intersection.part < 0) continue;
    const double width = 0.5 * rays.footprint_rad * ray.range_m + kDrillBeams.edge_error_m;
    const bool inside = intersection.Hits();
    if (inside && std::abs(ray.range_m - intersection.range_m) > BeamModel::kAgreeSigmas * sigma)
      continue;
    // A ray that grazes the outline knows where that is, one further in how far the surface is.
    const bool outline = std::abs(intersection.clearance_m) < width;
    if (!inside && !outline) continue;
    DrillStep slope;
    for (int p = 0; p < kDrillParameters; ++p) {
      const SolidIntersection there =
          moved[static_cast<std::size_t>(p)].IntersectWithDepth(ray, kNearMiss_m);
      const double change = outline ? (there.clearance_m - intersection.clearance_m) / width
                                    : (there.range_m - intersection.range_m) / sigma;
      const bool same = there.part == intersection.part && there.Hits() == inside;
      slope[p] = same || (outline && there.part == intersection.part) ? change / kStep : 0.0;
    }
    slopes.information += slope * slope.transpose();
    slopes.scores.row(static_cast<Eigen::Index>(i)) =
        ErrorOf(ray, intersection, outline, sigma, width) * slope.transpose();
  }
  const double weight = rays.Worth();
  slopes.information *= weight;
  slopes.scores *= weight;
  slopes.information.diagonal() += prior.Information();
  return slopes;
}

}  // namespace foresight
