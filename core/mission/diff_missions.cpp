#include "core/mission/diff_missions.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "core/mission/json_differences.h"
#include "core/mission/plan_json.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

using Differences = std::vector<MissionDifference>;
using Difference = MissionDifference::Kind;

template <class Record>
std::map<std::string, Record> ByUuid(const std::vector<Record>& records) {
  std::map<std::string, Record> map;
  for (const Record& record : records) map.emplace(record.uuid, record);
  return map;
}

/// Tells what only one side has, and calls `compare` for what both have.
template <class Record, class Compare>
Status Match(const char* what, const std::vector<Record>& first, const std::vector<Record>& second,
             Differences& differences, const Compare& compare) {
  const auto in_first = ByUuid(first), in_second = ByUuid(second);
  for (const auto& [uuid, record] : in_first) {
    const auto other = in_second.find(uuid);
    if (other == in_second.end())
      differences.push_back({Difference::kOnlyInFirst, what, uuid, ""});
    else
      FORESIGHT_CHECK(compare(record, other->second, [&, &uuid = uuid](const std::string& text) {
        differences.push_back({Difference::kDifferent, what, uuid, text});
      }));
  }
  for (const auto& [uuid, record] : in_second)
    if (!in_first.contains(uuid))
      differences.push_back({Difference::kOnlyInSecond, what, uuid, ""});
  return {};
}

template <class Tell, class Value>
void CompareValue(const Tell& tell, const char* name, const Value& was, const Value& is) {
  if (!(was == is)) tell(fmt::format("{}: was {}, is {}", name, was, is));
}

/// "lines: 3 of 49 differ".
template <class Tell, class List>
void CompareList(const Tell& tell, const char* name, const List& was, const List& is) {
  const std::size_t common = std::min(was.size(), is.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < common; ++i) different += was[i] == is[i] ? 0 : 1;
  if (was.size() != is.size())
    tell(fmt::format("{}: were {}, are {}", name, was.size(), is.size()));
  if (different > 0)
    tell(fmt::format("{}: {} of {} that both have differ", name, different, common));
}

template <class Tell>
Status CompareScans(const MissionFile& first, const MissionFile& second, const ScanSummary& a,
                    const ScanSummary& b, const Tell& tell) {
  FORESIGHT_TRY(const Scan was, first.LoadScan(a.id));
  FORESIGHT_TRY(const Scan is, second.LoadScan(b.id));
  CompareValue(tell, "state", std::string(ToString(was.state)), std::string(ToString(is.state)));
  CompareValue(tell, "reason", was.reason, is.reason);
  CompareValue(tell, "source", was.source, is.source);
  CompareValue(tell, "start_utc_ns", was.start_utc_ns, is.start_utc_ns);
  CompareValue(tell, "simulated", was.simulated, is.simulated);
  CompareValue(tell, "rig", RigId(was.rig), RigId(is.rig));
  for (const std::string& difference : JsonDifferences(PlanToJson(was.plan), PlanToJson(is.plan)))
    tell("plan: " + difference);
  CompareList(tell, "lines", was.lines, is.lines);
  if (!(was.given == is.given))
    tell(fmt::format(
        "given cloud: was {} lines of {} beams, is {} of {}{}", was.given.lines, was.given.beams,
        is.given.lines, is.given.beams,
        was.given.points.size() == is.given.points.size() ? ", with other values" : ""));
  CompareList(tell, "motor samples", was.track.samples(), is.track.samples());
  CompareList(tell, "images", was.frames, is.frames);
  return {};
}

template <class Tell>
Status CompareDetections(const DetectionRecord& was, const DetectionRecord& is, const Tell& tell) {
  CompareValue(tell, "scan", was.scan_uuid, is.scan_uuid);
  CompareValue(tell, "kind", was.kind, is.kind);
  CompareValue(tell, "name", was.name, is.name);
  CompareValue(tell, "author", was.author, is.author);
  CompareValue(tell, "decision", std::string(ToString(was.decision)),
               std::string(ToString(is.decision)));
  CompareValue(tell, "answer decided on", was.decided_candidate + 1, is.decided_candidate + 1);
  CompareValue(tell, "deleted", was.deleted, is.deleted);
  for (const std::string& difference : JsonDifferences(was.json, is.json, {"seconds"}))
    tell(difference);
  for (const std::string& difference : JsonDifferences(was.provenance_json, is.provenance_json))
    tell("made from " + difference);
  return {};
}

