#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/base/run_context.h"
#include "core/exchange/assemble_scan.h"

namespace foresight {

/// What an import made.
struct ImportReport {
  struct Entry {
    std::int64_t scan_id = 0;
    std::string uuid;
    std::string of_scan_uuid;  ///< of the scan that was exported; empty = not known
    std::string source;
    int lines = 0;
    int beams = 0;
    std::size_t points = 0;
    std::size_t images = 0;
    std::string grid;
    std::vector<std::string> notes;
  };
  std::vector<Entry> scans;
};

/// Makes a mission of other programs' files: clouds (PLY, PCD, KITTI's .bin, text; each becomes a
/// scan), ROS 1 bags, folders that an export wrote (scan-0001, or what holds several), and beside
/// them images (PNG, JPEG), a rig (.yaml) and a calibration of KITTI's form (.txt). With one cloud
/// all images are its own; with several an image belongs to the cloud whose name it begins with.
/// The files' contents say what they are, where their names do not. What was assumed or lost is in
/// the report and in the mission's log. `target` must not be there; it is written whole or not at
/// all. Fails with kIo, kBadData, kInvalidInput and kInvalidOptions, naming file and place, and
/// with kCancelled.
Result<ImportReport> ImportMission(std::span<const std::filesystem::path> sources,
                                   const std::filesystem::path& target,
                                   const ImportOptions& options, const RunContext& context);

}  // namespace foresight
