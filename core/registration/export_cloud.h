#pragma once

#include <filesystem>
#include <vector>

#include "core/io/point_cloud_file.h"
#include "core/registration/register_scan.h"

namespace foresight {

/// A scan's valid returns in robot, metres, line by line, each with its own time.
/// @param cloud of this scan; lines that the scan does not have (yet) get no time
std::vector<CloudPoint> PointsInRobot(const RegisteredScan& cloud, const Scan& scan);

/// Writes them with the scan's uuid and time: PCD where the name ends in .pcd, else PLY.
/// @returns how many points. Fails as WritePly does. O(points).
Result<std::size_t> ExportCloud(const RegisteredScan& cloud, const Scan& scan,
                                const std::filesystem::path& path);

}  // namespace foresight
