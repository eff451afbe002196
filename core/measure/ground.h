#pragma once

#include <span>

#include "core/base/result.h"
#include "core/detection/detection.h"
#include "core/measure/measured_plane.h"
#include "core/registration/register_scan.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// The ground of a scan, in robot: that of the terrain that was found in it, where there is one
/// with a ground; else the lowest level plane that holds at least a twentieth of the scan's returns
/// below the sensor. `made_from` says which. Fails with kTooFewPoints where there is neither.
/// O(points).
Result<MeasuredPlane> FindGround(const RegisteredScan& cloud, const SensorRig& rig,
                                 std::span<const TerrainDetection* const> terrains);

}  // namespace foresight
