#pragma once

#include <string_view>
#include <vector>

#include "core/detection/fit_in_scan.h"
#include "core/registration/recover_grid.h"
#include "core/registration/register_scan.h"

namespace foresight {

/// What outcomes of fits to a plain cloud call their source.
inline constexpr std::string_view kCloudSource = "cloud";

/// A scan as a file of points has it: in the order of the measurement, without lines and beams,
/// seen from one point.
struct PlainCloud {
  std::vector<Eigen::Vector3d> points;                  ///< in base, the returns alone
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();  ///< mean of the lines' origins, in base
  GridPlaces places;  ///< recovered from the order, as `fit --cloud` does it
};
PlainCloud PlainCloudOf(const RegisteredScan& scan);

/// The fit that `foresightctl fit --cloud` makes: noise and grid are taken from the points. Fails
/// as RaysInCloud and FitInRegion do.
Result<Detection> FitInPlainCloud(const PlainCloud& cloud, const SensorRig& rig, const Roi& roi,
                                  const FitOptions& options, const RunContext& context);

}  // namespace foresight
