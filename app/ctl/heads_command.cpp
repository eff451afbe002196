#include <chrono>
#include <memory>
#include <thread>

#include "app/ctl/command.h"
#include "hardware/link/discovery/head_browser.h"

namespace foresight {
namespace {

struct HeadsArguments {
  double seconds = 2.0;
  bool json = false;
};

nlohmann::ordered_json ToJson(const AnnouncedHead& head) {
  return {{"name", head.name}, {"address", head.address}, {"simulated", head.simulated}};
}

Result<ExitCode> Run(const HeadsArguments& arguments, const RunContext& context) {
  const HeadBrowser browser;
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(arguments.seconds);
  while (!context.Cancelled() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const std::vector<AnnouncedHead> heads = browser.Heads();
  if (const std::string trouble = browser.Trouble(); !trouble.empty())
    return Fail(ErrorCode::kDevice,
                "{}; install and start avahi-daemon, or give the address with --head", trouble);
  if (arguments.json) {
    auto list = nlohmann::ordered_json::array();
    for (const AnnouncedHead& head : heads) list.push_back(ToJson(head));
    PrintJson(list);
  } else {
    for (const AnnouncedHead& head : heads)
      PrintLine(
          fmt::format("{}  {}{}", head.name, head.address, head.simulated ? "  simulated" : ""));
  }
  if (heads.empty()) PrintNote("no head told the local network in {:g} s", arguments.seconds);
  return heads.empty() ? ExitCode::kNegative : ExitCode::kDone;
}

}  // namespace

void AddHeadsCommand(CLI::App& app, Invocation& invocation) {
  auto* command = app.add_subcommand("heads", "List the heads that the local network tells of");
  const auto arguments = std::make_shared<HeadsArguments>();
  command->add_option("--seconds", arguments->seconds, "How long to listen")
      ->check(CLI::Range(0.1, 60.0))
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print the list as JSON");
  command->callback([arguments, &invocation] {
    invocation = [arguments](const RunContext& context) { return Run(*arguments, context); };
  });
}

}  // namespace foresight
