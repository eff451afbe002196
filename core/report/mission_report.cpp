#include "core/report/mission_report.h"

#include <algorithm>
#include <map>

#include "core/base/atomic_file.h"
#include "core/base/utc_text.h"
#include "core/base/version.h"
#include "core/depth/depth_method.h"
#include "core/depth/depth_option_table.h"
#include "core/detection/candidates.h"
#include "core/detection/detection_json.h"
#include "core/detection/facts.h"
#include "core/geometry/angles.h"
#include "core/io/png.h"
#include "core/measure/measurement_json.h"
#include "core/mission/provenance.h"
#include "core/mission/side_result.h"
#include "core/options/option_text.h"
#include "core/pictures/depth_picture.h"
#include "core/report/html_report.h"
#include "core/report/report_pages.h"
#include "core/report/scan_pictures.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

using Table = HtmlReport::Table;
using Row = HtmlReport::Row;

std::string Joined(const std::vector<std::string>& words, const char* between, const char* none) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text.empty() ? none : text;
}

std::string Degrees(double radians) {
  return fmt::format("{:.1f} deg", DegreesFromRadians(radians));
}

/// A detection with what a mission says of it.
struct ReportedObject {
  DetectionRecord record;
  Detection detection;
  std::optional<Provenance> provenance;
};

struct ReportedScan {
  ScanSummary summary;
  Scan scan;
  std::vector<ReportedObject> objects;
  std::vector<SideResult> side_results;
  std::vector<NoteRecord> notes;
  std::int64_t image = -1;  ///< that is shown
  DepthOptions options;
};

/// Those about a scan, or with an empty uuid those about the mission; without the deleted ones.
std::vector<NoteRecord> NotesAbout(const std::string& scan_uuid, std::vector<NoteRecord> notes) {
  std::erase_if(
      notes, [&](const NoteRecord& note) { return note.deleted || note.scan_uuid != scan_uuid; });
  return notes;
}

/// The image that most objects were found in; where none was, the nearest to the scope's middle.
std::int64_t ImageToShow(const ReportedScan& reported) {
  std::map<std::int64_t, int> votes;
  const auto count = static_cast<std::int64_t>(reported.scan.frames.size());
  for (const ReportedObject& object : reported.objects)
    if (object.provenance && object.provenance->image_position >= 0 &&
        object.provenance->image_position < count)
      ++votes[object.provenance->image_position];
  const auto most = std::max_element(
      votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most != votes.end()) return most->first;
  const ScanPlan& plan = reported.scan.plan;
  const CameraFrame* middle = NearestFrame(reported.scan, 0.5 * (plan.from_rad + plan.to_rad));
  for (std::int64_t i = 0; i < count; ++i)
    if (&reported.scan.frames[static_cast<std::size_t>(i)] == middle) return i;
  return -1;
}

Result<ReportedScan> Read(const MissionFile& mission, const MissionFile* review,
                          const ScanSummary& summary, const std::vector<NoteRecord>& notes) {
  ReportedScan reported;
  reported.summary = summary;
  FORESIGHT_TRY(reported.scan, mission.LoadScan(summary.id));
  FORESIGHT_TRY(const std::vector<DetectionRecord> records,
                DetectionsOfScan(mission, review, summary.uuid));
  for (const DetectionRecord& record : records) {
    if (record.deleted) continue;
    auto detection = DetectionFromJson(record.json);
    if (!detection)
      return Fail(ErrorCode::kBadData, "{}: detection {}: {}", mission.path().string(), record.uuid,
                  detection.error().message);
    const auto provenance = ProvenanceFromJson(record.provenance_json, record.uuid);
    reported.objects.push_back(
        {record, std::move(*detection), provenance ? std::optional(*provenance) : std::nullopt});
  }
  FORESIGHT_TRY(reported.side_results, SideResultsOf(mission, review, summary.uuid));
  reported.notes = NotesAbout(summary.uuid, notes);
  reported.image = ImageToShow(reported);
  FORESIGHT_TRY(reported.options, OriginalDepthOptions(mission, summary.id, reported.image));
  return reported;
}

