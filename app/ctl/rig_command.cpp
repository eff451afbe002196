#include <cmath>
#include <memory>

#include "app/ctl/command.h"
#include "core/base/atomic_file.h"
#include "core/calibration/camera_formats.h"
#include "core/calibration/compare_rigs.h"
#include "core/geometry/angles.h"
#include "core/sensor/rig_id.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {
namespace {

struct RigArguments {
  std::string file;
  std::string other;
  std::string format;
  std::string rig;
  std::string out;
  std::vector<double> position_m;
  std::vector<double> rpy_deg;
  std::vector<double> quaternion;
  bool json = false;
};

/// From edge to edge through the principal point; NaN where an edge shows nothing.
double FieldOfView(const CameraModel& camera, const Eigen::Vector2d& from,
                   const Eigen::Vector2d& to) {
  const auto angle = [&camera](const Eigen::Vector2d& pixel) {
    const auto ray = camera.Unproject(pixel);
    return ray ? std::atan2(ray->head<2>().norm(), ray->z()) : std::nan("");
  };
  return angle(from) + angle(to);
}

double HorizontalField(const CameraModel& camera) {
  return FieldOfView(camera, {-0.5, camera.cy}, {camera.width - 0.5, camera.cy});
}

double VerticalField(const CameraModel& camera) {
  return FieldOfView(camera, {camera.cx, -0.5}, {camera.cx, camera.height - 0.5});
}

nlohmann::ordered_json ToJson(const CameraModel& camera) {
  nlohmann::ordered_json json = {{"model", camera.Key()},
                                 {"name", camera.Name()},
                                 {"width", camera.width},
                                 {"height", camera.height}};
  const std::vector<std::string_view> names = camera.ParameterNames();
  const CameraModel::Parameters values = camera.Values();
  for (std::size_t i = 0; i < names.size(); ++i)
    json[std::string(names[i])] = values[static_cast<Eigen::Index>(i)];
  json["field_of_view_deg"] = {FiniteOrNull(DegreesFromRadians(HorizontalField(camera))),
                               FiniteOrNull(DegreesFromRadians(VerticalField(camera)))};
  return json;
}

nlohmann::ordered_json ToJson(const LidarModel& lidar) {
  return {{"beams", lidar.beams},
          {"first_angle_rad", lidar.first_angle_rad},
          {"angle_step_rad", lidar.angle_step_rad},
          {"period_s", lidar.period_s},
          {"min_range_m", lidar.min_range_m},
          {"max_range_m", lidar.max_range_m},
          {"range_offset_m", lidar.range_offset_m},
          {"stamp_offset_s", lidar.stamp_offset_s}};
}

nlohmann::ordered_json ToJson(const SensorRig& rig) {
  const auto text_or_null = [](const std::string& text) {
    return text.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(text);
  };
  auto knots = nlohmann::ordered_json::array();
  for (const auto& knot : rig.angle_correction.knots())
    knots.push_back({{"motor_rad", knot.motor_rad}, {"plate_rad", knot.plate_rad}});
  return {{"name", rig.name},
          {"id", RigId(rig)},
          {"date", text_or_null(rig.date_utc)},
          {"parent", text_or_null(rig.parent_id)},
          {"camera", ToJson(rig.camera)},
          {"lidar", ToJson(rig.lidar)},
          {"camera_from_head", ToJson(rig.camera_from_head)},
          {"camera_from_lidar", ToJson(rig.camera_from_lidar)},
          {"robot_from_base", ToJson(rig.robot_from_base)},
          {"robot_from_base_source", text_or_null(std::string(ToString(rig.robot_frame_source)))},
          {"angle_correction", knots}};
}

std::string DescribeField(double field_rad) {
  return std::isfinite(field_rad) ? fmt::format("{:.1f}", DegreesFromRadians(field_rad))
                                  : "beyond the lens";
}

std::string Describe(const CameraModel& camera) {
  std::string text;
  const std::vector<std::string_view> names = camera.ParameterNames();
  const CameraModel::Parameters values = camera.Values();
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("{}{} {:.6g}", i == 0 ? "" : ", ", names[i],
                        values[static_cast<Eigen::Index>(i)]);
  return text;
}

template <class To, class From>
std::string Describe(const Rigid<To, From>& transform) {
  const Eigen::Vector3d t = 1000.0 * transform.translation();
  const double turn_rad = Eigen::AngleAxisd(transform.rotation()).angle();
  return fmt::format("{:.1f}, {:.1f}, {:.1f} mm, turned by {:.2f} deg", t.x(), t.y(), t.z(),
                     DegreesFromRadians(turn_rad));
}

std::string DescribeSource(RobotFrameSource source) {
  switch (source) {
    case RobotFrameSource::kCad:
      return "; typed from CAD, not measured";
    case RobotFrameSource::kHandEye:
      return "; measured with a board on the robot's hand";
    case RobotFrameSource::kSurveyedBoards:
      return "; measured with boards at surveyed places";
    case RobotFrameSource::kUnknown:
      break;
  }
  return "";
}

std::string Describe(const SensorRig& rig) {
  std::string text;
  const auto add = [&text](const char* title, const std::string& value) {
    text += fmt::format("{}{:<19}{}", text.empty() ? "" : "\n", title, value);
  };
  add("rig", fmt::format("{}, {}", rig.name, ShortRigId(rig)));
  add("id", RigId(rig));
  add("date", rig.date_utc.empty() ? "not stated" : rig.date_utc);
  add("parent", rig.parent_id.empty() ? "none" : rig.parent_id);
  add("camera model", fmt::format("{} ({})", rig.camera.Name(), rig.camera.Key()));
  add("image", fmt::format("{} x {} px", rig.camera.width, rig.camera.height));
  add("parameters", Describe(rig.camera));
  add("field of view, deg", fmt::format("{} x {}", DescribeField(HorizontalField(rig.camera)),
                                        DescribeField(VerticalField(rig.camera))));
  add("lidar",
      fmt::format("{} beams every {:.3f} deg, a line every {:.2f} ms, {} to {} m", rig.lidar.beams,
                  DegreesFromRadians(rig.lidar.angle_step_rad), 1000.0 * rig.lidar.period_s,
                  rig.lidar.min_range_m, rig.lidar.max_range_m));
  add("lidar's offsets",
      fmt::format("range {:.1f} mm, time stamp {:.3f} ms", 1000.0 * rig.lidar.range_offset_m,
                  1000.0 * rig.lidar.stamp_offset_s));
  add("camera from head", Describe(rig.camera_from_head));
  add("camera from lidar", Describe(rig.camera_from_lidar));
  add("robot from base", Describe(rig.robot_from_base) + DescribeSource(rig.robot_frame_source));
  add("angle correction", rig.angle_correction.knots().empty()
                              ? "none"
                              : fmt::format("{} angles", rig.angle_correction.knots().size()));
  return text;
}

Result<ExitCode> ShowRig(const RigArguments& arguments) {
  FORESIGHT_TRY(const SensorRig rig, LoadSensorRig(arguments.file));
  if (arguments.json)
    PrintJson(ToJson(rig));
  else
    PrintLine(Describe(rig));
  return ExitCode::kDone;
}

std::string Describe(const RigError& error) {
  return fmt::format(
      "camera         {:.3f} px rms over the image, {:.3f} px most\n"
      "motor's axis   {:.4f} deg, {:.3f} mm\n"
      "plate's angles {:.4f} deg rms, {:.4f} deg most\n"
      "lidar          {:.4f} deg, {:.3f} mm\n"
      "range offset   {:+.2f} mm\n"
      "stamp offset   {:+.3f} ms",
      error.camera_rms_px, error.camera_most_px, DegreesFromRadians(error.axis_rad),
      1e3 * error.axis_m, DegreesFromRadians(error.angles_rms_rad),
      DegreesFromRadians(error.angles_most_rad), DegreesFromRadians(error.lidar_rad),
      1e3 * error.lidar_m, 1e3 * error.range_offset_m, 1e3 * error.stamp_offset_s);
}

nlohmann::ordered_json ToJson(const RigError& error) {
  return {{"camera_rms_px", FiniteOrNull(error.camera_rms_px)},
          {"camera_most_px", FiniteOrNull(error.camera_most_px)},
          {"axis_deg", DegreesFromRadians(error.axis_rad)},
          {"axis_mm", 1e3 * error.axis_m},
          {"angles_rms_deg", DegreesFromRadians(error.angles_rms_rad)},
          {"angles_most_deg", DegreesFromRadians(error.angles_most_rad)},
          {"lidar_deg", DegreesFromRadians(error.lidar_rad)},
          {"lidar_mm", 1e3 * error.lidar_m},
          {"range_offset_mm", 1e3 * error.range_offset_m},
          {"stamp_offset_ms", 1e3 * error.stamp_offset_s}};
}

Result<ExitCode> CompareRigFiles(const RigArguments& arguments) {
  FORESIGHT_TRY(const SensorRig rig, LoadSensorRig(arguments.file));
  FORESIGHT_TRY(const SensorRig other, LoadSensorRig(arguments.other));
  FORESIGHT_TRY(const RigError error, CompareRigs(rig, other));
  if (arguments.json)
    PrintJson(ToJson(error));
  else
    PrintLine(Describe(error));
  return ExitCode::kDone;
}

Result<ExitCode> ExportRig(const RigArguments& arguments) {
  FORESIGHT_TRY(const CameraFormat format, CameraFormatFromText(arguments.format));
  FORESIGHT_TRY(const SensorRig rig, LoadSensorRig(arguments.file));
  FORESIGHT_TRY(const CameraExport camera, ExportCamera(rig.camera, format));
  FORESIGHT_CHECK(WriteFileAtomically(arguments.out, camera.text));
  if (arguments.json) {
    nlohmann::ordered_json json = {
        {"file", arguments.out}, {"model", camera.model}, {"refit", camera.refit.has_value()}};
    if (camera.refit) {
      json["max_error_px"] = camera.refit->max_error_px;
      json["rms_error_px"] = camera.refit->rms_error_px;
      json["max_error_at"] = {camera.refit->max_at.x(), camera.refit->max_at.y()};
      json["pixels_not_shown"] = camera.refit->not_shown;
    }
    PrintJson(json);
    return ExitCode::kDone;
  }
  PrintLine(fmt::format("{}: {} for {}", arguments.out, camera.model, ToString(format)));
  if (camera.refit)
    PrintLine(fmt::format(
        "{} has no name for the model {}: a refit was written, off by {:.4f} px at most (near "
        "{:.0f}, {:.0f}) and {:.4f} px rms{}",
        ToString(format), rig.camera.Key(), camera.refit->max_error_px, camera.refit->max_at.x(),
        camera.refit->max_at.y(), camera.refit->rms_error_px,
        camera.refit->not_shown == 0 ? "" : "; it does not show all of the image"));
  return ExitCode::kDone;
}

Result<ExitCode> ImportRig(const RigArguments& arguments) {
  FORESIGHT_TRY(const CameraFormat format, CameraFormatFromText(arguments.format));
  FORESIGHT_TRY(const std::string text, ReadFile(arguments.file));
  FORESIGHT_TRY(const CameraModel camera, ImportCamera(text, format, arguments.file));
  SensorRig rig = DefaultSensorRig();
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(rig, LoadSensorRig(arguments.rig));
  }
  rig.parent_id = RigId(rig);
  rig.date_utc.clear();  // when that camera was calibrated is not known
  rig.camera = camera;
  FORESIGHT_CHECK(SaveSensorRig(rig, arguments.out));
  PrintLine(arguments.json ? ToJson(rig).dump(2)
                           : fmt::format("{}: rig {} with a {} camera", arguments.out,
                                         ShortRigId(rig), camera.Name()));
  return ExitCode::kDone;
}

