#include <memory>

#include "app/common/connect_head.h"
#include "app/ctl/command.h"

namespace foresight {
namespace {

struct StopArguments {
  LinkArguments link;
  bool json = false;
};

Result<ExitCode> Run(const StopArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const HeadStatus status, StopHeadAt(arguments.link, context));
  if (arguments.json)
    PrintJson({{"head", arguments.link.head},
               {"stopped", true},
               {"state", ToString(status.state)},
               {"message", status.message}});
  else
    PrintLine(fmt::format("{}: stopped; the head is {}{}{}", arguments.link.head,
                          ToString(status.state), status.message.empty() ? "" : ": ",
                          status.message));
  return ExitCode::kDone;
}

}  // namespace

void AddStopCommand(CLI::App& app, Invocation& invocation) {
  auto* command = app.add_subcommand(
      "stop", "Stop the motor of a head at the far end of a link at once, whoever has control");
  const auto arguments = std::make_shared<StopArguments>();
  AddLinkOptions(*command, arguments->link)->required();
  command->add_flag("--json", arguments->json, "Print how the head is then as JSON");
  command->callback([arguments, &invocation] {
    invocation = [arguments](const RunContext& context) { return Run(*arguments, context); };
  });
}

}  // namespace foresight