Table ScanTable(const ReportedScan& reported) {
  const Scan& scan = reported.scan;
  std::vector<std::string> images;
  for (const CameraFrame& frame : scan.frames) images.push_back(Degrees(frame.motor_angle_rad));
  const std::string state = ToString(scan.state);
  return {"Scan",
          {{"begun (UTC)", UtcText(reported.summary.begin_utc_ns)},
           {"state", scan.reason.empty() ? state : state + ": " + scan.reason},
           {"scope", Degrees(scan.plan.from_rad) + " to " + Degrees(scan.plan.to_rad)},
           {"speed", Degrees(scan.plan.speed_rad_s) + "/s"},
           {"lines", fmt::format("{}", scan.lines.size())},
           {"images at", Joined(images, ", ", "none")},
           {"head", scan.source + (scan.simulated ? " (simulated)" : "")},
           {"rig", RigId(scan.rig)},
           {"uuid", scan.uuid}}};
}

Table ObjectsTable(const ReportedScan& reported) {
  Table table{"Objects", {}, {"object", "what", "verdict", "decision", "found by", "found (UTC)"}};
  for (const ReportedObject& object : reported.objects) {
    const DetectionRecord& record = object.record;
    const Verdict& verdict = VerdictOf(object.detection);
    std::string decision = ToString(record.decision);
    if (record.decision != Decision::kOpen && record.decided_candidate > 0)
      decision += fmt::format(" (answer {})", record.decided_candidate + 1);
    if (!record.decided_by.empty())
      decision += fmt::format(" by {}, {}", record.decided_by, UtcText(record.decided_utc_ns));
    table.rows.push_back(
        {record.name.empty() ? record.kind : record.name,
         CandidateText(object.detection, 0),
         {fmt::format("{} ({})", ToString(verdict.level), ProbabilityText(verdict.probability)),
          decision, record.author.empty() ? "not known" : record.author, UtcText(record.utc_ns)}});
  }
  return table;
}

void AddProvenance(const ReportedObject& object, Table& table) {
  table.rows.push_back({"uuid", object.record.uuid});
  if (!object.provenance) {
    table.rows.push_back({"made by", "an earlier program, which did not say how"});
    return;
  }
  const Provenance& made = *object.provenance;
  table.rows.push_back({"fitted to", SourceTitle(made.source)});
  if (made.depth)
    table.rows.push_back(
        {"depth options", Joined(DifferencesInWords(*made.depth, DefaultsOf(made.depth->method)),
                                 "; ", "the method's own")});
  if (made.image_position >= 0)
    table.rows.push_back({"image", fmt::format("{}", made.image_position)});
  if (made.part)
    table.rows.push_back({"lines", fmt::format("{} of {}: the scan was not over", made.part->lines,
                                               made.part->of_lines)});
  table.rows.push_back({"rig", made.rig_id});
  table.rows.push_back({"program version", made.program_version});
}

/// What the operator reads on the card, and where it comes from.
Table ObjectTable(const ReportedObject& object, const SensorRig& rig, std::size_t number) {
  const std::string name = object.record.name.empty() ? object.record.kind : object.record.name;
  Table table{fmt::format("Object {}: {}", number, name), {}};
  table.rows.push_back({"verdict", VerdictOf(object.detection).reason});
  const auto* terrain = std::get_if<TerrainDetection>(&object.detection);
  const int parts = terrain == nullptr ? 1 : static_cast<int>(terrain->surfaces.size());
  for (int part = 0; part < parts; ++part) {
    if (terrain != nullptr)
      table.rows.push_back({"surface", CandidateText(object.detection, part)});
    for (const Fact& fact : FactsOf(object.detection, part, rig.robot_from_base))
      table.rows.push_back({fact.name, fact.value});
  }
  AddProvenance(object, table);
  return table;
}

