#include <memory>

#include "app/ctl/calibration_report.h"
#include "app/ctl/command.h"
#include "app/ctl/paper_comparison.h"
#include "core/base/atomic_file.h"
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
  bool compare_paper = false;
  bool leave_out = false;
  bool fixed_noise = false;
  double corner_px = ChainNoise().corner_px;
  double range_mm = 0.0;
};

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

/// What the same session gives with Section III-B as printed; where that fails, the reason.
struct PaperResult {
  std::vector<ComparedValue> values;
  std::string failure;
};

Result<PaperResult> RunPaper(const CalibrationSession& session, ChainCalibrationOptions options,
                             const ChainCalibration& ours, const RunContext& context) {
  options.as_in_the_paper = true;
  const auto paper = CalibrateChain(session, options, context);
  PaperResult result;
  if (paper)
    result.values = CompareWithPaper(ours, *paper);
  else if (paper.error().code == ErrorCode::kCancelled)
    return tl::unexpected(paper.error());
  else
    result.failure = "the paper's sequence gave no answer: " + paper.error().message;
  return result;
}

Status WriteReports(const ChainCalibration& found, const CalibrationSession& session,
                    const PaperResult& paper, const std::string& folder) {
  FORESIGHT_CHECK(MakeOutputFolder(folder));
  HtmlReport page = CalibrationReport(found, session.name);
  if (!paper.values.empty()) page.tables.insert(page.tables.begin() + 1, TableOf(paper.values));
  FORESIGHT_CHECK(WriteHtmlReport(page, folder));
  FORESIGHT_TRY(const std::string sheet, PdfOf(CalibrationSheet(found, session, paper.values)));
  return WriteFileAtomically(std::filesystem::path(folder) / "report.pdf", sheet);
}

void Print(const ChainCalibration& found, const PaperResult& paper, bool as_json) {
  if (as_json) {
    nlohmann::ordered_json json = CalibrationJson(found);
    if (!paper.values.empty()) json["beside_the_paper"] = ToJson(paper.values);
    PrintJson(json);
    return;
  }
  PrintLine(DescribeCalibration(found));
  if (!paper.values.empty()) PrintLine("\n" + Describe(paper.values));
}

Result<ExitCode> Calibrate(const ChainArguments& arguments, CalibrationStage stage,
                           const RunContext& context) {
  FORESIGHT_TRY(const ChainCalibrationOptions options, OptionsFrom(arguments, stage));
  FORESIGHT_TRY(const CalibrationSession session,
                ReadCalibrationSession(arguments.session, context.Part(0.0, 0.5)));
  FORESIGHT_TRY(
      ChainCalibration found,
      CalibrateChain(session, options, context.Part(0.5, 0.8)).map_error(Of(arguments.session)));
  for (const std::string& image : session.unusable_images)
    found.notes.push_back("not used: " + image);
  found.rig.name = session.name;
  found.rig.date_utc = UtcDateNow();
  found.rig.parent_id = RigId(session.prior);
  PaperResult paper;
  if (arguments.compare_paper) {
    FORESIGHT_TRY(paper, RunPaper(session, options, found, context.Part(0.8, 1.0)));
    if (!paper.failure.empty()) found.notes.push_back(paper.failure);
  }
  if (!arguments.out.empty()) FORESIGHT_CHECK(SaveSensorRig(found.rig, arguments.out));
  if (!arguments.report.empty())
    FORESIGHT_CHECK(WriteReports(found, session, paper, arguments.report));
  Print(found, paper, arguments.json);
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
                      "Write a page with tables and charts, and one sheet of it as PDF, into this "
                      "folder");
  command->add_flag("--json", arguments->json, "Print all values as JSON");
  command->add_option("--model", arguments->lenses,
                      "Models of the camera to choose from, of k, eucm, kb4, radtan; else the "
                      "prior's, where the session has images for it");
  CLI::Option* paper = command->add_flag(
      "--paper", arguments->paper,
      "Section III-B as printed: the stand as drawn, distances from planes, no joint refinement");
  command
      ->add_flag("--compare-paper", arguments->compare_paper,
                 "Also calibrate as printed, and set both side by side")
      ->excludes(paper);
  command->add_flag("--leave-out-loose-stops", arguments->leave_out,
                    "Go without stops that no image ties to the stop at 0 deg");
  command->add_flag("--fixed-noise", arguments->fixed_noise,
                    "Believe the deviations given; else they are estimated from the residuals");
  AddOption(*command, "--corner-sigma", arguments->corner_px,
            "Standard deviation of a corner an axis, px");
  AddOption(*command, "--range-sigma", arguments->range_mm,
            "Standard deviation of a range, mm; 0 = from the scatter at the stops");
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
