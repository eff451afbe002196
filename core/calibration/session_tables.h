#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/calibration/calibration_session.h"

namespace foresight {

/// The tables of a session's folder, docs/formats.md.
std::string CornersText(const MountView& view);
std::string LinesText(const std::vector<LidarLine>& lines);
std::string MotorText(const MotorTrack& track);

/// The reverse. Fail with kIo; with kBadData, naming file, line and column.
Result<MountView> ReadCorners(const std::filesystem::path& path);
Result<std::vector<LidarLine>> ReadLines(const std::filesystem::path& path,
                                         const LidarModel& lidar);
Result<MotorTrack> ReadTrack(const std::filesystem::path& path);

}  // namespace foresight
