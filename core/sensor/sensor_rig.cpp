#include "core/sensor/sensor_rig.h"

#include <array>
#include <cmath>
#include <limits>

#include "core/base/atomic_file.h"
#include "core/geometry/angles.h"
#include "core/io/yaml_reader.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

constexpr int kFormatVersion = 1;

template <class To, class From>
std::string TransformToYaml(const Rigid<To, From>& transform) {
  const Eigen::Quaterniond q = transform.rotation();
  const Eigen::Vector3d t = transform.translation();
  return fmt::format("{{quaternion_wxyz: [{}, {}, {}, {}], translation_m: [{}, {}, {}]}}", q.w(),
                     q.x(), q.y(), q.z(), t.x(), t.y(), t.z());
}

template <class To, class From>
Rigid<To, From> TransformFromYaml(YamlMap map) {
  const std::vector<double> q = map.Numbers("quaternion_wxyz", 4);
  const Eigen::Vector3d t = map.Vector("translation_m");
  map.Finish();
  const Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
  if (std::abs(rotation.norm() - 1.0) > 1e-3) map.Fault("quaternion_wxyz does not have length 1");
  // What we wrote has the length 1 but for rounding, and comes back as it was.
  constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
  if (std::abs(rotation.squaredNorm() - 1.0) <= kRounding)
    return Rigid<To, From>::FromUnit(rotation, t);
  return {rotation, t};
}

template <class L>
Lens LensFromYaml(YamlMap& map) {
  std::array<double, L::kParameters.size()> values{};
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = map.Number(std::string(L::kParameters[i]));
  return L::FromParameters(values);
}

/// Tries each alternative of Lens; nullopt where none has the name.
template <std::size_t index = 0>
std::optional<Lens> LensFromYaml(const std::string& model, YamlMap& map) {
  if constexpr (index == std::variant_size_v<Lens>) {
    return std::nullopt;
  } else {
    using L = std::variant_alternative_t<index, Lens>;
    if (model == L::kModel) return LensFromYaml<L>(map);
    return LensFromYaml<index + 1>(model, map);
  }
}

CameraModel CameraFromYaml(YamlMap map) {
  CameraModel camera;
  const std::string model = map.Text("model");
  camera.width = map.Integer("width");
  camera.height = map.Integer("height");
  camera.fx = map.Number("fx");
  camera.fy = map.Number("fy");
  camera.cx = map.Number("cx");
  camera.cy = map.Number("cy");
  const auto lens = LensFromYaml(model, map);
  if (!lens)
    map.Fault(map.Node("model"),
              "camera model '" + model + "' is not known; it is fisheye_k, radtan, kb4 or eucm");
  camera.lens = *lens;
  map.Finish();
  if (const auto fault = camera.FindFault())
    map.Fault(map.Node(std::string(fault->parameter)), "camera: " + fault->message);
  return camera;
}

LidarModel LidarFromYaml(YamlMap map) {
  LidarModel lidar;
  lidar.beams = map.Integer("beams");
  lidar.first_angle_rad = map.Number("first_angle_rad");
  lidar.angle_step_rad = map.Number("angle_step_rad");
  lidar.period_s = map.Number("period_s");
  lidar.min_range_m = map.Number("min_range_m");
  lidar.max_range_m = map.Number("max_range_m");
  lidar.range_offset_m = map.Number("range_offset_m");
  lidar.stamp_offset_s = map.Number("stamp_offset_s");
  map.Finish();
  return lidar;
}

AngleCorrection CorrectionFromYaml(YamlMap& map) {
  std::vector<AngleCorrection::Knot> knots;
  for (YamlMap& entry : map.List("angle_correction")) {
    AngleCorrection::Knot knot;
    knot.motor_rad = entry.Number("motor_rad");
    knot.plate_rad = entry.Number("plate_rad");
    knots.push_back(knot);
    entry.Finish();
  }
  auto correction = AngleCorrection::FromKnots(std::move(knots));
  if (!correction) map.Fault(correction.error().message);
  return *correction;
}