/// A row for each group of options, so that the page of a scan stays one.
Table SettingsTable(const DepthOptions& options) {
  Table table{"Settings of the depth map", {}};
  table.rows.push_back({"method", InfoOf(options.method).title});
  for (const Option<DepthOptions>& option : DepthOptionTable()) {
    if (!option.AppliesTo(options)) continue;
    const OptionInfo& info = option.info;
    const std::string said = info.title + ": " + OptionInWords(info, option.get(options));
    if (table.rows.back().name == info.group)
      table.rows.back().value += "; " + said;
    else
      table.rows.push_back({info.group, said});
  }
  return table;
}

Table SideResultsTable(const ReportedScan& reported) {
  Table table{"Side results", {}, {"name", "what differs", "author", "time (UTC)", "rig"}};
  for (const SideResult& result : reported.side_results)
    table.rows.push_back(
        {result.name,
         Joined(DifferencesInWords(result, reported.options, reported.scan.rig), "; ", "nothing"),
         {result.author, UtcText(result.utc_ns), result.rig_id.substr(0, 8)}});
  return table;
}

Table NotesTable(const std::vector<NoteRecord>& notes) {
  Table table{"Notes and measurements", {}, {"what", "text", "tags", "by", "time (UTC)"}};
  for (const NoteRecord& note : notes) {
    const auto measured = MeasurementFromJson(note.json);
    std::string what = measured ? ToString(measured->kind) : note.kind;
    if (measured && measured->frame == MeasureFrame::kMap) what += " in a map";
    std::string text = note.text;
    if (measured) text += (text.empty() ? "" : ": ") + ValueText(*measured);
    table.rows.push_back({what, text, {note.tags, note.made_by, UtcText(note.made_utc_ns)}});
  }
  return table;
}

/// What makes the pictures of one scan and puts them into the folder.
class Pictures {
 public:
  Pictures(const ReportedScan& reported, const std::filesystem::path& folder,
           MissionReportFiles& files)
      : reported_(reported), folder_(folder), files_(files) {
    for (const ReportedObject& object : reported.objects) objects_.push_back(object.detection);
  }

  Status Make(const RunContext& context) {
    const Scan& scan = reported_.scan;
    const CameraFrame* frame = nullptr;
    if (reported_.image >= 0) frame = &scan.frames[static_cast<std::size_t>(reported_.image)];
    if (frame != nullptr)
      FORESIGHT_CHECK(
          Add("image", "Image",
              "At " + Degrees(frame->motor_angle_rad) +
                  ". Solid: CONFIRMED, dashed: LIKELY, thin grey: UNSURE; yellow: the region.",
              PaintObjects(frame->image, objects_, scan.rig, frame->motor_angle_rad)));
    const auto cloud = RegisterScan(scan, context.Part(0.0, 0.1));
    if (!cloud) return LeaveOut("the cloud", cloud.error());
    if (frame != nullptr) {
      const auto depth =
          ComputeDepthInFrame(*cloud, scan.rig, *frame, reported_.options, context.Part(0.1, 0.9));
      if (depth)
        FORESIGHT_CHECK(AddDepth(*depth, *frame));
      else
        FORESIGHT_CHECK(LeaveOut("the depth map", depth.error()));
    }
    FORESIGHT_CHECK(
        Add("above", "Cloud from above",
            "The lidar's returns in the robot's frame, forward is up; higher than 0.5 m "
            "over the head is left out.",
            PaintScanCloud(*cloud, scan.rig, objects_, CloudSide::kAbove)));
    return Add("aside", "Cloud from aside", "Seen from the robot's right, forward is to the right.",
               PaintScanCloud(*cloud, scan.rig, objects_, CloudSide::kAside));
  }

  std::vector<HtmlReport::Picture> Take() { return std::move(pictures_); }

