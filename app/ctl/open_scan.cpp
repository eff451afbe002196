#include "app/ctl/open_scan.h"

#include <limits>

#include "app/common/output.h"
#include "app/ctl/choose_scan.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

void WarnUnlessComplete(const std::string& mission, const OpenedScan& opened) {
  const Scan& scan = opened.scan;
  if (scan.state == ScanState::kComplete) return;
  PrintNote("warning: {}: scan {} is {}{}{}; what is made from it covers only a part of the scope",
            mission, opened.id, ToString(scan.state), scan.reason.empty() ? "" : ": ", scan.reason);
}

}  // namespace

void AddMissionArguments(CLI::App& command, ScanArguments& arguments, NeedMission need) {
  command.add_option("mission,--mission", arguments.mission, "Mission file")
      ->required(need == NeedMission::kYes);
  command
      .add_option("--scan", arguments.scan_id, "Number of the scan, from 1; default: the last one")
      ->check(CLI::Range(std::int64_t{1}, std::numeric_limits<std::int64_t>::max(), "1 or more"));
}

void AddScanArguments(CLI::App& command, ScanArguments& arguments, NeedMission need) {
  AddMissionArguments(command, arguments, need);
  command
      .add_option("--image", arguments.image_deg, "Use the image nearest to this angle in degrees")
      ->check(CLI::Range(-90.0, 90.0));
}

Result<OpenedScan> OpenScanWithoutImage(const ScanArguments& arguments) {
  FORESIGHT_TRY(const std::unique_ptr<MissionFile> mission,
                MissionFile::OpenReadOnly(arguments.mission));
  OpenedScan opened;
  FORESIGHT_TRY(opened.id, ChooseScan(*mission, arguments.scan_id));
  FORESIGHT_TRY(opened.scan, mission->LoadScan(opened.id));
  WarnUnlessComplete(arguments.mission, opened);
  return opened;
}

Result<OpenedScan> OpenScan(const ScanArguments& arguments) {
  FORESIGHT_TRY(OpenedScan opened, OpenScanWithoutImage(arguments));
  const double middle_rad = 0.5 * (opened.scan.plan.from_rad + opened.scan.plan.to_rad);
  const double wanted_rad =
      arguments.image_deg > 90.0 ? middle_rad : RadiansFromDegrees(arguments.image_deg);
  const CameraFrame* frame = NearestFrame(opened.scan, wanted_rad);
  if (frame == nullptr)
    return Fail(ErrorCode::kInvalidInput, "{}: scan {} has no image", arguments.mission, opened.id);
  opened.frame = *frame;
  return opened;
}

}  // namespace foresight