constexpr std::array kRobotFrameSources = {RobotFrameSource::kCad, RobotFrameSource::kHandEye,
                                           RobotFrameSource::kSurveyedBoards};

RobotFrameSource RobotFrameSourceFromYaml(YamlMap& map) {
  if (!map.Has("robot_from_base_source")) return RobotFrameSource::kUnknown;
  const std::string text = map.Text("robot_from_base_source");
  for (const RobotFrameSource source : kRobotFrameSources)
    if (text == ToString(source)) return source;
  map.Fault(map.Node("robot_from_base_source"),
            "'" + text + "' is not cad, hand_eye or surveyed_boards");
}

Status CheckDate(const SensorRig& rig) {
  return rig.date_utc.empty() ? Status() : CheckUtcDate(rig.date_utc);
}

Status CheckParent(const SensorRig& rig) {
  return rig.parent_id.empty() ? Status() : CheckRigId(rig.parent_id);
}

}  // namespace

Status SensorRig::Check() const {
  FORESIGHT_CHECK(CheckDate(*this));
  FORESIGHT_CHECK(CheckParent(*this));
  FORESIGHT_CHECK(camera.Check());
  FORESIGHT_CHECK(lidar.Check());
  for (const auto& t : {camera_from_head.translation(), camera_from_lidar.translation()})
    if (!t.allFinite() || t.norm() > 2.0)
      return Fail(ErrorCode::kInvalidOptions,
                  "rig: a sensor {:.2f} m from the head's axis is not on one plate with it",
                  t.norm());
  // Far away a scene is smaller than the last digit of a coordinate.
  constexpr double kFarthest_m = 1000.0;
  const Eigen::Vector3d mount = robot_from_base.translation();
  if (!mount.allFinite() || mount.norm() > kFarthest_m)
    return Fail(ErrorCode::kInvalidOptions,
                "rig: robot_from_base: a head {:.3g} m from the robot's origin; at most {:.0f} m",
                mount.norm(), kFarthest_m);
  return {};
}

SensorRig DefaultSensorRig() {
  SensorRig rig;
  rig.name = "default";
  rig.camera = {.width = 1288,
                .height = 964,
                .fx = 601.0,
                .fy = 601.0,
                .cx = 643.5,
                .cy = 481.5,
                .lens = FisheyeLens{0.9413}};
  // Both sensors look along the head's z axis. The lidar sits below the camera.
  rig.camera_from_head = {Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.035, -0.040)};
  Eigen::Matrix3d camera_from_lidar;
  camera_from_lidar << 0, -1, 0,  //
      0, 0, -1,                   //
      1, 0, 0;
  rig.camera_from_lidar = {camera_from_lidar, Eigen::Vector3d(0.0, 0.070, -0.015)};
  // The head is mounted at a standing robot's eye height, base x to the robot's right.
  Eigen::Matrix3d robot_from_base;
  robot_from_base << 0, 0, 1,  //
      -1, 0, 0,                //
      0, -1, 0;
  rig.robot_from_base = {robot_from_base, Eigen::Vector3d(0.1, 0.0, 1.4)};
  return rig;
}

