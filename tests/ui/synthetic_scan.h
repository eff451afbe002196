#pragma once

#include "core/geometry/rigid.h"
#include "core/objects/valve_model.h"
#include "core/sensor/scan.h"

namespace foresight {

/// A wheel valve of 200 mm radius on a wall 2 m ahead of the head, scanned without noise; the
/// camera has half the default's resolution, to keep tests quick.
Scan WallAndValveScan(const ScanPlan& plan);

ValveModel SyntheticValve();
Rigid<frame::Base, frame::Object> SyntheticValvePose();

}  // namespace foresight
