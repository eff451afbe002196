#include <memory>

#include "app/ctl/command.h"
#include "app/ctl/late/late_command.h"
#include "core/base/log_file.h"
#include "core/exchange/support_bundle.h"

namespace foresight {

namespace {

struct BundleArguments {
  std::string out;
  std::string mission;
  std::vector<std::string> texts;
  bool json = false;
};

Result<ExitCode> WriteBundle(const BundleArguments& arguments, const RunContext& context) {
  SupportBundleSources sources;
  if (!arguments.mission.empty()) sources.mission = arguments.mission;
  if (const auto log = LogFileOf("workstation"); !log.empty()) sources.texts.push_back(log);
  sources.texts.insert(sources.texts.end(), arguments.texts.begin(), arguments.texts.end());
  FORESIGHT_TRY(const SupportBundleReport report,
                WriteSupportBundle(arguments.out, sources, context));
  for (const std::string& sentence : report.left_out) PrintNote("left out: {}", sentence);
  if (arguments.json)
    PrintJson({{"out", arguments.out}, {"files", report.files}, {"left_out", report.left_out}});
  else
    PrintLine(fmt::format("{}: {} files", arguments.out, report.files.size()));
  return ExitCode::kDone;
}

}  // namespace

extern "C" void AddBundleOptions(CLI::App* command, Invocation* invocation) {
  const auto arguments = std::make_shared<BundleArguments>();
  command->add_option("-o,--out", arguments->out, "ZIP archive to write")->required();
  command->add_option("--mission", arguments->mission,
                      "Mission file: its last scan, its rig, its tables and its log");
  command->add_option("texts", arguments->texts,
                      "Other texts: configurations of a head, logs (journalctl -u foresight-head)");
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([invocation, arguments] {
    *invocation = [arguments](const RunContext& context) {
      return WriteBundle(*arguments, context);
    };
  });
}

}  // namespace foresight
