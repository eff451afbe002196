#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/fitting/fit_origin.h"
#include "core/geometry/rigid.h"

namespace foresight {

/// What errors in deviations are called: "x_sigmas".
inline constexpr const char* kSigmaErrorSuffix = "_sigmas";

/// Adds the errors of a pose divided by what its covariance says they are, along and about the
/// found object's own axes: "x_sigmas", "y_sigmas", "z_sigmas", "tilt_x_sigmas", "tilt_y_sigmas",
/// "turn_z_sigmas". A turn about z by `period_rad` is no error. What has no variance is left out.
void AddSigmaErrors(const Rigid<frame::Object, frame::Object>& found_from_truth,
                    const PoseCovariance& covariance, double period_rad,
                    std::vector<std::pair<std::string, double>>& errors);

}  // namespace foresight
