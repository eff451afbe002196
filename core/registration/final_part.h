#pragma once

#include "core/sensor/scan.h"

namespace foresight {

/// Of a running scan: whether no later sample of the motor's track changes the angles of the line's
/// beams. The track must have no gap before its last sample.
bool IsFinal(const LidarLine& line, const Scan& scan);

/// The running scan with those lines alone that are final: what is computed with them now can be
/// computed again from the whole scan. A scan that has ended is returned as it is.
Scan FinalPart(const Scan& scan);

}  // namespace foresight
