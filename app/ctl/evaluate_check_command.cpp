#include <memory>

#include "app/common/seed_option.h"
#include "app/ctl/command.h"
#include "core/evaluation/check_trial.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

struct EvaluateCheckArguments {
  std::vector<std::string> scenes;
  std::uint64_t first_seed = 1;
  int count = 30;
  double turn_deg = 0.3;
  double stamp_ms = 10.0;
  bool json = false;
};

nlohmann::ordered_json ToJson(const CheckOutcome& outcome) {
  nlohmann::ordered_json json = {{"seed", outcome.seed},       {"scene", outcome.scene},
                                 {"damage", outcome.damage},   {"sign", outcome.sign},
                                 {"seconds", outcome.seconds}, {"drifted", outcome.check.drifted}};
  for (const RigFinding& finding : outcome.check.findings)
    json["findings"].push_back({{"name", finding.name},
                                {"value", Finite(finding.value)},
                                {"sigma", Finite(finding.sigma)},
                                {"state", ToString(finding.state)}});
  if (outcome.check.camera) {
    const CameraCheck& c = *outcome.check.camera;
    json["camera"] = {{"edges", c.edges},
                      {"score", c.score},
                      {"before", c.score_before},
                      {"aside", c.score_aside},
                      {"gain", c.gain_sigmas}};
  }
  if (outcome.check.plate)
    json["plate"] = {{"planes", outcome.check.plate->planes},
                     {"cells", outcome.check.plate->cells},
                     {"residual_mm", 1000.0 * outcome.check.plate->residual_m},
                     {"shift_y", outcome.check.plate->drift[PlateCheck::kShiftY]},
                     {"shift_z", outcome.check.plate->drift[PlateCheck::kShiftZ]},
                     {"range", outcome.check.plate->drift[PlateCheck::kRange]}};
  return json;
}

/// The finding that shows a damage best; empty for none. The lidar's x looks ahead as the head's z
/// does, its z is the head's -y, and its y lies along the motor's axis.
std::string BestFinding(const std::string& damage) {
  if (damage == "lidar turn x") return "lidar turn z";
  if (damage == "lidar turn y") return "camera turn x";
  if (damage == "lidar turn z") return "lidar turn y";
  return damage == "none" ? "" : damage;
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
    for (const RigFinding& finding : outcome.check.findings) {
      if (finding.name != BestFinding(damage)) continue;
      tally.named += finding.state == RigFinding::State::kDrifted ? 1 : 0;
      tally.not_seen += finding.state == RigFinding::State::kNotSeen ? 1 : 0;
    }
  }
  return tally;
}

void Print(const std::vector<CheckOutcome>& outcomes, const std::vector<RigDamage>& damages) {
  PrintLine(fmt::format("{:<16}{:>8}{:>8}{:>8}{:>10}{:>8}", "damage", "scans", "alarms", "named",
                        "not seen", "s each"));
  for (const RigDamage& damage : damages) {
    const CheckTally t = TallyOf(outcomes, damage.name);
    PrintLine(fmt::format("{:<16}{:>8}{:>8}{:>8}{:>10}{:>8.1f}", damage.name, t.scans, t.alarms,
                          t.named, t.not_seen, t.seconds / std::max(1, t.scans)));
  }
}

Result<ExitCode> EvaluateCheck(const EvaluateCheckArguments& arguments, const RunContext& context) {
  // Three of the scans in turn are of random scenes: a valve, a drill, a terrain.
  std::vector<std::shared_ptr<const Scene>> scenes = {nullptr, nullptr, nullptr};
  for (const std::string& file : arguments.scenes) {
    FORESIGHT_TRY(Scene scene, LoadScene(file));
    scenes.push_back(std::make_shared<const Scene>(std::move(scene)));
  }
  const auto damages =
      UsualDamages(RadiansFromDegrees(arguments.turn_deg), 1e-3 * arguments.stamp_ms);
  std::vector<CheckOutcome> all;
  for (int i = 0; i < arguments.count; ++i) {
    const std::uint64_t seed = arguments.first_seed + static_cast<std::uint64_t>(i);
    FORESIGHT_TRY(auto outcomes, RunCheckTrial(scenes[seed % scenes.size()], seed, damages,
                                               CheckTrialOptions(), context));
    for (CheckOutcome& outcome : outcomes) all.push_back(std::move(outcome));
    PrintProgress(fmt::format("scan {} of {}", i + 1, arguments.count),
                  i + 1 == arguments.count ? ProgressEnd::kLast : ProgressEnd::kMore);
  }
  if (!arguments.json) {
    Print(all, damages);
    return ExitCode::kDone;
  }
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const CheckOutcome& outcome : all) json.push_back(ToJson(outcome));
  PrintJson(json);
  return ExitCode::kDone;
}

}  // namespace

void AddEvaluateCheckCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<EvaluateCheckArguments>();
  CLI::App* command = app.add_subcommand(
      "evaluate-check", "Try the check of a rig on simulated scans, with rigs that drifted");
  command->add_option("--scenes", arguments->scenes, "Scene files beside the random scenes")
      ->delimiter(',');
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
  command->add_flag("--json", arguments->json,
                    "Print a JSON list, one object a check, with all that was measured");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) {
      return EvaluateCheck(*arguments, context);
    };
  });
}

}  // namespace foresight
