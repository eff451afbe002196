#include <memory>
#include <optional>

#include "app/ctl/command.h"
#include "core/base/utc_text.h"
#include "core/geometry/angles.h"
#include "core/measure/measurement_json.h"
#include "core/mission/mission_file.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

using Json = nlohmann::ordered_json;

struct ShowArguments {
  std::string file;
  std::optional<std::int64_t> scan;
  bool json = false;
};

/// What a detection's own JSON says in a word.
std::string VerdictWord(const DetectionRecord& record) {
  const auto json = nlohmann::json::parse(record.json, nullptr, false);
  if (!json.is_object() || !json.contains("verdict")) return "";
  const auto& verdict = json.at("verdict");
  return verdict.is_object() && verdict.contains("level") && verdict.at("level").is_string()
             ? verdict.at("level").get<std::string>()
             : "";
}

Json ToJson(const DetectionRecord& record) {
  return {{"detection", record.id},
          {"uuid", record.uuid},
          {"scan_uuid", record.scan_uuid},
          {"kind", record.kind},
          {"name", record.name},
          {"verdict", VerdictWord(record)},
          {"decision", ToString(record.decision)},
          {"decided_by", record.decided_by},
          {"deleted", record.deleted},
          {"utc", UtcText(record.utc_ns)},
          {"author", record.author}};
}

Json ToJson(const DepthRecord& record) {
  return {{"uuid", record.uuid},
          {"scan_uuid", record.scan_uuid},
          {"image", record.image_position},
          {"utc", UtcText(record.utc_ns)},
          {"author", record.author},
          {"digest", record.digest},
          {"valid_pixels", record.statistics.valid_pixels},
          {"masked_pixels", record.statistics.masked_pixels}};
}

Json ToJson(const ImageSummary& image) {
  return {{"image", image.position},  {"motor_deg", DegreesFromRadians(image.motor_angle_rad)},
          {"time_s", image.time_s},   {"exposure_s", image.exposure_s},
          {"gain_db", image.gain_db}, {"width", image.width},
          {"height", image.height}};
}

Json ToJson(const NoteRecord& note) {
  const auto measurement = Json::parse(note.json, nullptr, false);
  return {{"uuid", note.uuid},
          {"kind", note.kind},
          {"scan", note.scan_id},
          {"scan_uuid", note.scan_uuid},
          {"object_uuid", note.object_uuid},
          {"text", note.text},
          {"tags", note.tags},
          {"made_utc", UtcText(note.made_utc_ns)},
          {"made_by", note.made_by},
          {"changed_utc", UtcText(note.utc_ns)},
          {"changed_by", note.author},
          {"measurement", measurement.is_object() ? measurement : Json(nullptr)}};
}

std::string Line(const NoteRecord& note) {
  std::string about = note.scan_id != 0        ? fmt::format(" of scan {}", note.scan_id)
                      : note.scan_uuid.empty() ? " of the mission"
                                               : " of scan " + note.scan_uuid;
  if (!note.object_uuid.empty()) about += ", object " + note.object_uuid;
  std::string text = note.text;
  if (const auto measured = MeasurementFromJson(note.json); measured)
    text = fmt::format("{}{}{} {}", text, text.empty() ? "" : ": ", ToString(measured->kind),
                       ValueText(*measured));
  if (!note.tags.empty()) text += " [" + note.tags + "]";
  return fmt::format("{}{}, {}, {}: {}", note.kind, about, UtcText(note.made_utc_ns), note.made_by,
                     text);
}

std::string Line(const DetectionRecord& record) {
  return fmt::format("{:>5}  {:<8}  {:<10}  {:<9}  {:<20}  {}{}", record.id, record.kind,
                     VerdictWord(record), ToString(record.decision), UtcText(record.utc_ns),
                     record.name.empty() ? record.author : record.name + ", " + record.author,
                     record.deleted ? ", deleted" : "");
}

/// Everything that belongs to one scan, or to all.
struct Contents {
  std::vector<DetectionRecord> detections;
  std::vector<DepthRecord> depths;
  std::vector<NoteRecord> notes;  ///< without the deleted ones
  Json detections_json = Json::array();
  Json depths_json = Json::array();
  Json notes_json = Json::array();
};

Result<Contents> ReadContents(const MissionFile& mission, std::optional<std::int64_t> scan) {
  Contents contents;
  FORESIGHT_TRY(contents.detections, mission.ListDetections(scan));
  FORESIGHT_TRY(contents.depths, mission.ListDepths(scan));
  FORESIGHT_TRY(contents.notes, mission.ListNotes());
  std::erase_if(contents.notes, [&](const NoteRecord& note) {
    return note.deleted || (scan && note.scan_id != *scan);
  });
  for (const NoteRecord& note : contents.notes) contents.notes_json.push_back(ToJson(note));
  for (const DetectionRecord& record : contents.detections)
    contents.detections_json.push_back(ToJson(record));
  for (const DepthRecord& record : contents.depths) contents.depths_json.push_back(ToJson(record));
  return contents;
}

void PrintContents(const Contents& contents, std::string text) {
  for (const DetectionRecord& record : contents.detections) text += "\n" + Line(record);
  for (const DepthRecord& record : contents.depths)
    text += fmt::format("\ndepth map of image {}: {} pixels, {} masked, {}", record.image_position,
                        record.statistics.valid_pixels, record.statistics.masked_pixels,
                        UtcText(record.utc_ns));
  for (const NoteRecord& note : contents.notes) text += "\n" + Line(note);
  PrintLine(text);
}

