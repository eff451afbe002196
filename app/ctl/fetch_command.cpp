#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "app/common/connect_head.h"
#include "app/common/execute_scan.h"
#include "app/ctl/command.h"
#include "hardware/link/client/mission_archive.h"
#include "hardware/link/client/remote_head.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;
using Place = LinkedScan::Place;

struct FetchArguments {
  LinkArguments link;
  std::vector<std::string> scans;  ///< empty: all
  bool list = false;
  std::string out;
  bool json = false;
};

nlohmann::ordered_json ToJson(const LinkedScan& scan) {
  return {{"scan", scan.scan_id},     {"begin_utc_ns", scan.begin_utc_ns},
          {"lines", scan.of_lines},   {"images", scan.of_images},
          {"bytes", scan.left_bytes}, {"state", ToString(scan.place)}};
}

void Print(const std::vector<LinkedScan>& scans, bool json) {
  if (json) {
    auto list = nlohmann::ordered_json::array();
    for (const LinkedScan& scan : scans) list.push_back(ToJson(scan));
    return PrintJson(list);
  }
  for (const LinkedScan& scan : scans)
    PrintLine(fmt::format("{}  {} lines, {} images, about {:.1f} MB", scan.scan_id, scan.of_lines,
                          scan.of_images, 1e-6 * static_cast<double>(scan.left_bytes)));
}

const LinkedScan* Find(const std::vector<LinkedScan>& scans, const std::string& id) {
  const auto found = std::find_if(scans.begin(), scans.end(),
                                  [&](const LinkedScan& scan) { return scan.scan_id == id; });
  return found == scans.end() ? nullptr : &*found;
}

/// Those that were asked for, or all.
Result<std::vector<std::string>> Wanted(const FetchArguments& arguments,
                                        const std::vector<LinkedScan>& there) {
  std::vector<std::string> wanted = arguments.scans;
  for (const std::string& id : wanted)
    if (Find(there, id) == nullptr)
      return Fail(ErrorCode::kInvalidInput,
                  "{}: the head has no scan '{}': --list shows those it has", arguments.link.head,
                  id);
  if (wanted.empty())
    for (const LinkedScan& scan : there) wanted.push_back(scan.scan_id);
  return wanted;
}

/// Until all of them are here. What has come of the others stays in the spool for the next time.
Status WaitForAll(const RemoteHead& head, const std::vector<std::string>& wanted,
                  const RunContext& context) {
  std::string said;
  for (;;) {
    const std::vector<LinkedScan> scans = head.Scans();
    std::size_t here = 0;
    std::int64_t left = 0;
    for (const std::string& id : wanted) {
      const LinkedScan* scan = Find(scans, id);
      if (scan == nullptr) continue;
      if (scan->place == Place::kHere)
        ++here;
      else
        left += scan->left_bytes;
    }
    const std::string progress = fmt::format("{} of {} scans, {:.1f} MB to come", here,
                                             wanted.size(), 1e-6 * static_cast<double>(left));
    const bool all = here == wanted.size();
    if (progress != said) PrintProgress(progress, all ? ProgressEnd::kLast : ProgressEnd::kMore);
    said = progress;
    if (all) return {};
    if (context.Cancelled())
      return Fail(ErrorCode::kCancelled, "cancelled: what has come is kept for the next time");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

Result<ExitCode> Run(const FetchArguments& arguments, const RunContext& context) {
  const auto archive = std::make_shared<MissionArchive>();
  // A list fetches nothing, also not what another run left: its spool is where none can be.
  const fs::path spool =
      arguments.list ? fs::path("/dev/null/spool") : fs::path(arguments.out + ".spool");
  FORESIGHT_TRY(const auto head,
                ConnectHead(arguments.link, HeadUse::kRead, archive, spool.string()));
  const std::vector<LinkedScan> there = head->Scans();
  if (arguments.list) {
    Print(there, arguments.json);
    return there.empty() ? ExitCode::kNegative : ExitCode::kDone;
  }
  FORESIGHT_TRY(const std::vector<std::string> wanted, Wanted(arguments, there));
  if (wanted.empty()) {
    PrintNote("{}: the head has no scans", arguments.link.head);
    return ExitCode::kNegative;
  }
  FORESIGHT_TRY(const auto mission, OpenOrCreateMission(arguments.out));
  archive->Use(mission);
  for (const std::string& id : wanted) head->Fetch(id);
  FORESIGHT_CHECK(WaitForAll(*head, wanted, context));
  std::vector<LinkedScan> fetched;
  for (const std::string& id : wanted) fetched.push_back(*Find(head->Scans(), id));
  Print(fetched, arguments.json);
  std::error_code ignored;  // another run's rest stays
  fs::remove(spool, ignored);
  return ExitCode::kDone;
}

}  // namespace

void AddFetchCommand(CLI::App& app, Invocation& invocation) {
  auto* command = app.add_subcommand("fetch", "Bring scans that a head keeps into a mission file");
  const auto arguments = std::make_shared<FetchArguments>();
  AddLinkOptions(*command, arguments->link)->required();
  CLI::Option* list =
      command->add_flag("--list", arguments->list, "List the scans that the head has");
  command->add_option("--scan", arguments->scans, "Scan to bring, by its id; default: all of them")
      ->excludes(list);
  CLI::Option* out = command
                         ->add_option("-o,--out", arguments->out,
                                      "Mission file; scans are added to one that exists")
                         ->excludes(list);
  command->add_flag("--json", arguments->json, "Print the scans as JSON");
  command->callback([arguments, list, out, &invocation] {
    if (list->empty() && out->empty()) throw CLI::RequiredError("--list or --out");
    invocation = [arguments](const RunContext& context) { return Run(*arguments, context); };
  });
}

}  // namespace foresight
