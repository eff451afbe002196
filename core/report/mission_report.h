#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/run_context.h"
#include "core/mission/mission_file.h"

namespace foresight {

struct MissionReportOptions {
  std::optional<std::int64_t> scan;  ///< of one scan; none = of all
  bool pdf = false;                  ///< also report.pdf
};

/// What was written.
struct MissionReportFiles {
  std::vector<std::string> files;  ///< names in the folder, report.html first
  int scans = 0;
  int objects = 0;
  std::vector<std::string> left_out;  ///< pictures that could not be made, and why
};

/// Writes report.html with its pictures, and report.pdf where asked for: of each scan what was
/// asked of the head, the image with the outlines of what was found, the masked depth map, the
/// cloud from above and from aside, every object with verdict, pose, deviations, decision and
/// author, the side results, the settings, the rig and where all of it comes from; and the log. The
/// page needs nothing but the pictures beside it.
/// @param review of the mission; nullptr = it has none
/// @param folder an existing one
/// A scan of which a picture cannot be made is reported without it. Fails with kInvalidInput (no
/// such scan), kIo, kBadData and kCancelled.
Result<MissionReportFiles> WriteMissionReport(const MissionFile& mission, const MissionFile* review,
                                              const std::filesystem::path& folder,
                                              const MissionReportOptions& options,
                                              const RunContext& context);

}  // namespace foresight
