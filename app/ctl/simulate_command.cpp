#include <map>
#include <memory>

#include "app/ctl/command.h"
#include "core/base/atomic_file.h"
#include "core/calibration/session_file.h"
#include "core/evaluation/calibration_images.h"
#include "core/evaluation/calibration_scene.h"
#include "core/geometry/angles.h"
#include "core/simulation/motor_simulator.h"

namespace foresight {
namespace {

struct SimulateArguments {
  std::string folder;
  std::string mount = "normal";
  bool images = false;
  bool scene = false;
  CalibrationSimulation simulation;
  double prior_error_deg = DegreesFromRadians(CalibrationSimulation().prior_error_rad);
  double prior_error_mm = 1000.0 * CalibrationSimulation().prior_error_m;
  double range_sigma_mm = 1000.0 * CalibrationSimulation().range_sigma_m;
  double range_bias_mm = 0.0;
  double stamp_offset_ms = 1000.0 * CalibrationSimulation().stamp_offset_s;
  double repeatability_deg = DegreesFromRadians(CalibrationSimulation().repeatability_rad);
  double dihedral_error_deg = DegreesFromRadians(CalibrationSimulation().dihedral_error_rad);
};

const std::map<std::string, CameraMount> kMounts = {{"normal", CameraMount::kNormal},
                                                    {"portrait", CameraMount::kPortrait},
                                                    {"upside-down", CameraMount::kUpsideDown}};

/// What a head can record the session in, in place of the session.
Status WriteScene(const SimulatedCalibration& made, const std::filesystem::path& folder) {
  FORESIGHT_CHECK(MakeOutputFolder(folder));
  FORESIGHT_CHECK(WriteFileAtomically(folder / "scene.yaml", CalibrationSceneYaml(made)));
  return SaveSensorRig(made.session.prior, folder / "prior.yaml");
}

/// The plate of an emulated head follows the head's own motor, not its rig: at the session's stops
/// the truth has that motor's angles. Which motor it is depends on the head's seed; here its
/// default.
Status TakeEmulatedAngles(SensorRig* truth) {
  const MotorSimulator motor(WorldOptions().motor, WorldOptions().seed);
  const auto stops = truth->angle_correction.knots();
  std::vector<AngleCorrection::Knot> knots(stops.begin(), stops.end());
  for (AngleCorrection::Knot& knot : knots)
    knot.plate_rad = motor.PlateAngle(knot.motor_rad, true) - motor.PlateAngle(0.0, true);
  FORESIGHT_TRY(truth->angle_correction, AngleCorrection::FromKnots(std::move(knots)));
  return {};
}

Result<ExitCode> Simulate(const SimulateArguments& arguments, const RunContext& context) {
  CalibrationSimulation simulation = arguments.simulation;
  simulation.distinct_boards = arguments.images || arguments.scene;
  simulation.mount = kMounts.at(arguments.mount);
  simulation.prior_error_rad = RadiansFromDegrees(arguments.prior_error_deg);
  simulation.prior_error_m = 1e-3 * arguments.prior_error_mm;
  simulation.range_sigma_m = 1e-3 * arguments.range_sigma_mm;
  simulation.range_bias_m = 1e-3 * arguments.range_bias_mm;
  simulation.stamp_offset_s = 1e-3 * arguments.stamp_offset_ms;
  simulation.repeatability_rad = RadiansFromDegrees(arguments.repeatability_deg);
  simulation.dihedral_error_rad = RadiansFromDegrees(arguments.dihedral_error_deg);
  FORESIGHT_TRY(SimulatedCalibration made, SimulateCalibration(simulation));
  if (arguments.scene) {
    MarkBoards(&made.session.mount);
    FORESIGHT_CHECK(TakeEmulatedAngles(&made.truth));
    FORESIGHT_CHECK(WriteScene(made, arguments.folder));
  } else if (arguments.images) {
    FORESIGHT_CHECK(WriteSimulatedImages(made, simulation.seed, arguments.folder, context));
  } else {
    FORESIGHT_CHECK(WriteCalibrationSession(made.session, arguments.folder));
  }
  const std::filesystem::path truth = std::filesystem::path(arguments.folder) / "truth.yaml";
  FORESIGHT_CHECK(SaveSensorRig(made.truth, truth));
  PrintLine(fmt::format("{}: {} poses of the stand, {} intrinsic images; the truth is in {}",
                        arguments.folder, made.session.poses.size(),
                        made.session.intrinsic_views.size(), truth.string()));
  return ExitCode::kDone;
}

void AddCalibration(CLI::App& simulate, Invocation& invocation) {
  const auto arguments = std::make_shared<SimulateArguments>();
  CalibrationSimulation& s = arguments->simulation;
  CLI::App* command = simulate.add_subcommand(
      "calibration", "A calibration session with its truth: corners, lidar lines and sweeps");
  command->add_option("folder", arguments->folder, "The session's folder, a new one")->required();
  const auto option = [&](const char* name, auto& value, const char* help) {
    AddOption(*command, name, value, help);
  };
  option("--seed", s.seed, "The same seed gives the same session");
  command->add_option("--mount", arguments->mount, "How the camera is mounted")
      ->check(CLI::IsMember({"normal", "portrait", "upside-down"}))
      ->capture_default_str();
  command->add_flag("--images", arguments->images,
                    "Painted images of the intrinsic views instead of their corners");
  command
      ->add_flag("--scene", arguments->scene,
                 "A scene with the boards, the true head and the drawn one, in place of the "
                 "session: for calibrate record")
      ->excludes("--images");
  option("--views", s.intrinsic_views, "Images of a board for the camera alone");
  option("--poses", s.poses, "Poses of the stand of two boards");
  option("--first-stop", s.first_stop_deg, "Lowest stop of the motor, deg");
  option("--last-stop", s.last_stop_deg, "Highest stop, deg");
  option("--stop-step", s.stop_step_deg, "Between stops, deg");
  option("--scans", s.scans_per_stop, "Lidar lines at a stop");
  option("--sweeps", s.sweeps, "Poses before which the head sweeps too");
  command->add_flag("--one-way", s.one_way_sweep, "Sweep up only");
  option("--speed", s.sweep_speed_deg_s, "Of the sweep, deg/s");
  option("--corner-sigma", s.corner_sigma_px, "Noise of a corner an axis, px");
  option("--range-sigma", arguments->range_sigma_mm, "Noise of a range, mm");
  option("--range-bias", arguments->range_bias_mm, "Ranges read longer by this, mm");
  option("--stamp-offset", arguments->stamp_offset_ms, "Lines are stamped this early, ms");
  option("--spikes", s.spike_ratio, "Ratio of returns at a random range");
  option("--repeatability", arguments->repeatability_deg, "Of a stop, deg");
  option("--dihedral-error", arguments->dihedral_error_deg,
         "Of the stand against its drawing, deg an axis");
  option("--prior-error", arguments->prior_error_deg, "Of the CAD poses, deg");
  option("--prior-shift", arguments->prior_error_mm, "Of the CAD poses, mm");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Simulate(*arguments, context); };
  });
}

}  // namespace

void AddSimulateCommand(CLI::App& app, Invocation& invocation) {
  CLI::App* simulate = app.add_subcommand("simulate", "Make data whose truth is known");
  simulate->require_subcommand(1);
  AddCalibration(*simulate, invocation);
}

}  // namespace foresight
