#include "core/mission/kept_check.h"

#include <map>
#include <nlohmann/json.hpp>

#include "core/base/utc_text.h"
#include "core/base/version.h"
#include "core/depth/depth_option_table.h"
#include "core/detection/detection_json.h"
#include "core/geometry/angles.h"
#include "core/io/json_numbers.h"
#include "core/io/json_reader.h"
#include "core/mission/new_records.h"
#include "core/mission/provenance.h"
#include "core/mission/record_events.h"
#include "core/mission/rig_check_json.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr const char* kEventSource = "self-check";

OrderedJson ErrorsJson(const HeldOutErrors& errors) {
  return {{"beams", errors.beams},
          {"q50_m", FiniteOrNull(errors.q50_m)},
          {"q80_m", FiniteOrNull(errors.q80_m)},
          {"q95_m", FiniteOrNull(errors.q95_m)},
          {"right", FiniteOrNull(errors.right)}};
}

OrderedJson ClassesJson(const std::vector<HeldOutClass>& classes) {
  OrderedJson list = OrderedJson::array();
  for (const HeldOutClass& one : classes) {
    OrderedJson entry = {{"class", one.name}};
    entry.update(ErrorsJson(one.errors));
    list.push_back(std::move(entry));
  }
  return list;
}

OrderedJson ConfidenceJson(const ConfidenceClass& one) {
  return {{"from", one.from},         {"to", one.to},       {"beams", one.beams},
          {"promised", one.promised}, {"right", one.right}, {"sigma", one.sigma}};
}

OrderedJson DepthJson(const DepthCheck& depth) {
  OrderedJson confidence = OrderedJson::array();
  for (const ConfidenceClass& one : depth.by_confidence) confidence.push_back(ConfidenceJson(one));
  return {
      {"state", ToString(depth.state)},
      {"method", depth.method},
      {"image_deg", DegreesFromRadians(depth.image_rad)},
      {"map",
       {{"q50_m", FiniteOrNull(depth.map_q50_m)},
        {"q80_m", FiniteOrNull(depth.map_q80_m)},
        {"q95_m", FiniteOrNull(depth.map_q95_m)}}},
      {"against_beams", ErrorsJson(depth.all)},
      {"against_scattered_beams", ErrorsJson(depth.scattered)},
      {"against_lines", ErrorsJson(depth.lines)},
      {"by_distance", ClassesJson(depth.by_distance)},
      {"by_edge", ClassesJson(depth.by_edge)},
      {"by_confidence", confidence},
      {"promise", depth.promise.beams > 0 ? ConfidenceJson(depth.promise) : OrderedJson(nullptr)},
      {"kept", depth.kept},
      {"held_out", depth.left_out},
      {"not_counted", depth.not_counted}};
}

OrderedJson ObjectJson(const HalfFits& object) {
  OrderedJson differences = OrderedJson::array();
  for (const HalvesDifference& difference : object.differences)
    differences.push_back({{"axis", difference.axis},
                           {"value", difference.value},
                           {"predicted", difference.predicted},
                           {"sigmas", difference.Sigmas()},
                           {"unit", difference.is_turn ? "rad" : "m"}});
  return {{"detection", object.uuid},
          {"what", object.what},
          {"state", ToString(object.state)},
          {"not_seen", object.not_seen},
          {"differences", differences}};
}

CheckLight LightFrom(const std::string& name) {
  for (const CheckLight light :
       {CheckLight::kNotSeen, CheckLight::kGood, CheckLight::kAmber, CheckLight::kRed})
    if (name == ToString(light)) return light;
  throw std::invalid_argument(fmt::format("'{}' is no light of a check", name));
}

/// Takes out of the answer what a lamp shows and what is gathered.
void ReadAnswer(KeptCheck& check) {
  const nlohmann::json answer = ParseJson(check.answer_json);
  answer.at("rig_id").get_to(check.rig_id);
  check.rig = RigMeasurementsFromJson(answer.at("rig"));
  check.light = LightFrom(answer.at("light").get<std::string>());
  answer.at("advice").get_to(check.advice);
  answer.at("cannot_see").get_to(check.cannot_see);
  for (const nlohmann::json& point : answer.at("points"))
    check.points.push_back({point.at("name").get<std::string>(),
                            LightFrom(point.at("light").get<std::string>()),
                            point.at("sentence").get<std::string>()});
}

KeptCheck KeptCheckFrom(const EventRecord& event) {
  const nlohmann::json value = ParseJson(event.json);
  KeptCheck check;
  check.utc_ns = event.utc_ns;
  value.at("scan_uuid").get_to(check.scan_uuid);
  value.at("author").get_to(check.author);
  value.at("answer").get_to(check.answer_json);
  ReadAnswer(check);
  return check;
}

