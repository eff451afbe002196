#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "app/common/exit_code.h"
#include "app/common/output.h"
#include "core/base/run_context.h"
#include "core/geometry/rigid.h"
#include "core/io/json_numbers.h"

namespace foresight {

/// The one subcommand that the command line chose, ready to run.
using Invocation = std::function<Result<ExitCode>(const RunContext&)>;

/// Adds a subcommand and its options to `app`; when it is chosen, parsing fills `invocation`.
void AddScanCommand(CLI::App& app, Invocation& invocation);
void AddCheckCommand(CLI::App& app, Invocation& invocation);
void AddCloudCommand(CLI::App& app, Invocation& invocation);
void AddDepthCommand(CLI::App& app, Invocation& invocation);
void AddFitCommand(CLI::App& app, Invocation& invocation);
void AddEvaluateCommand(CLI::App& app, Invocation& invocation);
void AddEvaluateFitsCommand(CLI::App& app, Invocation& invocation);
void AddEvaluateBoardsCommand(CLI::App& app, Invocation& invocation);
void AddEvaluateConfidenceCommand(CLI::App& app, Invocation& invocation);
void AddEvaluateOutlinesCommand(CLI::App& app, Invocation& invocation);
void AddEvaluateCheckCommand(CLI::App& app, Invocation& invocation);
void AddVerdictCommand(CLI::App& app, Invocation& invocation);
void AddUpsampleCommand(CLI::App& app, Invocation& invocation);
void AddRenderCommand(CLI::App& app, Invocation& invocation);
void AddDemoCommand(CLI::App& app, Invocation& invocation);
void AddEmulateCommand(CLI::App& app, Invocation& invocation);
void AddHealthCommand(CLI::App& app, Invocation& invocation);
void AddFetchCommand(CLI::App& app, Invocation& invocation);
void AddImageCommand(CLI::App& app, Invocation& invocation);
void AddStopCommand(CLI::App& app, Invocation& invocation);
void AddHeadsCommand(CLI::App& app, Invocation& invocation);
void AddBundleCommand(CLI::App& app, Invocation& invocation);
void AddMapCommand(CLI::App& app, Invocation& invocation);
void AddMissionCommand(CLI::App& app, Invocation& invocation);
/// `mission` is the command of that name.
void AddMissionDigestCommand(CLI::App& mission, Invocation& invocation);
void AddMissionPoseCommand(CLI::App& mission, Invocation& invocation);
void AddMissionDecideCommand(CLI::App& mission, Invocation& invocation);
void AddMissionNoteCommand(CLI::App& mission, Invocation& invocation);
void AddMissionShowCommand(CLI::App& mission, Invocation& invocation);
void AddMissionRecoverCommand(CLI::App& mission, Invocation& invocation);
void AddMissionMergeCommand(CLI::App& mission, Invocation& invocation);
void AddMissionPruneCommand(CLI::App& mission, Invocation& invocation);
void AddMissionDiffCommand(CLI::App& mission, Invocation& invocation);
void AddMissionImportCommand(CLI::App& mission, Invocation& invocation);
void AddMissionExportCommand(CLI::App& mission, Invocation& invocation);
void AddMissionRunCommand(CLI::App& mission, Invocation& invocation);
void AddRigCommand(CLI::App& app, Invocation& invocation);
void AddPkiCommand(CLI::App& app, Invocation& invocation);
void AddCalibrateCommand(CLI::App& app, Invocation& invocation);
void AddTargetCommand(CLI::App& app, Invocation& invocation);
void AddSimulateCommand(CLI::App& app, Invocation& invocation);
/// `calibrate` is the command of that name.
void AddCalibrateChainCommands(CLI::App& calibrate, Invocation& invocation);
void AddCalibrateCheckCommand(CLI::App& calibrate, Invocation& invocation);
void AddCalibrateRobotCommand(CLI::App& calibrate, Invocation& invocation);
void AddCalibrateRecordCommand(CLI::App& calibrate, Invocation& invocation);

/// For `map_error`: says which file a value in an error is of.
inline auto Of(const std::string& file) {
  return [file](Error error) {
    if (error.code != ErrorCode::kCancelled) error.message = file + ": " + error.message;
    return error;
  };
}

/// Creates the folder for results. Fails with kIo.
Status MakeOutputFolder(const std::string& folder);

template <class To, class From>
nlohmann::ordered_json ToJson(const Rigid<To, From>& transform) {
  const Eigen::Quaterniond& q = transform.rotation();
  const Eigen::Vector3d& t = transform.translation();
  return {{"quaternion_wxyz", {q.w(), q.x(), q.y(), q.z()}},
          {"translation_m", {t.x(), t.y(), t.z()}}};
}

/// An option whose default is shown.
template <class T>
CLI::Option* AddOption(CLI::App& command, const char* names, T& value, const char* help) {
  return command.add_option(names, value, help)->capture_default_str();
}

}  // namespace foresight
