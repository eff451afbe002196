#include <memory>

#include "app/common/seed_option.h"
#include "app/ctl/command.h"
#include "core/evaluation/board_search_trial.h"

namespace foresight {
namespace {

struct EvaluateBoardsArguments {
  std::string session;
  std::string scene;
  std::string rig;
  std::uint64_t world_seed = 1;
  BoardSearchTrialOptions trial;
  bool json = false;
};

/// What became of the boards of all images.
struct BoardTally {
  int whole = 0, right = 0, wrong = 0;
  int missed = 0;  ///< whole and not found
};

BoardTally TallyOf(const BoardSearchTrial& trial) {
  BoardTally tally;
  for (const BoardSearchOutcome& board : trial.boards) {
    tally.whole += board.whole ? 1 : 0;
    tally.right += board.Right() ? 1 : 0;
    tally.wrong += board.Wrong() ? 1 : 0;
    tally.missed += board.whole && !board.found ? 1 : 0;
  }
  return tally;
}

void Print(const EvaluateBoardsArguments& arguments, const BoardSearchTrial& trial) {
  for (const BoardSearchOutcome& board : trial.boards)
    if (board.Wrong())
      PrintLine(fmt::format("{}: board {} is wrong, a corner is {:.1f} px off", board.image,
                            board.board, board.worst_px));
  const BoardTally tally = TallyOf(trial);
  PrintLine(fmt::format(
      "{}: {} boards right, {} wrong; {} whole in the image, {} of them not "
      "found; {:.1f} s",
      arguments.session, tally.right, tally.wrong, tally.whole, tally.missed, trial.search_s));
}

void PrintAsJson(const BoardSearchTrial& trial) {
  const BoardTally tally = TallyOf(trial);
  nlohmann::ordered_json json = {
      {"right", tally.right},      {"wrong", tally.wrong},
      {"whole", tally.whole},      {"missed", tally.missed},
      {"seconds", trial.search_s}, {"boards", nlohmann::ordered_json::array()}};
  for (const BoardSearchOutcome& board : trial.boards)
    json["boards"].push_back({{"image", board.image},
                              {"board", std::string(1, board.board)},
                              {"whole", board.whole},
                              {"found", board.found},
                              {"worst_px", FiniteOrNull(board.worst_px)}});
  PrintJson(json);
}

Result<ExitCode> EvaluateBoards(const EvaluateBoardsArguments& arguments,
                                const RunContext& context) {
  FORESIGHT_TRY(Scene scene, LoadScene(arguments.scene));
  FORESIGHT_TRY(const SensorRig rig, LoadSensorRig(arguments.rig));
  WorldOptions options;
  options.seed = arguments.world_seed;
  const World world(std::make_shared<const Scene>(std::move(scene)), rig, options);
  FORESIGHT_TRY(const BoardSearchTrial trial,
                RunBoardSearchTrial(arguments.session, world, arguments.trial, context));
  if (arguments.json)
    PrintAsJson(trial);
  else
    Print(arguments, trial);
  return TallyOf(trial).wrong == 0 ? ExitCode::kDone : ExitCode::kNegative;
}

}  // namespace

void AddEvaluateBoardsCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<EvaluateBoardsArguments>();
  CLI::App* command = app.add_subcommand("evaluate-boards",
                                         "Look for the boards of a stand in a session of a "
                                         "simulated head, and compare with the truth");
  command->add_option("session", arguments->session, "The session's folder")->required();
  command->add_option("--scene", arguments->scene, "The scene that it was recorded in (YAML)")
      ->required();
  command->add_option("--rig", arguments->rig, "The true head (YAML)")->required();
  AddSeedOption(*command, "--seed", arguments->world_seed, "That it was recorded with")
      ->capture_default_str();
  command->add_flag("--cover", arguments->trial.cover,
                    "Cover half of the boards in part, before they are looked for");
  AddSeedOption(*command, "--cover-seed", arguments->trial.cover_seed, "Of the covers")
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print JSON, with one object a board and image");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) {
      return EvaluateBoards(*arguments, context);
    };
  });
}

}  // namespace foresight
