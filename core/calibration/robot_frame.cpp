#include "core/calibration/robot_frame.h"

#include <cmath>

#include "core/base/atomic_file.h"
#include "core/calibration/locate_board.h"
#include "core/calibration/tangent.h"
#include "core/calibration/view_files.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

constexpr int kFormatVersion = 1;
constexpr std::size_t kMostSamples = 1000;

/// What the file says of a sample, before its image is read.
struct SampleEntry {
  RobotFrameSamples::Sample sample;
  bool has_pose = false;
  double motor_rad = 0.0;
  SessionViewFiles view;
};
struct SamplesEntry {
  RobotFrameSource source = RobotFrameSource::kHandEye;
  std::optional<CalibrationBoard> board;
  std::vector<SampleEntry> samples;
};

template <class To, class From>
Rigid<To, From> NearPoseFromYaml(YamlMap& map, const char* key) {
  constexpr double kFarthest_m = 1000.0;
  const auto pose = PoseFromYaml<To, From>(map.Map(key));
  if (!(pose.translation().norm() <= kFarthest_m))
    map.Fault(map.Node(key), fmt::format("'{}' is over {:.0f} m away", key, kFarthest_m));
  return pose;
}

SampleEntry SampleFromYaml(YamlMap& map, const SamplesEntry& all) {
  SampleEntry entry;
  entry.sample.name = map.Text("name", fmt::format("sample {}", all.samples.size() + 1));
  entry.sample.robot_from_hand = NearPoseFromYaml<frame::Robot, frame::Hand>(
      map, all.source == RobotFrameSource::kHandEye ? "robot_from_hand" : "robot_from_board");
  entry.view = ViewFromYaml(map);
  entry.has_pose = map.Has("base_from_board");
  if (entry.has_pose == !entry.view.empty())
    map.Fault("a sample has 'image', 'corners' or 'base_from_board', one of them");
  if (entry.has_pose) {
    entry.sample.base_from_board =
        NearPoseFromYaml<frame::Base, frame::Pattern>(map, "base_from_board");
  } else {
    const double motor_deg = map.Number("motor_deg");
    if (std::abs(motor_deg) > 90.0)
      map.Fault(map.Node("motor_deg"), fmt::format("{} deg is not in [-90, 90]", motor_deg));
    entry.motor_rad = RadiansFromDegrees(motor_deg);
    if (!all.board) map.Fault("images and corners need a 'board'");
  }
  map.Finish();
  return entry;
}

SamplesEntry SamplesFromYaml(YamlMap& map) {
  const int version = map.Integer("foresight_robot_frame");
  if (version != kFormatVersion)
    map.Fault(fmt::format("version {} of the format is not known, this program reads {}", version,
                          kFormatVersion));
  SamplesEntry entry;
  const std::string kind = map.Text("boards");
  if (kind != "on_hand" && kind != "surveyed")
    map.Fault(map.Node("boards"), "'" + kind + "' is not on_hand or surveyed");
  if (kind == "surveyed") entry.source = RobotFrameSource::kSurveyedBoards;
  if (map.Has("board")) entry.board = BoardFromYaml(map, "board");
  if (entry.board && entry.board->LooksSameUpsideDown())
    map.Fault(map.Node("board"),
              "this board looks the same upside down, so its pose is not certain; one count of "
              "inner corners must be even and the other odd");
  for (YamlMap& sample : map.List("samples")) {
    if (entry.samples.size() == kMostSamples)
      map.Fault(fmt::format("more than {} samples", kMostSamples));
    entry.samples.push_back(SampleFromYaml(sample, entry));
  }
  map.Finish();
  return entry;
}

/// Where the board is in base; an empty view's reason is in `left_out`.
Result<std::optional<Rigid<frame::Base, frame::Pattern>>> Located(
    const fs::path& folder, const SampleEntry& entry, const CalibrationBoard& board,
    const SensorRig& rig, std::vector<std::string>* left_out) {
  FORESIGHT_TRY(const MountView view,
                ReadView(folder, entry.view, rig.camera, {.a = board, .b = {}, .a_from_b = {}},
                         SearchEffort::kThorough));
  if (!view.a) {
    left_out->push_back(view.source + ": the board was not found");
    return std::nullopt;
  }
  if (const Status status = view.a->Check(board); !status)
    return Fail(ErrorCode::kBadData, "{}: {}", (folder / view.source).string(),
                status.error().message);
  const auto located = LocateBoard(rig.camera, board, *view.a, view.source);
  if (!located) {
    left_out->push_back(located.error().message);
    return std::nullopt;
  }
  constexpr double kMostRms_px = 3.0;  // more is another board, or another camera
  if (located->rms_px > kMostRms_px) {
    left_out->push_back(
        fmt::format("{}: corners are {:.1f} px off (rms)", view.source, located->rms_px));
    return std::nullopt;
  }
  return rig.CameraFromBase(entry.motor_rad).Inverse() * located->camera_from_board;
}

}  // namespace

Result<RobotFrameSamples> ReadRobotFrameSamples(const fs::path& path, const SensorRig& rig,
                                                const RunContext& context) {
  FORESIGHT_TRY(const std::string text, ReadFile(path, 1 << 20));
  SamplesEntry entry;
  FORESIGHT_CHECK(
      ParseYaml(text, path.string(), [&](YamlMap& map) { entry = SamplesFromYaml(map); }));
  RobotFrameSamples read;
  read.source = entry.source;
  for (std::size_t i = 0; i < entry.samples.size(); ++i) {
    if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "reading the samples: cancelled");
    SampleEntry& sample = entry.samples[i];
    if (!sample.has_pose) {
      FORESIGHT_TRY(const auto located,
                    Located(path.parent_path(), sample, *entry.board, rig, &read.left_out));
      if (!located) continue;
      sample.sample.base_from_board = *located;
    }
    read.samples.push_back(std::move(sample.sample));
    context.Report(static_cast<double>(i + 1) / static_cast<double>(entry.samples.size()),
                   "looking for boards");
  }
  return read;
}

Result<RobotFrameCalibration> CalibrateRobotFrame(const RobotFrameSamples& samples,
                                                  const HandEyeOptions& options) {
  RobotFrameCalibration calibration;
  if (samples.source == RobotFrameSource::kHandEye) {
    std::vector<HandEyeSample> pairs;
    for (const auto& sample : samples.samples)
      pairs.push_back({sample.robot_from_hand, sample.base_from_board});
    FORESIGHT_TRY(calibration.found, CalibrateHandEye(pairs, options));
  } else {
    std::vector<SurveyedBoard> boards;
    for (const auto& sample : samples.samples)
      boards.push_back(
          {Rigid<frame::Robot, frame::Pattern>::FromUnit(sample.robot_from_hand.rotation(),
                                                         sample.robot_from_hand.translation()),
           sample.base_from_board});
    FORESIGHT_TRY(calibration.found, CalibrateSurveyed(boards, options));
  }
  for (const auto& sample : samples.samples) {
    const auto step = StepBetween(sample.robot_from_hand * calibration.found.hand_from_board,
                                  calibration.found.robot_from_base * sample.base_from_board);
    calibration.residuals.push_back({sample.name, step.head<3>().norm(), step.tail<3>().norm()});
  }
  return calibration;
}

}  // namespace foresight
