#include "core/selfcheck/half_maps.h"

#include <cmath>
#include <numbers>

namespace foresight {
namespace {

/// Whether the method averages more of the image where there are fewer samples.
bool WindowFollowsDensity(const DepthOptions& options) {
  switch (options.method) {
    case DepthMethod::kForesight:
      return options.local_plane.sigma_spatial_px == 0.0;
    case DepthMethod::kPaper:
    case DepthMethod::kJointBilateral:
      return options.upsample.sigma_spatial_px == 0.0;
    case DepthMethod::kTgv:
    case DepthMethod::kNonlocal:
      break;
  }
  return false;
}

}  // namespace

Result<std::vector<double>> NoiseOfMap(const JudgedBeams& beams, const ColorImage& guide,
                                       const DepthOptions& options, const MaskImage& shown,
                                       const RunContext& context) {
  HoldOutPlan plan;
  plan.pattern = HoldOutPlan::Pattern::kLines;
  plan.one_in = 2;
  FORESIGHT_TRY(const DepthResult odd,
                MapWithout(beams, guide, options, plan, context.Part(0.0, 0.5)));
  plan.turn = 1;
  FORESIGHT_TRY(const DepthResult even,
                MapWithout(beams, guide, options, plan, context.Part(0.5, 1.0)));
  const double scale = WindowFollowsDensity(options) ? 1.0 / std::numbers::sqrt2 : 0.5;
  std::vector<double> errors_m;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const double difference_m =
        static_cast<double>(even.dense.depth_m.values()[i]) - odd.dense.depth_m.values()[i];
    if (shown.values()[i] != 0 && std::isfinite(difference_m))
      errors_m.push_back(scale * std::abs(difference_m));
  }
  return errors_m;
}

}  // namespace foresight
