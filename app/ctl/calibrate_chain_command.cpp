#include <chrono>
#include <memory>

#include "app/ctl/calibration_report.h"
#include "app/ctl/command.h"
#include "core/base/utc_text.h"
#include "core/calibration/session_file.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

struct ChainArguments {
  std::string session;
  std::string out;
  std::string report;
  std::string lenses;
  bool json = false;
  bool paper = false;
  bool leave_out = false;
  bool fixed_noise = false;
  double corner_px = ChainNoise().corner_px;
  double range_mm = 0.0;
};

/// Whole seconds, as rigs have it.
std::string UtcNow() {
  const auto now =
      std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()).time_since_epoch();
  const std::string text = UtcText(std::chrono::nanoseconds(now).count());
  return text.substr(0, text.find('.')) + "Z";
}

Result<ChainCalibrationOptions> OptionsFrom(const ChainArguments& arguments,
                                            CalibrationStage stage) {
  ChainCalibrationOptions options;
  if (!arguments.lenses.empty()) {
    FORESIGHT_TRY(options.lenses, LensModelsFromText(arguments.lenses));
  }
  options.stage = stage;
  options.as_in_the_paper = arguments.paper;
  if (arguments.leave_out) options.loose_stops = MotorCalibrationOptions::LooseStops::kLeaveOut;
  options.noise.corner_px = arguments.corner_px;
  options.range_sigma_m = 1e-3 * arguments.range_mm;
  options.noise_from_residuals = !arguments.fixed_noise;
  return options;
}

Result<ExitCode> Calibrate(const ChainArguments& arguments, CalibrationStage stage,
                           const RunContext& context) {
  FORESIGHT_TRY(const ChainCalibrationOptions options, OptionsFrom(arguments, stage));
  FORESIGHT_TRY(const CalibrationSession session,
                ReadCalibrationSession(arguments.session, context.Part(0.0, 0.5)));
  FORESIGHT_TRY(ChainCalibration found, CalibrateChain(session, options, context.Part(0.5, 1.0)));
  found.rig.name = session.name;
  found.rig.date_utc = UtcNow();
  found.rig.parent_id = RigId(session.prior);
  if (!arguments.out.empty()) FORESIGHT_CHECK(SaveSensorRig(found.rig, arguments.out));
  if (!arguments.report.empty()) {
    FORESIGHT_CHECK(MakeOutputFolder(arguments.report));
    FORESIGHT_CHECK(WriteHtmlReport(CalibrationReport(found, session.name), arguments.report));
  }
  if (arguments.json)
    PrintJson(CalibrationJson(found));
  else
    PrintLine(DescribeCalibration(found));
  return ExitCode::kDone;
}

void AddStage(CLI::App& calibrate, Invocation& invocation, const char* name, const char* help,
              CalibrationStage stage) {
  const auto arguments = std::make_shared<ChainArguments>();
  CLI::App* command = calibrate.add_subcommand(name, help);
  command->add_option("session", arguments->session, "The session's folder (docs/formats.md)")
      ->required();
  command->add_option("--out", arguments->out, "Write the rig (YAML)");
  command->add_option("--report", arguments->report,
                      "Write a page with tables and charts into this folder");
  command->add_flag("--json", arguments->json, "Print all values as JSON");
  command->add_option("--model", arguments->lenses,
                      "Models of the camera to choose from, of k, eucm, kb4, radtan; else the "
                      "prior's, where the session has images for it");
  command->add_flag("--paper", arguments->paper,
                    "Section III-B as printed: the stand as drawn, distances from planes, no joint "
                    "refinement");
  command->add_flag("--leave-out-loose-stops", arguments->leave_out,
                    "Go without stops that no image ties to the stop at 0 deg");
  command->add_flag("--fixed-noise", arguments->fixed_noise,
                    "Believe the deviations given; else they are estimated from the residuals");
  command
      ->add_option("--corner-sigma", arguments->corner_px,
                   "Standard deviation of a corner an axis, px")
      ->capture_default_str();
  command
      ->add_option("--range-sigma", arguments->range_mm,
                   "Standard deviation of a range, mm; 0 = from the scatter at the stops")
      ->capture_default_str();
  command->callback([&invocation, arguments, stage] {
    invocation = [arguments, stage](const RunContext& context) {
      return Calibrate(*arguments, stage, context);
    };
  });
}

}  // namespace

void AddCalibrateChainCommands(CLI::App& calibrate, Invocation& invocation) {
  AddStage(calibrate, invocation, "motor", "Axis and angles of the motor, Eq. (4)-(5)",
           CalibrationStage::kMotor);
  AddStage(calibrate, invocation, "lidar", "The same, then the lidar's pose, Eq. (6)",
           CalibrationStage::kLidar);
  AddStage(calibrate, invocation, "time",
           "The same, then the offset of the lidar's stamps from a sweep up and down",
           CalibrationStage::kTime);
  AddStage(calibrate, invocation, "all",
           "The whole chain, then all of it in one least-squares problem, with its covariance",
           CalibrationStage::kAll);
}

}  // namespace foresight