Status ShowScan(const ShowArguments& arguments, const MissionFile& mission) {
  const std::int64_t id = *arguments.scan;
  FORESIGHT_TRY(const ScanSummary summary, mission.Summary(id));
  FORESIGHT_TRY(const Scan header, mission.LoadHeader(id));
  FORESIGHT_TRY(const std::vector<ImageSummary> images, mission.ListImages(id));
  FORESIGHT_TRY(const Contents contents, ReadContents(mission, id));
  const std::string rig = RigId(header.rig);
  if (arguments.json) {
    Json list = Json::array();
    for (const ImageSummary& image : images) list.push_back(ToJson(image));
    PrintJson({{"mission", arguments.file},
               {"scan", id},
               {"uuid", summary.uuid},
               {"begin_utc", UtcText(summary.begin_utc_ns)},
               {"source", summary.source},
               {"simulated", summary.simulated},
               {"imported", summary.imported},
               {"rig_id", rig},
               {"state", ToString(summary.state)},
               {"reason", summary.reason},
               {"from_deg", DegreesFromRadians(summary.plan.from_rad)},
               {"to_deg", DegreesFromRadians(summary.plan.to_rad)},
               {"speed_deg_s", DegreesFromRadians(summary.plan.speed_rad_s)},
               {"lines", summary.lines},
               {"images", list},
               {"detections", contents.detections_json},
               {"depth_maps", contents.depths_json},
               {"notes", contents.notes_json}});
    return {};
  }
  std::string text = fmt::format(
      "scan {} ({}), {}{}\n{}{}, begun {}\n{}: {} lines\nrig {}", id, summary.uuid,
      ToString(summary.state), summary.reason.empty() ? "" : ": " + summary.reason, summary.source,
      summary.simulated ? " (simulated)" : "", UtcText(summary.begin_utc_ns),
      summary.imported ? std::string("imported")
                       : fmt::format("{:.1f} to {:.1f} deg at {:.1f} deg/s",
                                     DegreesFromRadians(summary.plan.from_rad),
                                     DegreesFromRadians(summary.plan.to_rad),
                                     DegreesFromRadians(summary.plan.speed_rad_s)),
      summary.lines, rig);
  for (const ImageSummary& image : images)
    text += fmt::format("\nimage {}: {} x {} at {:.2f} deg, exposure {:.2f} ms, gain {:.1f} dB",
                        image.position, image.width, image.height,
                        DegreesFromRadians(image.motor_angle_rad), 1e3 * image.exposure_s,
                        image.gain_db);
  PrintContents(contents, text);
  return {};
}

Status ShowMission(const ShowArguments& arguments, const MissionFile& mission) {
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission.ListScans());
  FORESIGHT_TRY(const std::vector<EventRecord> events, mission.ListEvents());
  FORESIGHT_TRY(const Contents contents, ReadContents(mission, std::nullopt));
  std::int64_t lines = 0, images = 0;
  for (const ScanSummary& scan : scans) {
    lines += scan.lines;
    images += scan.images;
  }
  if (arguments.json) {
    Json log = Json::array();
    for (const EventRecord& event : events)
      log.push_back({{"utc", UtcText(event.utc_ns)},
                     {"source", event.source},
                     {"severity", event.severity},
                     {"text", event.text}});
    PrintJson({{"mission", arguments.file},
               {"review", mission.IsReview()},
               {"being_recorded", mission.IsBeingRecorded()},
               {"closed_properly", mission.WasClosedProperly()},
               {"scans", scans.size()},
               {"lines", lines},
               {"images", images},
               {"detections", contents.detections_json},
               {"depth_maps", contents.depths_json},
               {"notes", contents.notes_json},
               {"log", log}});
    return {};
  }
  std::string text = fmt::format(
      "{}{}: {} scans, {} lines, {} images, {} detections, {} depth "
      "maps, {} lines of the log",
      arguments.file, mission.IsReview() ? " (a review)" : "", scans.size(), lines, images,
      contents.detections.size(), contents.depths.size(), events.size());
  if (mission.IsBeingRecorded())
    text += "\nit is being recorded now";
  else if (!mission.WasClosedProperly())
    text += "\nit was not closed: the recording program crashed, or it was copied without its -wal";
  for (const EventRecord& event : events)
    text += fmt::format("\n{}  {:<9}  {:<8}  {}", UtcText(event.utc_ns), event.source,
                        event.severity, event.text);
  PrintContents(contents, text);
  return {};
}

}  // namespace

void AddMissionShowCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<ShowArguments>();
  CLI::App* command = mission.add_subcommand(
      "show", "What a mission or one of its scans holds: images, objects, depth maps, log");
  command->add_option("file", arguments->file, "Mission file")->required();
  command->add_option("--scan", arguments->scan, "One scan, by its number");
  command->add_flag("--json", arguments->json, "Print as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext&) -> Result<ExitCode> {
      FORESIGHT_TRY(const auto mission_file, MissionFile::OpenReadOnly(arguments->file));
      FORESIGHT_CHECK(arguments->scan ? ShowScan(*arguments, *mission_file)
                                      : ShowMission(*arguments, *mission_file));
      return ExitCode::kDone;
    };
  });
}

}  // namespace foresight
