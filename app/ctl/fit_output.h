#pragma once

#include <optional>

#include "app/common/exit_code.h"
#include "core/detection/detection.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// A verdict with its reason, and what was measured.
/// @param up_of_cloud as FactsOf has it
void PrintSummary(const Detection& detection, const SensorRig& rig,
                  const std::optional<Eigen::Vector3d>& up_of_cloud = std::nullopt);

/// A fit that found nothing, as JSON, with the reason on standard error.
ExitCode PrintNothingFound(ObjectKind kind, const Error& error);

}  // namespace foresight
