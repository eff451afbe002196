#include <memory>

#include "app/ctl/command.h"
#include "core/mission/mission_file.h"
#include "hardware/link/chunks/scan_digest.h"

namespace foresight {
namespace {

/// Places between lines where some are missing.
int GapsOf(const Scan& scan) {
  int gaps = 0;
  for (std::size_t i = 1; i < scan.lines.size(); ++i)
    gaps += scan.lines[i].seq != scan.lines[i - 1].seq + 1 ? 1 : 0;
  return gaps;
}

Result<ExitCode> ShowDigests(const std::string& file, bool json) {
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(file));
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission->ListScans());
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ScanSummary& summary : scans) {
    FORESIGHT_TRY(const Scan scan, mission->LoadScan(summary.id));
    const std::string digest = ScanDigest(scan);
    if (!json) PrintLine(fmt::format("{}  scan {}  {}", digest, summary.id, summary.uuid));
    list.push_back({{"scan", summary.id},
                    {"uuid", summary.uuid},
                    {"digest", digest},
                    {"state", ToString(scan.state)},
                    {"lines", scan.lines.size()},
                    {"gaps", GapsOf(scan)},
                    {"images", scan.frames.size()}});
  }
  if (json) PrintJson({{"mission", file}, {"scans", list}});
  return ExitCode::kDone;
}

}  // namespace

void AddMissionDigestCommand(CLI::App& mission, Invocation& invocation) {
  struct Arguments {
    std::string file;
    bool json = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = mission.add_subcommand(
      "digest", "SHA-256 of each scan: equal where head and station hold the same scan");
  command->add_option("file", arguments->file, "Mission file")->required();
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& /*context*/) {
      return ShowDigests(arguments->file, arguments->json);
    };
  });
}

}  // namespace foresight
