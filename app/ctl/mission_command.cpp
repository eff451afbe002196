#include <memory>

#include "app/ctl/command.h"
#include "app/ctl/mission_beside.h"
#include "core/base/utc_text.h"
#include "core/geometry/angles.h"
#include "core/mission/mission_damage.h"
#include "core/mission/mission_file.h"
#include "core/mission/recompute.h"

namespace foresight {
namespace {

struct MissionArguments {
  std::string file;
  bool recompute = false;
  bool json = false;
};

nlohmann::ordered_json ToJson(const ScanSummary& scan) {
  auto images = nlohmann::ordered_json::array();
  for (const double angle_rad : scan.plan.image_angles_rad)
    images.push_back(DegreesFromRadians(angle_rad));
  return {{"scan", scan.id},
          {"uuid", scan.uuid},
          {"begin_utc", UtcText(scan.begin_utc_ns)},
          {"source", scan.source},
          {"simulated", scan.simulated},
          {"imported", scan.imported},
          {"from_deg", DegreesFromRadians(scan.plan.from_rad)},
          {"to_deg", DegreesFromRadians(scan.plan.to_rad)},
          {"speed_deg_s", DegreesFromRadians(scan.plan.speed_rad_s)},
          {"image_deg", images},
          {"state", ToString(scan.state)},
          {"reason", scan.reason},
          {"lines", scan.lines},
          {"images", scan.images},
          {"objects", scan.objects}};
}

void PrintTable(const std::vector<ScanSummary>& scans) {
  std::string text =
      fmt::format("{:>4}  {:<20}  {:>16}  {:>7}  {:>6}  {:>6}  {:>7}  {}", "scan", "time (UTC)",
                  "scope, deg", "deg/s", "lines", "images", "objects", "state");
  for (const ScanSummary& scan : scans)
    text += fmt::format(
        "\n{:>4}  {:<20}  {:>16}  {:>7.1f}  {:>6}  {:>6}  {:>7}  {}{}{}", scan.id,
        UtcText(scan.begin_utc_ns),
        scan.imported ? std::string("imported")
                      : fmt::format("{:.1f} to {:.1f}", DegreesFromRadians(scan.plan.from_rad),
                                    DegreesFromRadians(scan.plan.to_rad)),
        scan.imported ? 0.0 : DegreesFromRadians(scan.plan.speed_rad_s), scan.lines, scan.images,
        scan.objects, ToString(scan.state), scan.reason.empty() ? "" : ": ", scan.reason);
  PrintLine(text);
}

Result<ExitCode> List(const MissionArguments& arguments) {
  FORESIGHT_TRY(const std::unique_ptr<MissionFile> mission,
                MissionFile::OpenReadOnly(arguments.file));
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission->ListScans());
  if (arguments.json) {
    auto list = nlohmann::ordered_json::array();
    for (const ScanSummary& scan : scans) list.push_back(ToJson(scan));
    PrintJson({{"mission", arguments.file}, {"scans", list}});
  } else {
    PrintTable(scans);
  }
  return ExitCode::kDone;
}

/// What came of one record.
struct CheckedRecord {
  std::string kind;  ///< "valve", ..., "depth map"
  std::string uuid;
  std::string scan_uuid;
  std::string source;  ///< as its provenance names it
  std::string program_version;
  Recomputed answer;
};

CheckedRecord Described(const std::string& kind, const auto& record) {
  CheckedRecord checked{kind, record.uuid, record.scan_uuid, "", "", {}};
  if (const auto provenance = ProvenanceFromJson(record.provenance_json, "")) {
    checked.source = provenance->source;
    checked.program_version = provenance->program_version;
  }
  return checked;
}

/// Records in the order of their scans, so that each is loaded once.
template <class Record>
void SortByScan(std::vector<Record>& records) {
  std::stable_sort(records.begin(), records.end(),
                   [](const Record& a, const Record& b) { return a.scan_uuid < b.scan_uuid; });
}

Result<std::vector<CheckedRecord>> RemakeAll(const MissionFile& scans, const MissionFile& records,
                                             const RunContext& context) {
  FORESIGHT_TRY(std::vector<DepthRecord> depths, records.ListDepths());
  FORESIGHT_TRY(std::vector<DetectionRecord> detections, records.ListDetections());
  SortByScan(depths);
  SortByScan(detections);
  std::vector<CheckedRecord> checked;
  Recomputer recomputer(scans, &records);
  const double all = std::max(1.0, static_cast<double>(depths.size() + detections.size()));
  const auto part = [&] {
    const double done = static_cast<double>(checked.size());
    return context.Part(done / all, (done + 1.0) / all);
  };
  for (const DepthRecord& record : depths) {
    CheckedRecord entry = Described("depth map", record);
    FORESIGHT_TRY(entry.answer, recomputer.RemakeDepth(record, part()));
    checked.push_back(std::move(entry));
  }
  for (const DetectionRecord& record : detections) {
    CheckedRecord entry = Described(record.kind, record);
    FORESIGHT_TRY(entry.answer, recomputer.RemakeDetection(record, part()));
    checked.push_back(std::move(entry));
  }
  return checked;
}

nlohmann::ordered_json ToJson(const CheckedRecord& record) {
  return {{"kind", record.kind},
          {"uuid", record.uuid},
          {"scan_uuid", record.scan_uuid},
          {"source", record.source},
          {"program_version", record.program_version},
          {"outcome", ToString(record.answer.outcome)},
          {"differences", record.answer.differences}};
}

void Print(const MissionArguments& arguments, const std::vector<ScanSummary>& scans,
           const std::vector<CheckedRecord>& records, std::int64_t different) {
  if (arguments.json) {
    auto list = nlohmann::ordered_json::array();
    for (const CheckedRecord& record : records) list.push_back(ToJson(record));
    PrintJson({{"mission", arguments.file},
               {"scans", scans.size()},
               {"readable", true},
               {"recomputed", arguments.recompute ? list : nlohmann::ordered_json(nullptr)},
               {"different", different}});
    return;
  }
  std::string text =
      fmt::format("{}: {} scans, everything can be read", arguments.file, scans.size());
  for (const CheckedRecord& record : records) {
    text += fmt::format("\n{:<9}  {:<17}  {}", record.kind, record.source,
                        ToString(record.answer.outcome));
    for (const std::string& difference : record.answer.differences) text += "\n    " + difference;
  }
  if (arguments.recompute)
    text += fmt::format("\n{} of {} records made again without a difference",
                        records.size() - static_cast<std::size_t>(different), records.size());
  PrintLine(text);
}

void PrintDamage(const MissionArguments& arguments, const DamageReport& damage) {
  const std::size_t more = damage.count - damage.records.size();
  if (arguments.json) {
    auto list = nlohmann::ordered_json::array();
    for (const DamagedRecord& record : damage.records)
      list.push_back({{"table", record.table}, {"where", record.where}, {"what", record.what}});
    PrintJson({{"mission", arguments.file},
               {"readable", false},
               {"damage", list},
               {"damage_more", more}});
    return;
  }
  std::string text = fmt::format("{}: damage:", arguments.file);
  for (const DamagedRecord& record : damage.records) text += "\n" + InWords(record);
  if (more > 0) text += fmt::format("\nand {} more", more);
  PrintLine(text);
}

Result<ExitCode> Check(const MissionArguments& arguments, const RunContext& context) {
  constexpr std::size_t kMostNamed = 100;
  FORESIGHT_TRY(const DamageReport damage,
                FindDamage(arguments.file, kMostNamed, context.Part(0.0, 0.1)));
  if (damage.count > 0) {
    PrintDamage(arguments, damage);
    if (arguments.json) return ExitCode::kBadData;  // one document alone on the output
    return Fail(ErrorCode::kBadData,
                "{}: {} damaged records; save the others with 'foresightctl mission recover {} -o "
                "NEW.foresight'",
                arguments.file, damage.count, arguments.file);
  }
  FORESIGHT_TRY(const std::unique_ptr<MissionFile> mission,
                MissionFile::OpenReadOnly(arguments.file));
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission->ListScans());
  std::vector<CheckedRecord> records;
  if (arguments.recompute) {
    FORESIGHT_TRY(const std::unique_ptr<MissionFile> beside, MissionBeside(*mission));
    FORESIGHT_TRY(records,
                  RemakeAll(beside ? *beside : *mission, *mission, context.Part(0.1, 1.0)));
  }
  const auto different =
      std::count_if(records.begin(), records.end(), [](const CheckedRecord& record) {
        return record.answer.outcome != Recomputed::Outcome::kSame;
      });
  Print(arguments, scans, records, different);
  return different == 0 ? ExitCode::kDone : ExitCode::kNegative;
}

}  // namespace

