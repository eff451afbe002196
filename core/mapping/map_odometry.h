#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

#include "core/base/result.h"
#include "core/geometry/rigid.h"
#include "core/mapping/map_frame.h"

namespace foresight {

/// Where the robot believes that it stood, by the scan's number.
using MapOdometry = std::map<std::int64_t, Rigid<frame::Map, frame::Robot>>;

/// Reads CSV with the columns scan, x_m, y_m, z_m, qw, qx, qy, qz (docs/formats.md). Fails with
/// kIo, and with kBadData, naming file and line, for a quaternion whose length is not 1 and a scan
/// that stands there twice.
Result<MapOdometry> LoadMapOdometry(const std::filesystem::path& path);

}  // namespace foresight