Result<Eigen::Quaterniond> TurnFrom(const RigArguments& arguments) {
  if (!arguments.rpy_deg.empty()) {
    const auto turn = [&](std::size_t i, const Eigen::Vector3d& axis) {
      return Eigen::AngleAxisd(RadiansFromDegrees(arguments.rpy_deg[i]), axis);
    };
    return Eigen::Quaterniond(turn(2, Eigen::Vector3d::UnitZ()) *
                              turn(1, Eigen::Vector3d::UnitY()) *
                              turn(0, Eigen::Vector3d::UnitX()));
  }
  const std::vector<double>& q = arguments.quaternion;
  const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
  if (!(std::abs(turn.norm() - 1.0) < 1e-3))
    return Fail(ErrorCode::kInvalidOptions, "--quaternion: its length is {:.6g}, not 1",
                turn.norm());
  return turn;
}

Result<ExitCode> SetRobotFrame(const RigArguments& arguments) {
  FORESIGHT_TRY(const Eigen::Quaterniond turn, TurnFrom(arguments));
  FORESIGHT_TRY(SensorRig rig, LoadSensorRig(arguments.file));
  rig.parent_id = RigId(rig);
  rig.robot_from_base = {turn, Eigen::Vector3d(arguments.position_m[0], arguments.position_m[1],
                                               arguments.position_m[2])};
  rig.robot_frame_source = RobotFrameSource::kCad;
  FORESIGHT_CHECK(SaveSensorRig(rig, arguments.out));
  PrintLine(arguments.json ? ToJson(rig).dump(2)
                           : fmt::format("{}: rig {} with its robot's frame typed from CAD",
                                         arguments.out, ShortRigId(rig)));
  return ExitCode::kDone;
}

