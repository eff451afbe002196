#pragma once

#include "hardware/link/server/scan_shelf.h"
#include "sensor_head.pb.h"

namespace foresight {

/// An image of a scan, or a part of it, as a station wants it: cut out first, then shrunk. Fails
/// with kInvalidInput for a scan, image or part that is not there, kInvalidOptions for a quality.
Result<link::ImageReply> MakeImage(ScanShelf& shelf, const link::ImageRequest& request);

}  // namespace foresight