 private:
  Status AddDepth(const DepthResult& depth, const CameraFrame& frame) {
    const ValueRange range = DepthRangeOf(depth.dense.depth_m, depth.mask);
    ColorImage picture =
        PaintObjects(PaintDepth(depth.dense, &depth.mask, DepthLayer::kDepth, range), objects_,
                     reported_.scan.rig, frame.motor_angle_rad);
    PictureLegend legend;
    legend.bar = {ColorMap::kTurbo, range, "m", false};
    return Add("depth", "Masked depth",
               fmt::format("{}; hatched pixels are not to be trusted; {:.1f} % of the pixels were "
                           "measured.",
                           InfoOf(depth.options.method).title, 100.0 * depth.density),
               WithLegend(picture, legend));
  }

  /// Written at once: pictures of a hundred scans do not fit into memory.
  Status Add(const char* what, const char* title, const std::string& caption,
             const ColorImage& image) {
    const std::string file = fmt::format("scan-{}-{}.png", reported_.summary.id, what);
    FORESIGHT_CHECK(WritePng(folder_ / file, image));
    files_.files.push_back(file);
    pictures_.push_back({file, title, caption, {}});
    return {};
  }

  Status LeaveOut(const char* what, const Error& error) {
    if (error.code == ErrorCode::kCancelled) return tl::unexpected(error);
    files_.left_out.push_back(
        fmt::format("scan {}: {}: {}", reported_.summary.id, what, error.message));
    return {};
  }

  const ReportedScan& reported_;
  const std::filesystem::path& folder_;
  MissionReportFiles& files_;
  std::vector<Detection> objects_;
  std::vector<HtmlReport::Picture> pictures_;
};

Result<HtmlReport::Section> SectionOf(const ReportedScan& reported,
                                      const std::filesystem::path& folder,
                                      MissionReportFiles& files, const RunContext& context) {
  const std::size_t left_out = files.left_out.size();
  Pictures pictures(reported, folder, files);
  FORESIGHT_CHECK(pictures.Make(context));
  HtmlReport::Section section;
  section.title = fmt::format("Scan {}", reported.summary.id);
  for (std::size_t i = left_out; i < files.left_out.size(); ++i)
    section.text += (section.text.empty() ? "Left out: " : "; ") + files.left_out[i];
  section.pictures = pictures.Take();
  section.tables.push_back(ScanTable(reported));
  if (!reported.objects.empty()) section.tables.push_back(ObjectsTable(reported));
  for (std::size_t i = 0; i < reported.objects.size(); ++i)
    section.tables.push_back(ObjectTable(reported.objects[i], reported.scan.rig, i + 1));
  if (!reported.notes.empty()) section.tables.push_back(NotesTable(reported.notes));
  if (!reported.side_results.empty()) section.tables.push_back(SideResultsTable(reported));
  section.tables.push_back(SettingsTable(reported.options));
  files.objects += static_cast<int>(reported.objects.size());
  return section;
}

/// The newest lines; commands of the window are left out, and side results have a table.
Result<Table> LogTable(const MissionFile& mission, const MissionFile* review) {
  constexpr std::size_t kMostLines = 200;
  std::vector<EventRecord> lines;
  for (const MissionFile* file : {&mission, review}) {
    if (file == nullptr) continue;
    FORESIGHT_TRY(const std::vector<EventRecord> events, file->ListEvents());
    for (const EventRecord& event : events)
      if (!event.text.starts_with("command ") && !IsSideResult(event)) lines.push_back(event);
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const EventRecord& a, const EventRecord& b) { return a.utc_ns < b.utc_ns; });
  Table table{"All lines", {}, {"time (UTC)", "level", "source", "text"}};
  if (lines.size() > kMostLines) {
    table.title = fmt::format("The last {} of {} lines", kMostLines, lines.size());
    lines.erase(lines.begin(), lines.end() - kMostLines);
  }
  for (const EventRecord& line : lines)
    table.rows.push_back({UtcText(line.utc_ns), line.severity, {line.source, line.text}});
  return table;
}

