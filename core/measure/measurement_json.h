#pragma once

#include <string>

#include "core/measure/measurement.h"

namespace foresight {

/// As the mission keeps it (docs/formats.md): `measurement`, `value`, `sigma`, `unit`, `label` (for
/// people), `points`, `plane`. Metres and radians, in robot, or in map where `frame` says so; NaN
/// is null.
std::string MeasurementToJson(const Measurement& measurement);
/// The reverse; numbers survive the round trip. Value and sigma are computed again from the points.
/// Fails with kBadData, naming the member at fault.
Result<Measurement> MeasurementFromJson(const std::string& json);

}  // namespace foresight