Result<KeptObject> ObjectFrom(const Scan& scan, const DetectionRecord& record) {
  FORESIGHT_TRY(const Provenance provenance,
                ProvenanceFromJson(record.provenance_json, "detection " + record.uuid));
  if (!provenance.fit || !provenance.roi)
    return Fail(ErrorCode::kBadData, "detection {}: its provenance names no fit", record.uuid);
  if (provenance.rig_id != RigId(scan.rig))
    return Fail(ErrorCode::kInvalidInput, "detection {}: it was made with another rig",
                record.uuid);
  FORESIGHT_TRY(const NamedSource source, FitSourceFromName(provenance.source));
  KeptObject object;
  FORESIGHT_TRY(object.detection, DetectionFromJson(record.json));
  object.uuid = record.uuid;
  object.name = record.name;
  object.source = source.source;
  object.options = *provenance.fit;
  object.roi = *provenance.roi;
  if (provenance.depth) object.depth = *provenance.depth;
  const auto images = static_cast<std::int64_t>(scan.frames.size());
  if (provenance.image_position >= 0 && provenance.image_position < images)
    object.frame = &scan.frames[static_cast<std::size_t>(provenance.image_position)];
  return object;
}

}  // namespace

std::string ScanCheckToJson(const ScanCheck& check, const Scan& scan,
                            const ScanCheckOptions& options) {
  OrderedJson points = OrderedJson::array();
  for (const CheckPoint& point : check.points)
    points.push_back(
        {{"name", point.name}, {"light", ToString(point.light)}, {"sentence", point.sentence}});
  OrderedJson objects = OrderedJson::array();
  for (const HalfFits& object : check.objects) objects.push_back(ObjectJson(object));
  return RecordEventJson({{"format", 1},
                          {"program_version", ProgramVersion()},
                          {"scan_uuid", scan.uuid},
                          {"rig_id", RigId(scan.rig)},
                          {"light", ToString(check.light)},
                          {"advice", check.advice},
                          {"points", points},
                          {"cannot_see", check.cannot_see},
                          {"depth_options", OrderedJson::parse(DepthOptionsToJson(options.depth))},
                          {"depth", check.depth ? DepthJson(*check.depth) : OrderedJson(nullptr)},
                          {"rig", OrderedJson::parse(RigCheckToJson(check.rig))},
                          {"objects", objects}});
}

KeptCheck NewKeptCheck(const Scan& scan, const ScanCheck& check, const ScanCheckOptions& options) {
  KeptCheck kept;
  kept.scan_uuid = scan.uuid;
  kept.author = OperatorName();
  kept.utc_ns = NowUtc_ns();
  kept.answer_json = ScanCheckToJson(check, scan, options);
  ReadAnswer(kept);
  return kept;
}

Status AddScanCheck(MissionFile& file, const KeptCheck& check) {
  const bool grave = check.light >= CheckLight::kAmber;
  const std::string json = RecordEventJson({{"format", 1},
                                            {"scan_uuid", check.scan_uuid},
                                            {"author", check.author},
                                            {"light", ToString(check.light)},
                                            {"answer", check.answer_json}});
  FORESIGHT_CHECK(file.AddEvent(
      {0, check.utc_ns, kEventSource, grave ? "warning" : "info", check.advice, json}));
  return {};
}

Result<std::vector<KeptCheck>> ListScanChecks(const MissionFile& file) {
  std::vector<KeptCheck> checks;
  FORESIGHT_CHECK(ReadRecordEvents(
      file, "self-check", [](const EventRecord& event) { return event.source == kEventSource; },
      [&](const EventRecord& event) { checks.push_back(KeptCheckFrom(event)); }));
  return checks;
}

Result<std::vector<KeptCheck>> NewestScanChecks(const MissionFile& mission,
                                                const MissionFile* review) {
  std::map<std::pair<std::string, std::string>, KeptCheck> newest;
  for (const MissionFile* file : {&mission, review}) {
    if (file == nullptr) continue;
    FORESIGHT_TRY(std::vector<KeptCheck> checks, ListScanChecks(*file));
    for (KeptCheck& check : checks) {
      const std::pair key(check.scan_uuid, check.rig_id);
      const auto found = newest.find(key);
      if (found == newest.end())
        newest.emplace(key, std::move(check));
      else if (check.utc_ns >= found->second.utc_ns)
        found->second = std::move(check);
    }
  }
  std::vector<KeptCheck> checks;
  for (auto& [key, check] : newest) checks.push_back(std::move(check));
  return checks;
}

std::vector<KeptObject> AcceptedObjects(const Scan& scan,
                                        const std::vector<DetectionRecord>& records,
                                        std::vector<std::string>& left_out) {
  std::vector<KeptObject> objects;
  for (const DetectionRecord& record : records) {
    if (record.deleted || record.decision != Decision::kAccepted || record.scan_uuid != scan.uuid)
      continue;
    auto object = ObjectFrom(scan, record);
    if (object)
      objects.push_back(std::move(*object));
    else
      left_out.push_back(object.error().message);
  }
  return objects;
}

}  // namespace foresight
