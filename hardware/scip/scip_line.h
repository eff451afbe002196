#pragma once

#include "core/sensor/lidar_line.h"
#include "hardware/scip/scip_codec.h"
#include "hardware/scip/scip_lidar_options.h"

namespace foresight {

/// The request that streams the data of the options.
ScipRequest StreamRequest(const ScipLidarOptions& options);

/// The beams of a line from the steps of a scan: one echo each. Codes stay codes; a range beyond 16
/// bits becomes "no echo". Without seq and time.
LidarLine LineFromScan(const ScipScan& scan, ScipLidarOptions::Data data);

}  // namespace foresight
