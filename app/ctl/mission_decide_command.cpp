#include <algorithm>
#include <memory>

#include "app/ctl/choose_object.h"
#include "app/ctl/command.h"
#include "core/base/utc_text.h"
#include "core/detection/candidates.h"
#include "core/detection/detection_json.h"
#include "core/mission/mission_file.h"
#include "core/mission/new_records.h"

namespace foresight {
namespace {

using Action = DetectionEvent::Action;

struct DecideArguments {
  std::string file;
  std::string object;
  bool accept = false, reject = false, reopen = false, remove = false, restore = false;
  std::string name;
  int answer = 1;  ///< counted from 1
  std::string remark;
  bool json = false;
};

std::optional<Action> ActionOf(const DecideArguments& arguments) {
  if (arguments.accept) return Action::kAccepted;
  if (arguments.reject) return Action::kRejected;
  if (arguments.reopen) return Action::kReopened;
  if (arguments.remove) return Action::kDeleted;
  if (arguments.restore) return Action::kRestored;
  return arguments.name.empty() ? std::nullopt : std::optional(Action::kRenamed);
}

Result<ExitCode> Decide(const DecideArguments& arguments) {
  const std::optional<Action> action = ActionOf(arguments);
  if (!action)
    return Fail(ErrorCode::kInvalidOptions,
                "give one of --accept, --reject, --reopen, --name, --delete and --restore");
  FORESIGHT_TRY(const auto file, MissionFile::Open(arguments.file));
  FORESIGHT_TRY(const DetectionRecord before, ChooseObject(*file, arguments.object));
  FORESIGHT_TRY(const Detection detection, DetectionFromJson(before.json));
  const bool of_answer = *action == Action::kAccepted || *action == Action::kRejected;
  if (arguments.answer > 1 && !of_answer)
    return Fail(ErrorCode::kInvalidOptions, "--answer goes with --accept and --reject");
  if (*action == Action::kRenamed && !arguments.remark.empty())
    return Fail(ErrorCode::kInvalidOptions, "--remark does not go with --name");
  if (arguments.remark.starts_with("answer "))
    return Fail(ErrorCode::kInvalidOptions,
                "a remark does not begin with 'answer ': say which answer with --answer");
  if (arguments.answer > std::max(1, CandidateCount(detection)))
    return Fail(ErrorCode::kInvalidInput, "object {} has no answer {}; it has 1 to {}", before.id,
                arguments.answer, CandidateCount(detection));
  FORESIGHT_CHECK(file->AddDetectionEvent(
      before.id, {NowUtc_ns(), OperatorName(), *action,
                  *action == Action::kRenamed ? arguments.name
                  : arguments.answer > 1      ? fmt::format("answer {}", arguments.answer)
                                              : arguments.remark}));
  FORESIGHT_TRY(const DetectionRecord after, ChooseObject(*file, before.uuid));
  FORESIGHT_CHECK(file->Close());
  const int candidate = after.decided_candidate;
  const VerdictLevel level = CandidateLevel(detection, candidate);
  if (*action == Action::kAccepted && level == VerdictLevel::kUnsure)
    PrintNote("object {} is accepted although it is UNSURE: {}", after.id,
              candidate == 0 ? VerdictOf(detection).reason : CandidateText(detection, candidate));
  if (arguments.json)
    PrintJson({{"mission", arguments.file},
               {"object", after.id},
               {"uuid", after.uuid},
               {"kind", after.kind},
               {"answer", candidate + 1},
               {"verdict", ToString(level)},
               {"name", after.name},
               {"decision", ToString(after.decision)},
               {"deleted", after.deleted}});
  else
    PrintLine(fmt::format("{} {} is {}: {}", after.kind, after.id, ToString(*action), after.uuid));
  return ExitCode::kDone;
}

}  // namespace

void AddMissionDecideCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<DecideArguments>();
  CLI::App* command = mission.add_subcommand(
      "decide", "Accept or reject an object that was found, name it, delete it");
  command->add_option("file", arguments->file, "Mission file, or its review")->required();
  command->add_option("object", arguments->object, "The object, by its number or uuid")->required();
  CLI::Option_group* what = command->add_option_group("What is done, one of");
  what->add_flag("--accept", arguments->accept, "It may be acted on");
  what->add_flag("--reject", arguments->reject, "It is wrong, or not wanted");
  what->add_flag("--reopen", arguments->reopen, "Nothing is decided any more");
  what->add_option("--name", arguments->name, "What it is called from now on");
  what->add_flag("--delete", arguments->remove, "It is no longer shown; its row stays");
  what->add_flag("--restore", arguments->restore, "It is shown again");
  what->require_option(0, 1);
  CLI::Option* answer =
      command
          ->add_option("--answer", arguments->answer,
                       "Which answer it is about: 1 = the best one, 2 = the first "
                       "alternative, ...")
          ->check(CLI::Range(1, 1000))
          ->capture_default_str();
  command->add_option("--remark", arguments->remark, "Why, for the mission's log")
      ->excludes(answer);
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext&) { return Decide(*arguments); };
  });
}

}  // namespace foresight
