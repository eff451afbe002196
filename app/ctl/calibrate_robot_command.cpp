#include <memory>

#include "app/ctl/command.h"
#include "core/base/utc_text.h"
#include "core/calibration/robot_frame.h"
#include "core/geometry/angles.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

struct RobotArguments {
  std::string samples;
  std::string rig;
  std::string out;
  double sigma_turn_deg = DegreesFromRadians(HandEyeOptions().sigma_turn_rad);
  double sigma_shift_mm = 1000.0 * HandEyeOptions().sigma_shift_m;
  bool json = false;
};

/// Along or about each axis of base.
Eigen::Vector3d SigmasOf(const HandEyeCalibration& found, int first) {
  return found.covariance.diagonal().segment<3>(first).cwiseSqrt();
}

nlohmann::ordered_json RobotFrameJson(const RobotFrameCalibration& calibration,
                                      const RobotFrameSamples& samples, const SensorRig& rig) {
  const HandEyeCalibration& found = calibration.found;
  const auto list = [](const Eigen::Vector3d& v) {
    return nlohmann::ordered_json{v.x(), v.y(), v.z()};
  };
  nlohmann::ordered_json json = {
      {"rig_id", RigId(rig)},
      {"source", ToString(samples.source)},
      {"samples", samples.samples.size()},
      {"robot_from_base", ToJson(found.robot_from_base)},
      {"sigma_turn_deg", list(Eigen::Vector3d(SigmasOf(found, 0) * DegreesFromRadians(1.0)))},
      {"sigma_shift_mm", list(Eigen::Vector3d(1000.0 * SigmasOf(found, 3)))},
      {"turn_rms_deg", DegreesFromRadians(found.turn_rms_rad)},
      {"shift_rms_mm", 1000.0 * found.shift_rms_m}};
  auto covariance = nlohmann::ordered_json::array();
  for (Eigen::Index row = 0; row < 6; ++row) {
    auto values = nlohmann::ordered_json::array();
    for (Eigen::Index column = 0; column < 6; ++column)
      values.push_back(found.covariance(row, column));
    covariance.push_back(values);
  }
  json["covariance"] = covariance;
  if (samples.source == RobotFrameSource::kHandEye) {
    json["hand_from_board"] = ToJson(found.hand_from_board);
    json["motions"] = {{"turn_rms_deg", DegreesFromRadians(found.turn_rad)},
                       {"spread", found.spread}};
  }
  json["residuals"] = nlohmann::ordered_json::array();
  for (const auto& residual : calibration.residuals)
    json["residuals"].push_back({{"name", residual.name},
                                 {"turn_deg", DegreesFromRadians(residual.turn_rad)},
                                 {"shift_mm", 1000.0 * residual.shift_m}});
  json["left_out"] = samples.left_out;
  return json;
}

std::string Describe(const RobotFrameCalibration& calibration, const RobotFrameSamples& samples) {
  const HandEyeCalibration& found = calibration.found;
  const Eigen::Vector3d t = 1000.0 * found.robot_from_base.translation();
  const Eigen::Vector3d t_sigma = 1000.0 * SigmasOf(found, 3);
  const Eigen::Vector3d r_sigma = DegreesFromRadians(1.0) * SigmasOf(found, 0);
  const Eigen::Quaterniond& q = found.robot_from_base.rotation();
  std::string text = fmt::format(
      "base in robot      {:.1f}, {:.1f}, {:.1f} mm, along base's axes +- {:.2f}, {:.2f}, {:.2f}\n"
      "its turn (w x y z) {:.6f}, {:.6f}, {:.6f}, {:.6f}, about base's axes +- {:.3f}, {:.3f}, "
      "{:.3f} deg\n"
      "{} samples         off by {:.1f} mm and {:.3f} deg (rms)",
      t.x(), t.y(), t.z(), t_sigma.x(), t_sigma.y(), t_sigma.z(), q.w(), q.x(), q.y(), q.z(),
      r_sigma.x(), r_sigma.y(), r_sigma.z(), samples.samples.size(), 1000.0 * found.shift_rms_m,
      DegreesFromRadians(found.turn_rms_rad));
  if (samples.source == RobotFrameSource::kHandEye)
    text += fmt::format("\nmotions            turn by {:.0f} deg (rms), axes spread by {:.2f} of 1",
                        DegreesFromRadians(found.turn_rad), found.spread);
  for (const auto& residual : calibration.residuals)
    text += fmt::format("\n  {:<16} {:.1f} mm, {:.3f} deg", residual.name,
                        1000.0 * residual.shift_m, DegreesFromRadians(residual.turn_rad));
  for (const std::string& reason : samples.left_out) text += "\nleft out           " + reason;
  return text;
}

Result<ExitCode> CalibrateRobot(const RobotArguments& arguments, const RunContext& context) {
  HandEyeOptions options;
  options.sigma_turn_rad = RadiansFromDegrees(arguments.sigma_turn_deg);
  options.sigma_shift_m = 1e-3 * arguments.sigma_shift_mm;
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_TRY(SensorRig rig, LoadSensorRig(arguments.rig));
  FORESIGHT_TRY(const RobotFrameSamples samples,
                ReadRobotFrameSamples(arguments.samples, rig, context));
  FORESIGHT_TRY(const RobotFrameCalibration found,
                CalibrateRobotFrame(samples, options).map_error(Of(arguments.samples)));
  rig.parent_id = RigId(rig);
  rig.date_utc = UtcDateNow();
  rig.robot_from_base = found.found.robot_from_base;
  rig.robot_frame_source = samples.source;
  FORESIGHT_CHECK(rig.Check());
  if (!arguments.out.empty()) FORESIGHT_CHECK(SaveSensorRig(rig, arguments.out));
  if (arguments.json)
    PrintJson(RobotFrameJson(found, samples, rig));
  else
    PrintLine(Describe(found, samples));
  return ExitCode::kDone;
}

}  // namespace

void AddCalibrateRobotCommand(CLI::App& calibrate, Invocation& invocation) {
  const auto arguments = std::make_shared<RobotArguments>();
  CLI::App* command = calibrate.add_subcommand(
      "robot", "Where the head stands on the robot, from boards whose place the robot knows");
  command
      ->add_option("samples", arguments->samples,
                   "Poses from the robot's kinematics with images, corners or poses of the board "
                   "(YAML, docs/formats.md)")
      ->required();
  command->add_option("--rig", arguments->rig, "The calibrated rig (YAML)")->required();
  command->add_option("--out", arguments->out, "Write the rig with the robot's frame (YAML)");
  AddOption(*command, "--sigma-turn", arguments->sigma_turn_deg,
            "Standard deviation of a sample, kinematics and camera together, deg");
  AddOption(*command, "--sigma-shift", arguments->sigma_shift_mm, "The same, mm");
  command->add_flag("--json", arguments->json, "Print all values as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) {
      return CalibrateRobot(*arguments, context);
    };
  });
}

}  // namespace foresight
