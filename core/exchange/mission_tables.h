#pragma once

#include <string>

#include "core/mission/mission_file.h"

namespace foresight {

// What a mission holds as CSV: RFC 4180, a header, UTF-8, a comma between values, UTC times as
// "2026-11-22T13:06:33.250Z", metres and degrees. The same mission gives the same bytes.

/// One row a scan.
Result<std::string> ScansCsv(const MissionFile& mission);
/// One row a detection, also deleted ones: what it is, what was decided, and the best answer's pose
/// in robot. The pose is empty where it has none (a terrain without a surface) or cannot be read.
Result<std::string> DetectionsCsv(const MissionFile& mission);
/// One row a note or measurement, also deleted ones, in its present state: a measurement with its
/// value in metres or degrees and its points in robot.
Result<std::string> NotesCsv(const MissionFile& mission);
/// One row a line of the log.
Result<std::string> EventsCsv(const MissionFile& mission);

}  // namespace foresight