Table MissionTable(const MissionFile& mission, const MissionFile* review,
                   const std::vector<ScanSummary>& scans, const std::vector<ScanSummary>& shown) {
  return {"Mission",
          {{"file", mission.path().filename().string()},
           {"review", review == nullptr ? "none" : review->path().filename().string()},
           {"scans", fmt::format("{}, {} of them in this report", scans.size(), shown.size())},
           {"report by", fmt::format("Foresight {}", ProgramVersion())}}};
}

Table ScansTable(const std::vector<ScanSummary>& scans) {
  Table table{"Scans",
              {},
              {"scan", "begun (UTC)", "scope", "speed", "lines", "images", "objects", "state"}};
  for (const ScanSummary& scan : scans)
    table.rows.push_back(
        {fmt::format("{}", scan.id),
         UtcText(scan.begin_utc_ns),
         {Degrees(scan.plan.from_rad) + " to " + Degrees(scan.plan.to_rad),
          Degrees(scan.plan.speed_rad_s) + "/s", fmt::format("{}", scan.lines),
          fmt::format("{}", scan.images), fmt::format("{}", scan.objects), ToString(scan.state)}});
  return table;
}

}  // namespace

Result<MissionReportFiles> WriteMissionReport(const MissionFile& mission, const MissionFile* review,
                                              const std::filesystem::path& folder,
                                              const MissionReportOptions& options,
                                              const RunContext& context) {
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission.ListScans());
  std::vector<ScanSummary> shown;
  for (const ScanSummary& scan : scans)
    if (!options.scan || scan.id == *options.scan) shown.push_back(scan);
  if (shown.empty())
    return Fail(ErrorCode::kInvalidInput, "{}: {}", mission.path().string(),
                options.scan ? fmt::format("there is no scan {}", *options.scan)
                             : "the mission holds no scan");
  MissionReportFiles files;
  files.files.push_back("report.html");
  HtmlReport report;
  const std::string name = mission.path().filename().string();
  report.title =
      options.scan ? fmt::format("Scan {} of {}", *options.scan, name) : "Mission " + name;
  report.tables = {MissionTable(mission, review, scans, shown), ScansTable(shown)};
  FORESIGHT_TRY(const std::vector<NoteRecord> notes, NotesOfMission(mission, review));
  if (const auto about = NotesAbout({}, notes); !about.empty())
    report.tables.push_back(NotesTable(about));
  const double all = static_cast<double>(shown.size());
  for (const ScanSummary& scan : shown) {
    if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the report was cancelled");
    const double done = static_cast<double>(files.scans);
    const RunContext part = context.Part(0.9 * done / all, 0.9 * (done + 1.0) / all);
    part.Report(0.0, "writing the report");
    FORESIGHT_TRY(const ReportedScan reported, Read(mission, review, scan, notes));
    FORESIGHT_TRY(HtmlReport::Section section, SectionOf(reported, folder, files, part));
    report.sections.push_back(std::move(section));
    ++files.scans;
  }
  report.summary = fmt::format("{} {}, {} {}.", files.scans, files.scans == 1 ? "scan" : "scans",
                               files.objects, files.objects == 1 ? "object" : "objects");
  FORESIGHT_TRY(const Table log, LogTable(mission, review));
  if (!log.rows.empty()) report.sections.push_back({"Log", "", {log}, {}});
  FORESIGHT_CHECK(WriteHtmlReport(report, folder));
  if (!options.pdf) return files;
  FORESIGHT_TRY(const std::string pdf, PagesOf(report, folder, context.Part(0.9, 1.0)));
  FORESIGHT_CHECK(WriteFileAtomically(folder / "report.pdf", pdf));
  files.files.insert(files.files.begin() + 1, "report.pdf");
  return files;
}

}  // namespace foresight
