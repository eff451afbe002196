#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>

#include "app/common/seed_option.h"
#include "app/ctl/command.h"
#include "core/base/atomic_file.h"
#include "core/base/quantile.h"
#include "core/evaluation/check_trial.h"
#include "core/geometry/angles.h"
#include "core/pictures/line_chart.h"
#include "core/selfcheck/gather_rig.h"

namespace foresight {
namespace {

struct EvaluateCheckArguments {
  std::vector<std::string> scenes;
  std::uint64_t first_seed = 1;
  int count = 30;
  double turn_deg = 0.3;
  double stamp_ms = 10.0;
  double scale_percent = 1.0;
  double calibration_deg = DegreesFromRadians(CheckTrialOptions().calibration_error.rotation_rad);
  double calibration_mm = 1000.0 * CheckTrialOptions().calibration_error.translation_m;
  int gather = 1;      ///< so many scans share a rig
  bool depth = false;  ///< check the depth too
  bool rig = true;     ///< try the damages
  bool json = false;
  std::string world = "home";
  std::string chart;
};

nlohmann::ordered_json ToJson(const CheckOutcome& outcome) {
  nlohmann::ordered_json json = {{"seed", outcome.seed},
                                 {"scene", outcome.scene},
                                 {"damage", outcome.damage},
                                 {"sign", outcome.sign},
                                 {"seconds", outcome.seconds},
                                 {"drifted", outcome.check.drifted},
                                 {"cannot_see", outcome.check.cannot_see}};
  for (const RigFinding& finding : outcome.check.findings)
    json["findings"].push_back({{"name", finding.name},
                                {"value", FiniteOrNull(finding.value)},
                                {"sigma", FiniteOrNull(finding.sigma)},
                                {"state", ToString(finding.state)}});
  if (outcome.check.camera) {
    const CameraCheck& c = *outcome.check.camera;
    json["camera"] = {{"edges", c.edges},
                      {"score", c.score},
                      {"before", c.score_before},
                      {"aside", c.score_aside},
                      {"gain", c.gain_sigmas}};
  }
  if (outcome.check.turns)
    json["turns"] = {{"images", outcome.check.turns->images},
                     {"points", outcome.check.turns->points},
                     {"explained", outcome.check.turns->explained}};
  if (outcome.check.passes) json["passes"] = {{"patches", outcome.check.passes->patches}};
  if (outcome.check.plate)
    json["plate"] = {{"planes", outcome.check.plate->planes},
                     {"cells", outcome.check.plate->cells},
                     {"residual_mm", 1000.0 * outcome.check.plate->residual_m},
                     {"shift_y", outcome.check.plate->drift[PlateCheck::kShiftY]},
                     {"shift_z", outcome.check.plate->drift[PlateCheck::kShiftZ]},
                     {"range", outcome.check.plate->drift[PlateCheck::kRange]}};
  return json;
}

/// The findings that show a damage; none for none. The lidar's x looks ahead as the head's z does,
/// its z is the head's -y, and its y lies along the motor's axis.
std::vector<std::string> FindingsOf(const std::string& damage) {
  if (damage == "none") return {};
  if (damage == "lidar turn x") return {"lidar turn z"};
  if (damage == "lidar turn y") return {"camera turn x"};
  if (damage == "lidar turn z") return {"lidar turn y"};
  if (damage == "camera turn y") return {damage, "camera on plate y"};
  if (damage == "camera turn z") return {damage, "camera on plate z"};
  if (damage == "motor harmonic") return {"motor scale", "motor bend"};
  return {damage};
}

/// What became of all checks of one damage.
struct CheckTally {
  int scans = 0;
  int alarms = 0;    ///< anything drifted
  int named = 0;     ///< among it the direction that was damaged
  int not_seen = 0;  ///< the scan does not show that direction
  double seconds = 0.0;
};

CheckTally TallyOf(const std::vector<CheckOutcome>& outcomes, const std::string& damage) {
  CheckTally tally;
  for (const CheckOutcome& outcome : outcomes) {
    if (outcome.damage != damage) continue;
    ++tally.scans;
    tally.alarms += outcome.check.Drifted() ? 1 : 0;
    tally.seconds += outcome.seconds;
    const std::vector<std::string> names = FindingsOf(damage);
    const auto any = [&](RigFinding::State state) {
      return std::any_of(outcome.check.findings.begin(), outcome.check.findings.end(),
                         [&](const RigFinding& finding) {
                           return finding.state == state && std::find(names.begin(), names.end(),
                                                                      finding.name) != names.end();
                         });
    };
    const bool named = any(RigFinding::State::kDrifted);
    tally.named += named ? 1 : 0;
    tally.not_seen += !names.empty() && !named && !any(RigFinding::State::kFine) ? 1 : 0;
  }
  return tally;
}

void Print(const std::vector<CheckOutcome>& outcomes, const std::vector<RigDamage>& damages) {
  PrintLine(fmt::format("{:<18}{:>8}{:>8}{:>8}{:>10}{:>8}", "damage", "scans", "alarms", "named",
                        "not seen", "s each"));
  for (const RigDamage& damage : damages) {
    const CheckTally t = TallyOf(outcomes, damage.name);
    PrintLine(fmt::format("{:<18}{:>8}{:>8}{:>8}{:>10}{:>8.1f}", damage.name, t.scans, t.alarms,
                          t.named, t.not_seen, t.seconds / std::max(1, t.scans)));
  }
}

/// The smallest drift that is called amber, of each direction, with rigs that are good: the limit,
/// or so many deviations where that is more.
void PrintSmallest(const std::vector<CheckOutcome>& outcomes) {
  std::map<std::string, std::vector<double>> smallest;
  std::map<std::string, int> seen;
  int scans = 0;
  for (const CheckOutcome& outcome : outcomes) {
    if (outcome.damage != "none") continue;
    ++scans;
    for (const RigFinding& finding : outcome.check.findings) {
      const double in_unit = finding.unit == "rad" ? DegreesFromRadians(1.0)
                             : finding.unit == "1" ? 100.0
                                                   : 1e3;
      const double least = std::max(finding.limit, RigCheckLimits().sigmas * finding.sigma);
      if (std::isfinite(finding.sigma) && std::isfinite(least))
        smallest[finding.name].push_back(in_unit * least);
      seen[finding.name] += finding.state != RigFinding::State::kNotSeen ? 1 : 0;
    }
  }
  PrintLine(fmt::format("{:<18}{:>8}{:>8}{:>24}{:>12}", "smallest drift", "scans", "seen",
                        "amber from, deg, ms, %", "90 % below"));
  for (const auto& [name, values] : smallest)
    PrintLine(fmt::format("{:<18}{:>8}{:>8}{:>24.2f}{:>12.2f}", name, scans, seen[name],
                          Quantile(values, 0.5), Quantile(values, 0.9)));
}

double Ratio(double measured, double truth) {
  return truth > 0.0 ? measured / truth : std::nan("");
}

nlohmann::ordered_json ToJson(const DepthCheckOutcome& outcome) {
  const DepthCheck& c = outcome.check;
  nlohmann::ordered_json classes = nlohmann::ordered_json::array();
  for (const ConfidenceTruth& one : outcome.confidence)
    classes.push_back(
        {{"pixels", one.pixels}, {"promised_sum", one.promised}, {"right", one.right}});
  return {{"seed", outcome.seed},
          {"scene", outcome.scene},
          {"state", ToString(c.state)},
          {"seconds", c.seconds},
          {"kept", c.kept},
          {"beams", c.all.beams},
          {"against_beams_m", {c.all.q50_m, c.all.q80_m, c.all.q95_m}},
          {"scattered_m", {c.scattered.q50_m, c.scattered.q80_m, c.scattered.q95_m}},
          {"lines_m", {c.lines.q50_m, c.lines.q80_m, c.lines.q95_m}},
          {"map_m", {c.map_q50_m, c.map_q80_m, c.map_q95_m}},
          {"true_m", {outcome.true_q50_m, outcome.true_q80_m, outcome.true_q95_m}},
          {"promised", c.promise.promised},
          {"right", c.promise.right},
          {"true_right", outcome.true_right},
          {"confidence", classes}};
}

/// How near the check's quantiles come to the true ones: the median of the ratios, and how many are
/// within 15 %.
void Print(const std::vector<DepthCheckOutcome>& outcomes) {
  PrintLine(fmt::format("{:<10}{:>8}{:>22}{:>22}{:>14}", "depth", "scans", "check / truth, median",
                        "25 to 75 %", "within 15 %"));
  const auto row = [&](const char* name, const auto& measured, const auto& truth) {
    std::vector<double> ratios;
    for (const DepthCheckOutcome& outcome : outcomes)
      ratios.push_back(Ratio(measured(outcome), truth(outcome)));
    const auto near = std::count_if(ratios.begin(), ratios.end(),
                                    [](double ratio) { return std::abs(ratio - 1.0) <= 0.15; });
    PrintLine(fmt::format(
        "{:<10}{:>8}{:>22.2f}{:>22}{:>14}", name, ratios.size(), Quantile(ratios, 0.5),
        fmt::format("{:.2f} to {:.2f}", Quantile(ratios, 0.25), Quantile(ratios, 0.75)), near));
  };
  row(
      "50 %", [](const auto& o) { return o.check.map_q50_m; },
      [](const auto& o) { return o.true_q50_m; });
  row(
      "80 %", [](const auto& o) { return o.check.map_q80_m; },
      [](const auto& o) { return o.true_q80_m; });
  row(
      "95 %", [](const auto& o) { return o.check.map_q95_m; },
      [](const auto& o) { return o.true_q95_m; });
  row(
      "right", [](const auto& o) { return o.check.promise.right; },
      [](const auto& o) { return o.true_right; });
}

/// Of the pixels of one class of confidence, over all scans.
struct ClassReliability {
  double from = 0.0;  ///< the class reaches 0.1 further
  std::int64_t pixels = 0;
  double promised = 0.0;       ///< mean confidence
  double right = 0.0;          ///< fraction
  std::size_t scans = 0;       ///< with enough pixels in the class
  double right_of_scan = 0.0;  ///< median of those; pixels of one scan are right or wrong together
};

/// Whether 0.9 means 0.9: what the map promised and what was right. Classes without a pixel are
/// left out.
std::vector<ClassReliability> ReliabilityOf(const std::vector<DepthCheckOutcome>& outcomes) {
  constexpr std::int64_t kLeastPixels = 200;  // of a scan in a class
  std::vector<ClassReliability> classes;
  for (std::size_t i = 0; i < ConfidenceTruth::kClasses; ++i) {
    ConfidenceTruth all;
    std::vector<double> of_scans;
    for (const DepthCheckOutcome& outcome : outcomes) {
      const ConfidenceTruth& one = outcome.confidence[i];
      all.pixels += one.pixels;
      all.promised += one.promised;
      all.right += one.right;
      if (one.pixels >= kLeastPixels)
        of_scans.push_back(static_cast<double>(one.right) / static_cast<double>(one.pixels));
    }
    if (all.pixels == 0) continue;
    const auto pixels = static_cast<double>(all.pixels);
    classes.push_back({.from = static_cast<double>(i) / ConfidenceTruth::kClasses,
                       .pixels = all.pixels,
                       .promised = all.promised / pixels,
                       .right = static_cast<double>(all.right) / pixels,
                       .scans = of_scans.size(),
                       .right_of_scan = Quantile(of_scans, 0.5)});
  }
  return classes;
}

void Print(const std::vector<ClassReliability>& classes) {
  PrintLine(fmt::format("{:<14}{:>12}{:>10}{:>8}{:>8}{:>26}", "confidence", "pixels", "promised",
                        "right", "scans", "right of a scan, median"));
  for (const ClassReliability& it : classes)
    PrintLine(fmt::format("{:<14}{:>12}{:>10.3f}{:>8.3f}{:>8}{:>26.3f}",
                          fmt::format("{:.1f} to {:.1f}", it.from, it.from + 0.1), it.pixels,
                          it.promised, it.right, it.scans, it.right_of_scan));
}

/// The reliability plot: on the diagonal a confidence means what it says, above it is too modest.
LineChart ChartOf(const std::vector<ClassReliability>& classes, const std::string& title) {
  ChartSeries all{"of all pixels", {}}, median{"of a scan's pixels, median", {}};
  for (const ClassReliability& it : classes) {
    all.points.emplace_back(it.promised, it.right);
    median.points.emplace_back(it.promised, it.right_of_scan);
  }
  return {.title = title,
          .x = {.title = "confidence", .unit = "", .from_zero = true},
          .y = {.title = "fraction that is right", .unit = "", .from_zero = true},
          .series = {{"if 0.9 means 0.9", {{0.0, 0.0}, {1.0, 1.0}}}, all, median}};
}

/// Checks of the same damage that share a rig, as one.
std::vector<CheckOutcome> Gathered(const std::vector<CheckOutcome>& outcomes,
                                   const std::vector<RigDamage>& damages) {
  std::vector<CheckOutcome> gathered;
  for (const RigDamage& damage : damages) {
    std::vector<RigCheck> checks;
    CheckOutcome sum;
    for (const CheckOutcome& outcome : outcomes) {
      if (outcome.damage != damage.name) continue;
      if (checks.empty()) sum = outcome;
      checks.push_back(outcome.check);
      if (checks.size() > 1) sum.seconds += outcome.seconds;
    }
    if (checks.empty()) continue;
    sum.check = GatherRig(checks, DefaultSensorRig(), RigCheckLimits());
    gathered.push_back(std::move(sum));
  }
  return gathered;
}

Result<ExitCode> EvaluateCheck(const EvaluateCheckArguments& arguments, const RunContext& context) {
  if (!arguments.chart.empty()) {
    // Told before minutes of work, not after.
    FORESIGHT_CHECK(
        MakeOutputFolder(std::filesystem::absolute(arguments.chart).parent_path().string()));
    FORESIGHT_CHECK(ResolveOutput(arguments.chart));
  }
  // Three of the scans in turn are of random scenes: a valve, a drill, a terrain.
  std::vector<std::shared_ptr<const Scene>> scenes = {nullptr, nullptr, nullptr};
  for (const std::string& file : arguments.scenes) {
    FORESIGHT_TRY(Scene scene, LoadScene(file));
    scenes.push_back(std::make_shared<const Scene>(std::move(scene)));
  }
  FORESIGHT_TRY(const FitWorld world, FitWorldFromString(arguments.world));
  const auto damages = UsualDamages(RadiansFromDegrees(arguments.turn_deg),
                                    1e-3 * arguments.stamp_ms, 1e-2 * arguments.scale_percent);
  std::vector<CheckOutcome> all;
  std::vector<DepthCheckOutcome> depths;
  for (int first = 0; first < arguments.count; first += arguments.gather) {
    CheckTrialOptions options;
    options.calibration_error = {RadiansFromDegrees(arguments.calibration_deg),
                                 1e-3 * arguments.calibration_mm};
    options.world = world;
    options.rig_seed = arguments.first_seed + static_cast<std::uint64_t>(first);
    std::vector<CheckOutcome> of_rig;
    for (int i = first; i < std::min(first + arguments.gather, arguments.count); ++i) {
      const std::uint64_t seed = arguments.first_seed + static_cast<std::uint64_t>(i);
      FORESIGHT_TRY(const CheckTrial trial,
                    MakeCheckTrial(scenes[seed % scenes.size()], seed, options, context));
      if (arguments.rig) {
        FORESIGHT_TRY(auto outcomes, CheckDamages(trial, damages, options, context));
        for (CheckOutcome& outcome : outcomes) of_rig.push_back(std::move(outcome));
      }
      if (arguments.depth) {
        FORESIGHT_TRY(DepthCheckOutcome outcome,
                      CheckDepthOfTrial(trial, DefaultsOf(DepthMethod::kForesight),
                                        DepthCheckOptions(), context));
        depths.push_back(std::move(outcome));
      }
      PrintProgress(fmt::format("scan {} of {}", i + 1, arguments.count),
                    i + 1 == arguments.count ? ProgressEnd::kLast : ProgressEnd::kMore);
    }
    for (CheckOutcome& outcome : arguments.gather > 1 ? Gathered(of_rig, damages) : of_rig)
      all.push_back(std::move(outcome));
  }
  const std::vector<ClassReliability> reliability = ReliabilityOf(depths);
  if (arguments.json) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const CheckOutcome& outcome : all) json.push_back(ToJson(outcome));
    for (const DepthCheckOutcome& outcome : depths) json.push_back(ToJson(outcome));
    PrintJson(json);
  } else {
    if (arguments.rig) {
      Print(all, damages);
      PrintSmallest(all);
    }
    if (arguments.depth) {
      Print(depths);
      Print(reliability);
    }
  }
  // Last: a disk that is full by now takes no numbers along.
  if (!arguments.chart.empty())
    FORESIGHT_CHECK(WriteFileAtomically(
        arguments.chart,
        SvgOf(ChartOf(reliability, fmt::format("Confidence of the depth, {} scans of world {}",
                                               depths.size(), arguments.world)))));
  return ExitCode::kDone;
}

}  // namespace

void AddEvaluateCheckCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<EvaluateCheckArguments>();
  CLI::App* command = app.add_subcommand(
      "evaluate-check",
      "Try the checks of scans on simulated ones: rigs that drifted, and depth with its truth");
  command->add_option("--scenes", arguments->scenes, "Scene files beside the random scenes")
      ->delimiter(',');
  command
      ->add_option("--world", arguments->world,
                   "Where random scenes and their noise come from: home, varied, or other, which "
                   "judges only")
      ->check(CLI::IsMember({"home", "varied", "other"}))
      ->capture_default_str();
  AddSeedOption(*command, "--first-seed", arguments->first_seed, "Seed of the first scan")
      ->capture_default_str();
  command->add_option("--count", arguments->count, "Number of scans")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--turn", arguments->turn_deg, "Of camera and lidar, deg")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--stamps", arguments->stamp_ms, "Offset of the stamps, ms")
      ->check(CLI::Range(-100.0, 100.0))
      ->capture_default_str();
  command
      ->add_option("--scale", arguments->scale_percent,
                   "How much too far the plate turns, % of its turn")
      ->check(CLI::Range(-10.0, 10.0))
      ->capture_default_str();
  command
      ->add_option("--calibration-deg", arguments->calibration_deg,
                   "What a calibration leaves of each rig")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--calibration-mm", arguments->calibration_mm, "The same of its shift")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command
      ->add_option("--gather", arguments->gather,
                   "So many scans in a row share a rig and are judged together")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  CLI::Option* depth = command->add_flag("--depth,!--no-depth", arguments->depth,
                                         "Compare the check of the depth with the truth, too");
  command
      ->add_option("--chart", arguments->chart,
                   "Draw how often a depth of each confidence is right into this SVG file")
      ->needs(depth);
  command->add_flag("--rig,!--no-rig", arguments->rig, "Try the damages of the rig");
  command->add_flag("--json", arguments->json,
                    "Print a JSON list, one object a check, with all that was measured");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) {
      return EvaluateCheck(*arguments, context);
    };
  });
}

}  // namespace foresight