std::string SensorRigToYaml(const SensorRig& rig) {
  const CameraModel& c = rig.camera;
  const LidarModel& l = rig.lidar;
  const auto quoted = [](const std::string& text) {
    YAML::Emitter emitter;
    emitter << YAML::DoubleQuoted << text;
    return std::string(emitter.c_str());
  };
  std::string yaml =
      "# A sensor head's calibration: docs/formats.md. Lengths in metres, angles in radians.\n";
  yaml += fmt::format("foresight_rig: {}\n", kFormatVersion);
  yaml += fmt::format("name: {}\n", quoted(rig.name));
  yaml += fmt::format("id: \"{}\"\n", RigId(rig));
  if (!rig.date_utc.empty()) yaml += fmt::format("date: {}\n", quoted(rig.date_utc));
  if (!rig.parent_id.empty()) yaml += fmt::format("parent: {}\n", quoted(rig.parent_id));
  yaml +=
      fmt::format("camera:\n  model: {}\n  width: {}\n  height: {}\n", c.Key(), c.width, c.height);
  const std::vector<std::string_view> names = c.ParameterNames();
  const CameraModel::Parameters values = c.Values();
  for (std::size_t i = 0; i < names.size(); ++i)
    yaml += fmt::format("  {}: {}\n", names[i], values[static_cast<Eigen::Index>(i)]);
  yaml += fmt::format(
      "lidar:\n  beams: {}\n  first_angle_rad: {}\n  angle_step_rad: {}\n  period_s: {}\n"
      "  min_range_m: {}\n  max_range_m: {}\n  range_offset_m: {}\n  stamp_offset_s: {}\n",
      l.beams, l.first_angle_rad, l.angle_step_rad, l.period_s, l.min_range_m, l.max_range_m,
      l.range_offset_m, l.stamp_offset_s);
  yaml += "camera_from_head: " + TransformToYaml(rig.camera_from_head) + "\n";
  yaml += "camera_from_lidar: " + TransformToYaml(rig.camera_from_lidar) + "\n";
  yaml += "robot_from_base: " + TransformToYaml(rig.robot_from_base) + "\n";
  if (rig.robot_frame_source != RobotFrameSource::kUnknown)
    yaml += fmt::format("robot_from_base_source: {}\n", ToString(rig.robot_frame_source));
  if (!rig.angle_correction.knots().empty()) yaml += "angle_correction:\n";
  for (const auto& knot : rig.angle_correction.knots())
    yaml += fmt::format("  - {{motor_rad: {}, plate_rad: {}}}\n", knot.motor_rad, knot.plate_rad);
  return yaml;
}

Result<SensorRig> SensorRigFromYaml(const std::string& yaml, const std::string& source) {
  SensorRig rig;
  FORESIGHT_CHECK(ParseYaml(yaml, source, [&](YamlMap& map) {
    const int version = map.Integer("foresight_rig");
    if (version != kFormatVersion)
      map.Fault(fmt::format("rig format {} is not known; this program reads {}", version,
                            kFormatVersion));
    rig.name = map.Text("name");
    const std::string stated_id = map.Text("id", "");
    rig.date_utc = map.Text("date", "");
    if (const Status date = CheckDate(rig); !date)
      map.Fault(map.Node("date"), date.error().message);
    rig.parent_id = map.Text("parent", "");
    if (const Status parent = CheckParent(rig); !parent)
      map.Fault(map.Node("parent"), parent.error().message);
    rig.camera = CameraFromYaml(map.Map("camera"));
    rig.lidar = LidarFromYaml(map.Map("lidar"));
    rig.camera_from_head =
        TransformFromYaml<frame::Camera, frame::Head>(map.Map("camera_from_head"));
    rig.camera_from_lidar =
        TransformFromYaml<frame::Camera, frame::Lidar>(map.Map("camera_from_lidar"));
    rig.robot_from_base = TransformFromYaml<frame::Robot, frame::Base>(map.Map("robot_from_base"));
    rig.robot_frame_source = RobotFrameSourceFromYaml(map);
    rig.angle_correction = CorrectionFromYaml(map);
    map.Finish();
    if (!map.Has("id") || stated_id == RigId(rig)) return;
    map.Fault(map.Node("id"),
              fmt::format("the id says {}, but the values of this rig give {}: a value was changed "
                          "after the id was written. Restore it, or delete the line with the id",
                          stated_id, RigId(rig)));
  }));
  if (const Status status = rig.Check(); !status)
    return Fail(ErrorCode::kBadData, "{}: {}", source, status.error().message);
  return rig;
}

Result<SensorRig> LoadSensorRig(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string yaml, ReadFile(path, 1 << 20));
  return SensorRigFromYaml(yaml, path.string());
}

Status SaveSensorRig(const SensorRig& rig, const std::filesystem::path& path) {
  FORESIGHT_CHECK(rig.Check());
  return WriteFileAtomically(path, SensorRigToYaml(rig));
}

}  // namespace foresight
