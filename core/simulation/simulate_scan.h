#pragma once

#include "core/base/run_context.h"
#include "core/sensor/scan.h"
#include "core/simulation/world.h"

namespace foresight {

/// A sweep of a simulated head at constant speed, as the devices would report it: lines at the
/// lidar's rate and the encoder at 240 Hz, without images; a second pass goes back. Motor dynamics
/// are left out (hardware/simulated has them). The scan's rig is the true one with the correction
/// that a perfect calibration would hold. Fails with the plan's errors and with kCancelled. 3 ms of
/// CPU a line.
Result<Scan> SimulateSweep(const World& world, const ScanPlan& plan, const RunContext& context);

/// Same, with images taken on the fly at the plan's angles: 1 s of CPU each for 1288 x 964.
Result<Scan> SimulateScan(const World& world, const ScanPlan& plan, const RunContext& context);

}  // namespace foresight
