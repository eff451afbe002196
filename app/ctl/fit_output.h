#pragma once

#include "app/common/exit_code.h"
#include "core/detection/detection.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// A verdict with its reason, and what was measured.
void PrintSummary(const Detection& detection, const SensorRig& rig);

/// A fit that found nothing, as JSON, with the reason on standard error.
ExitCode PrintNothingFound(ObjectKind kind, const Error& error);

}  // namespace foresight