void AddMissionSearchCommand(CLI::App& mission, Invocation& invocation);
void AddMissionResultsCommand(CLI::App& mission, Invocation& invocation);
void AddMissionCompareCommand(CLI::App& mission, Invocation& invocation);
void AddMissionReportCommand(CLI::App& mission, Invocation& invocation);

void AddMissionCommand(CLI::App& app, Invocation& invocation) {
  CLI::App* mission = app.add_subcommand("mission", "What a mission file holds");
  mission->require_subcommand(1);
  const auto add = [&](const char* name, const char* help) {
    const auto arguments = std::make_shared<MissionArguments>();
    CLI::App* command = mission->add_subcommand(name, help);
    command->add_option("file", arguments->file, "Mission file")->required();
    command->add_flag("--json", arguments->json, "Print as JSON");
    return std::pair(command, arguments);
  };
  const auto [list, list_arguments] = add("list", "List the scans");
  list->callback([&invocation, arguments = list_arguments] {
    invocation = [arguments](const RunContext&) { return List(*arguments); };
  });
  const auto [check, check_arguments] = add("check", "Read everything and check its checksums");
  check->add_flag("--recompute", check_arguments->recompute,
                  "Make every detection and depth map again and say what differs");
  check->callback([&invocation, arguments = check_arguments] {
    invocation = [arguments](const RunContext& context) { return Check(*arguments, context); };
  });
  AddMissionShowCommand(*mission, invocation);
  AddMissionDecideCommand(*mission, invocation);
  AddMissionNoteCommand(*mission, invocation);
  AddMissionSearchCommand(*mission, invocation);
  AddMissionRecoverCommand(*mission, invocation);
  AddMissionMergeCommand(*mission, invocation);
  AddMissionPruneCommand(*mission, invocation);
  AddMissionDiffCommand(*mission, invocation);
  AddMissionExportCommand(*mission, invocation);
  AddMissionImportCommand(*mission, invocation);
  AddMissionRunCommand(*mission, invocation);
  AddMissionResultsCommand(*mission, invocation);
  AddMissionCompareCommand(*mission, invocation);
  AddMissionReportCommand(*mission, invocation);
  AddMissionDigestCommand(*mission, invocation);
  AddMissionPoseCommand(*mission, invocation);
}

}  // namespace foresight
