#pragma once

#include <filesystem>
#include <functional>

#include "core/base/run_context.h"
#include "core/exchange/assemble_scan.h"

namespace foresight {

/// Reads a ROS 1 bag: a scan for each PointCloud2 of one topic, with the Image (or CompressedImage)
/// nearest to it in time, its CameraInfo, and their places by tf. A bag that an export wrote gives
/// what was exported. `take` gets one scan after the other; its failure ends the import. Fails with
/// kIo, with kBadData naming the file and the topic, kInvalidOptions where the bag has several
/// topics of clouds and none is chosen, and kCancelled.
Status ImportBag(const std::filesystem::path& path, const ImportOptions& options,
                 const std::function<Status(ImportedScan)>& take, const RunContext& context);

}  // namespace foresight
