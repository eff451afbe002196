#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/mission/mission_file.h"

namespace foresight {

/// Command-line options that choose a scan and an image of a mission file.
struct ScanArguments {
  std::string mission;
  std::int64_t scan_id = 0;   ///< 0 = the last one
  double image_deg = 1000.0;  ///< beyond any angle = the image nearest to the middle of the scope
};

/// kNo: the command can work on something else too.
enum class NeedMission { kYes, kNo };
void AddScanArguments(CLI::App& command, ScanArguments& arguments,
                      NeedMission need = NeedMission::kYes);

/// The same without the choice of an image.
void AddMissionArguments(CLI::App& command, ScanArguments& arguments,
                         NeedMission need = NeedMission::kYes);

struct OpenedScan {
  std::int64_t id = 0;
  Scan scan;
  CameraFrame frame;  ///< the chosen image; without one where the command has no use for it
};

/// Says on standard error where the scan is not complete: what is made from it covers only a part
/// of what was asked for. Fails with kBadData where the mission is damaged, kInvalidInput where it
/// has no such scan or image.
Result<OpenedScan> OpenScan(const ScanArguments& arguments);
/// The same without the choice of an image: a scan may have none.
Result<OpenedScan> OpenScanWithoutImage(const ScanArguments& arguments);

}  // namespace foresight
