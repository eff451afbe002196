#pragma once

#include <memory>

#include "hardware/api/head_link.h"
#include "hardware/link/chunks/scan_builder.h"

namespace foresight {

/// What is here of a scan beyond what its sink has heard; nullptr = nothing. Previews and
/// thumbnails are enlarged to the size of the image that they stand for.
std::shared_ptr<const EarlyScan> EarlyScanOf(const ScanBuilder& builder);

}  // namespace foresight
