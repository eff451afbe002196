#include <memory>

#include "app/ctl/command.h"
#include "app/ctl/mission_beside.h"
#include "core/base/utc_text.h"
#include "core/mission/mission_file.h"
#include "core/mission/pose_json.h"

namespace foresight {
namespace {

struct PoseArguments {
  std::string file;
  std::optional<std::int64_t> detection;
  int candidate = 0;
  bool json = false;
};

/// An object with its pose as it would go to a robot.
struct StoredPose {
  std::int64_t number = 0;
  PoseMessage message;
};

std::string Line(const StoredPose& stored) {
  const PoseMessage& pose = stored.message;
  const Eigen::Vector3d position_mm = 1000.0 * pose.position_m;
  return fmt::format("{:>9}  {:<8}  {:<9}  {:<8}  {:<5}  {:>7.0f} {:>7.0f} {:>7.0f}  {}",
                     stored.number, ToString(ObjectKindOf(pose)), ToString(pose.verdict),
                     ToString(pose.decision), ToString(pose.frame), position_mm.x(),
                     position_mm.y(), position_mm.z(), pose.detection_uuid);
}

void Print(const std::vector<StoredPose>& poses, bool json) {
  std::string text =
      json ? ""
           : fmt::format("{:>9}  {:<8}  {:<9}  {:<8}  {:<5}  {:>23}  {}", "detection", "object",
                         "verdict", "decision", "frame", "x, y, z in mm", "uuid");
  for (const StoredPose& pose : poses) {
    if (!text.empty()) text += '\n';
    text += json ? PoseMessageToJson(pose.message) : Line(pose);
  }
  if (!text.empty()) PrintLine(text);
}

Result<PoseMessage> PoseOf(const MissionFile& scans, const DetectionRecord& record, int candidate) {
  FORESIGHT_TRY(const auto scan_id, scans.FindScan(record.scan_uuid));
  if (!scan_id)
    return Fail(ErrorCode::kInvalidInput, "detection {}: its scan {} is not in {}", record.id,
                record.scan_uuid, scans.path().string());
  FORESIGHT_TRY(const Scan header, scans.LoadHeader(*scan_id));
  FORESIGHT_TRY(const ScanSummary summary, scans.Summary(*scan_id));
  return PoseMessageOf(record, candidate, header.rig, summary, NowUtc_ns());
}

bool IsWanted(const DetectionRecord& record, const PoseArguments& arguments) {
  return arguments.detection ? record.id == *arguments.detection : !record.deleted;
}

Result<ExitCode> ShowPoses(const PoseArguments& arguments) {
  FORESIGHT_TRY(const std::unique_ptr<MissionFile> mission,
                MissionFile::OpenReadOnly(arguments.file));
  FORESIGHT_TRY(const std::unique_ptr<MissionFile> beside, MissionBeside(*mission));
  FORESIGHT_TRY(const std::vector<DetectionRecord> records, mission->ListDetections());
  std::vector<StoredPose> poses;
  for (const DetectionRecord& record : records) {
    if (!IsWanted(record, arguments)) continue;
    const auto message = PoseOf(beside ? *beside : *mission, record, arguments.candidate)
                             .map_error(Of(arguments.file));
    if (message)
      poses.push_back({record.id, *message});
    else if (arguments.detection || message.error().code != ErrorCode::kInvalidInput)
      return tl::unexpected(message.error());
    else  // a terrain without a surface has no pose; the others are shown
      PrintNote("{}", message.error().message);
  }
  if (arguments.detection && poses.empty())
    return Fail(ErrorCode::kInvalidInput, "{}: no detection {}; without --detection all are listed",
                arguments.file, *arguments.detection);
  Print(poses, arguments.json);
  return ExitCode::kDone;
}

}  // namespace

void AddMissionPoseCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<PoseArguments>();
  CLI::App* command =
      mission.add_subcommand("pose", "What a robot would be told of each object found");
  command->add_option("file", arguments->file, "Mission file")->required();
  CLI::Option* detection =
      command->add_option("--detection", arguments->detection, "Of this detection alone");
  AddOption(*command, "--candidate", arguments->candidate,
            "Which answer: 0 = the best one; of a terrain, which surface")
      ->needs(detection);
  command->add_flag("--json", arguments->json, "One line of JSON each, as a robot gets it");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext&) { return ShowPoses(*arguments); };
  });
}

}  // namespace foresight