void AddSetRobotFrame(CLI::App& rig, Invocation& invocation,
                      const std::shared_ptr<RigArguments>& arguments) {
  CLI::App* command = rig.add_subcommand(
      "set-robot-frame",
      "Where the head is mounted on the robot, typed from CAD; the rig says that it was not "
      "measured");
  command->add_option("file", arguments->file, "The rig (YAML)")->required();
  command
      ->add_option("--position", arguments->position_m,
                   "Base's origin in robot, X,Y,Z in metres (x forward, y left, z up)")
      ->delimiter(',')
      ->expected(3)
      ->required();
  CLI::Option_group* turn = command->add_option_group("turn");
  turn->add_option("--rpy", arguments->rpy_deg,
                   "Roll,pitch,yaw of base in robot in degrees, about robot's fixed axes, as URDF")
      ->delimiter(',')
      ->expected(3);
  turn->add_option("--quaternion", arguments->quaternion, "The same as W,X,Y,Z")
      ->delimiter(',')
      ->expected(4);
  turn->require_option(1);
  command->add_option("--out", arguments->out, "The new rig (YAML)")->required();
  command->add_flag("--json", arguments->json, "Print all values as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext&) { return SetRobotFrame(*arguments); };
  });
}

}  // namespace

void AddRigCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<RigArguments>();
  CLI::App* rig = app.add_subcommand("rig", "Calibrations of heads");
  rig->require_subcommand(1);
  CLI::App* show = rig->add_subcommand(
      "show", "Check a rig's file and say its camera model, id, date, parent and main values");
  show->add_option("file", arguments->file, "The rig (YAML)")->required();
  show->add_flag("--json", arguments->json, "Print all values as JSON");
  show->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext&) { return ShowRig(*arguments); };
  });
  CLI::App* compare = rig->add_subcommand(
      "compare",
      "How one rig differs from another, such as the truth of a simulation, in what does not "
      "depend on the choice of frames");
  compare->add_option("file", arguments->file, "The rig (YAML)")->required();
  compare->add_option("other", arguments->other, "The other rig (YAML)")->required();
  compare->add_flag("--json", arguments->json, "Print the differences as JSON");
  compare->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext&) { return CompareRigFiles(*arguments); };
  });
  AddSetRobotFrame(*rig, invocation, arguments);
  constexpr const char* kFormats = "opencv, ros (camera_info), kalibr (camchain), colmap";
  CLI::App* to_others =
      rig->add_subcommand("export", "Write a rig's camera as other programs read it");
  to_others->add_option("file", arguments->file, "The rig (YAML)")->required();
  to_others->add_option("--format", arguments->format, kFormats)->required();
  to_others->add_option("--out", arguments->out, "The file")->required();
  to_others->add_flag("--json", arguments->json, "Print the model and the refit's errors as JSON");
  to_others->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext&) { return ExportRig(*arguments); };
  });
  CLI::App* from_others =
      rig->add_subcommand("import", "Put a camera that another program calibrated into a rig");
  from_others->add_option("file", arguments->file, "That program's file")->required();
  from_others->add_option("--format", arguments->format, kFormats)->required();
  from_others->add_option("--rig", arguments->rig,
                          "The rig that gets the camera; else the default one");
  from_others->add_option("--out", arguments->out, "The new rig (YAML)")->required();
  from_others->add_flag("--json", arguments->json, "Print all values as JSON");
  from_others->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext&) { return ImportRig(*arguments); };
  });
}

}  // namespace foresight