template <class Tell>
Status CompareDepths(const DepthRecord& was, const DepthRecord& is, const Tell& tell) {
  CompareValue(tell, "scan", was.scan_uuid, is.scan_uuid);
  CompareValue(tell, "image", was.image_position, is.image_position);
  CompareValue(tell, "digest", was.digest, is.digest);
  for (const std::string& difference : JsonDifferences(was.provenance_json, is.provenance_json))
    tell("made from " + difference);
  return {};
}

template <class Tell>
Status CompareNotes(const NoteRecord& was, const NoteRecord& is, const Tell& tell) {
  CompareValue(tell, "scan", was.scan_uuid, is.scan_uuid);
  CompareValue(tell, "object", was.object_uuid, is.object_uuid);
  CompareValue(tell, "text", was.text, is.text);
  CompareValue(tell, "tags", was.tags, is.tags);
  CompareValue(tell, "made by", was.made_by, is.made_by);
  CompareValue(tell, "deleted", was.deleted, is.deleted);
  for (const std::string& difference : JsonDifferences(was.json, is.json)) tell(difference);
  return {};
}

Status CompareLogs(const MissionFile& first, const MissionFile& second, Differences& differences) {
  using SettingKey = std::tuple<std::int64_t, std::string, std::string, std::string, std::string>;
  const auto keys = [](const std::vector<EventRecord>& events) {
    std::multiset<SettingKey> set;
    for (const EventRecord& event : events)
      set.insert({event.utc_ns, event.source, event.severity, event.text, event.json});
    return set;
  };
  FORESIGHT_TRY(const std::vector<EventRecord> was, first.ListEvents());
  FORESIGHT_TRY(const std::vector<EventRecord> is, second.ListEvents());
  const std::multiset<SettingKey> old_keys = keys(was), new_keys = keys(is);
  for (const SettingKey& key : old_keys)
    if (!new_keys.contains(key))
      differences.push_back({Difference::kOnlyInFirst, "log", "", std::get<3>(key)});
  for (const SettingKey& key : new_keys)
    if (!old_keys.contains(key))
      differences.push_back({Difference::kOnlyInSecond, "log", "", std::get<3>(key)});
  return {};
}

}  // namespace

const char* ToString(MissionDifference::Kind kind) {
  switch (kind) {
    case Difference::kOnlyInFirst:
      return "only in the first";
    case Difference::kOnlyInSecond:
      return "only in the second";
    case Difference::kDifferent:
      break;
  }
  return "different";
}

Result<Differences> DiffMissions(const MissionFile& first, const MissionFile& second,
                                 const RunContext& context) {
  Differences differences;
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, first.ListScans());
  FORESIGHT_TRY(const std::vector<ScanSummary> other_scans, second.ListScans());
  double done = 0.0;
  FORESIGHT_CHECK(
      Match("scan", scans, other_scans, differences,
            [&](const ScanSummary& a, const ScanSummary& b, const auto& tell) -> Status {
              if (context.Cancelled())
                return Fail(ErrorCode::kCancelled, "the comparison was cancelled");
              context.Report(done++ / static_cast<double>(scans.size()), "comparing scans");
              return CompareScans(first, second, a, b, tell);
            }));
  FORESIGHT_TRY(const std::vector<DetectionRecord> found, first.ListDetections());
  FORESIGHT_TRY(const std::vector<DetectionRecord> other_found, second.ListDetections());
  FORESIGHT_CHECK(Match("detection", found, other_found, differences,
                        [](const auto& a, const auto& b, const auto& tell) -> Status {
                          return CompareDetections(a, b, tell);
                        }));
  FORESIGHT_TRY(const std::vector<DepthRecord> depths, first.ListDepths());
  FORESIGHT_TRY(const std::vector<DepthRecord> other_depths, second.ListDepths());
  FORESIGHT_CHECK(Match("depth map", depths, other_depths, differences,
                        [](const auto& a, const auto& b, const auto& tell) -> Status {
                          return CompareDepths(a, b, tell);
                        }));
  FORESIGHT_TRY(const std::vector<NoteRecord> notes, first.ListNotes());
  FORESIGHT_TRY(const std::vector<NoteRecord> other_notes, second.ListNotes());
  FORESIGHT_CHECK(Match("note", notes, other_notes, differences,
                        [](const auto& a, const auto& b, const auto& tell) -> Status {
                          return CompareNotes(a, b, tell);
                        }));
  FORESIGHT_CHECK(CompareLogs(first, second, differences));
  return differences;
}

}  // namespace foresight
