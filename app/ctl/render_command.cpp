#include <cmath>
#include <memory>

#include "app/common/seed_option.h"
#include "app/ctl/command.h"
#include "app/ctl/true_valve.h"
#include "core/geometry/angles.h"
#include "core/io/pfm.h"
#include "core/io/png.h"
#include "core/simulation/world.h"

namespace foresight {
namespace {

struct RenderArguments {
  std::string scene;
  std::string rig;
  std::string out = ".";
  double angle_deg = 0.0;
  std::uint64_t seed = 1;
  bool json = false;
};

nlohmann::ordered_json PoseJson(const Rigid<frame::Base, frame::Object>& pose) {
  const Eigen::Vector3d t = pose.translation();
  const Eigen::Vector3d axis = pose.Rotate(Eigen::Vector3d::UnitZ());
  return {{"position_m", {t.x(), t.y(), t.z()}}, {"axis", {axis.x(), axis.y(), axis.z()}}};
}

nlohmann::ordered_json ValveJson(const ValveTruth& valve, const World& world, double motor_rad) {
  nlohmann::ordered_json json = {{"name", valve.name},
                                 {"spokes", valve.model.spokes},
                                 {"rim_radius_m", valve.model.rim_radius_m}};
  json["base"] = PoseJson(world.BaseFromRobot() * valve.robot_from_object);
  json["roi"] = nullptr;
  if (const auto roi = RegionOfTrueValve(valve, world, motor_rad)) {
    const Eigen::Vector2d& a = roi->polygon[0];
    const Eigen::Vector2d& b = roi->polygon[2];
    json["roi"] = {a.x(), a.y(), b.x(), b.y()};
  }
  return json;
}

Result<ExitCode> Render(const RenderArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(Scene scene, LoadScene(arguments.scene));
  SensorRig rig = DefaultSensorRig();
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(rig, LoadSensorRig(arguments.rig));
  }
  WorldOptions options;
  options.seed = arguments.seed;
  options.motor.enabled = false;
  const World world(std::make_shared<const Scene>(std::move(scene)), rig, options);
  const double motor_rad = RadiansFromDegrees(arguments.angle_deg);
  const CameraFrame frame = world.CaptureImage(
      0, 0.0, 0.004, 0.0, [&](double) { return motor_rad; }, context);
  DepthImage depth_mm = world.TrueDepth(motor_rad, context);
  for (float& value : depth_mm.values()) value *= 1000.0f;
  if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "rendering was cancelled");

  FORESIGHT_CHECK(MakeOutputFolder(arguments.out));
  const std::filesystem::path folder(arguments.out);
  FORESIGHT_CHECK(WritePng(folder / "image.png", frame.image, PngContent::kCapture));
  FORESIGHT_CHECK(WritePfm(folder / "depth.pfm", depth_mm));
  FORESIGHT_CHECK(SaveSensorRig(rig, folder / "rig.yaml"));
  if (!arguments.json) {
    PrintLine(fmt::format("{}: image.png, depth.pfm (mm), rig.yaml of '{}' at {:.1f} deg",
                          arguments.out, world.scene().name, arguments.angle_deg));
    return ExitCode::kDone;
  }
  auto valves = nlohmann::ordered_json::array();
  for (const ValveTruth& valve : world.scene().valves)
    valves.push_back(ValveJson(valve, world, motor_rad));
  PrintJson({{"scene", world.scene().name},
             {"angle_deg", arguments.angle_deg},
             {"valves", valves},
             {"out", arguments.out}});
  return ExitCode::kDone;
}

}  // namespace

void AddRenderCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command =
      app.add_subcommand("render", "Render a scene: the camera's image and its true depth");
  command->add_option("scene,--scene", arguments->scene, "Scene file (YAML)")->required();
  command->add_option("--rig", arguments->rig,
                      "Calibration of the head (YAML); default: the built-in one");
  command
      ->add_option("--angle", arguments->angle_deg, "Angle of the plate in degrees, up is positive")
      ->check(CLI::Range(-90.0, 90.0))
      ->capture_default_str();
  AddSeedOption(*command, "--seed", arguments->seed, "Seed of the camera's noise")
      ->capture_default_str();
  command->add_option("-o,--out", arguments->out, "Folder for image.png, depth.pfm (mm), rig.yaml")
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print the true objects as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Render(*arguments, context); };
  });
}

}  // namespace foresight
