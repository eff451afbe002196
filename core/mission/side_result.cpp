#include "core/mission/side_result.h"

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "core/base/utc_text.h"
#include "core/depth/depth_method.h"
#include "core/depth/depth_option_table.h"
#include "core/detection/fit_option_table.h"
#include "core/io/json_reader.h"
#include "core/mission/new_records.h"
#include "core/mission/provenance.h"
#include "core/mission/record_events.h"
#include "core/options/option_json.h"
#include "core/options/option_text.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr const char* kEventSource = "side result";
constexpr const char* kChangeSource = "side result change";
constexpr const char* kRenamed = "renamed";
constexpr const char* kDeleted = "deleted";
constexpr const char* kRestored = "restored";

std::string ToJson(const SideResult& result) {
  // The answer stays a text: what is read back is what was written, to the last bit.
  return RecordEventJson({{"format", 1},
                          {"uuid", result.uuid},
                          {"scan_uuid", result.scan_uuid},
                          {"author", result.author},
                          {"depth_maps", result.depth_uuids},
                          {"detections", result.detection_uuids},
                          {"answer", result.answer_json}});
}

SideResult SideResultFrom(const EventRecord& event) {
  const nlohmann::json value = ParseJson(event.json);
  SideResult result;
  result.name = event.text;
  result.utc_ns = event.utc_ns;
  value.at("uuid").get_to(result.uuid);
  value.at("scan_uuid").get_to(result.scan_uuid);
  value.at("author").get_to(result.author);
  value.at("depth_maps").get_to(result.depth_uuids);
  value.at("detections").get_to(result.detection_uuids);
  value.at("answer").get_to(result.answer_json);
  const nlohmann::json answer = ParseJson(result.answer_json);
  answer.at("rig_id").get_to(result.rig_id);
  answer.at("other_rig").get_to(result.other_rig);
  const auto depth = DepthOptionsFromJson(answer.at("depth_options").dump());
  if (!depth) throw std::invalid_argument(depth.error().message);
  result.depth = *depth;
  return result;
}

void ApplyChange(const EventRecord& event, std::vector<SideResult>& results) {
  const nlohmann::json value = ParseJson(event.json);
  const auto uuid = value.at("uuid").get<std::string>();
  const auto action = value.at("action").get<std::string>();
  for (SideResult& result : results) {
    if (result.uuid != uuid) continue;
    if (action == kRenamed)
      result.name = event.text;
    else if (action == kDeleted || action == kRestored)
      result.deleted = action == kDeleted;
    else
      throw std::invalid_argument(fmt::format("'{}' is no change of a side result", action));
  }
}

/// Of all scans, deleted ones too.
Result<std::vector<SideResult>> AllSideResults(std::initializer_list<const MissionFile*> files) {
  std::vector<SideResult> results;
  for (const MissionFile* file : files) {
    if (file == nullptr) continue;
    FORESIGHT_CHECK(
        ReadRecordEvents(*file, "side result", IsSideResult, [&](const EventRecord& event) {
          if (event.source == kEventSource)
            results.push_back(SideResultFrom(event));
          else
            ApplyChange(event, results);
        }));
  }
  return results;
}

Status Change(MissionFile& review, const std::string& uuid, const char* action,
              const std::string& name) {
  const std::string json = RecordEventJson(
      {{"format", 1}, {"uuid", uuid}, {"author", OperatorName()}, {"action", action}});
  FORESIGHT_CHECK(review.AddEvent({0, NowUtc_ns(), kChangeSource, "info", name, json}));
  return {};
}

/// The fits' part of what differs.
std::vector<std::string> FitDifferences(const std::string& answer_json) {
  std::vector<std::string> words;
  const nlohmann::json answer = nlohmann::json::parse(answer_json, nullptr, false);
  if (!answer.is_object()) return words;
  if (answer.contains("source"))
    words.push_back("fits to " + answer.at("source").get<std::string>());
  if (!answer.contains("fit_options")) return words;
  for (const auto& [name, options] : answer.at("fit_options").items()) {
    const auto kind = ObjectKindFromString(name);
    if (!kind) continue;
    const auto values = KeyedValuesFromJson(options.dump(), [&](const std::string& key) {
      const Option<FitOptions>* option = FindOption(FitOptionTable(*kind), key);
      return option == nullptr ? nullptr : &option->info;
    });
    if (!values) continue;
    for (const auto& [key, value] : *values) {
      const OptionInfo& info = FindOption(FitOptionTable(*kind), key)->info;
      words.push_back(fmt::format("{}: {} {}", name, info.title, OptionInWords(info, value)));
    }
  }
  return words;
}

}  // namespace

Result<SideResult> KeepSideResult(MissionFile& review, const std::string& name, const Scan& scan,
                                  const RunAgainSettings& settings, const RunAgainAnswer& answer) {
  if (name.empty()) return Fail(ErrorCode::kInvalidInput, "a side result needs a name");
  SideResult result;
  result.uuid = NewUuid();
  result.name = name;
  result.scan_uuid = scan.uuid;
  result.author = OperatorName();
  result.utc_ns = NowUtc_ns();
  result.rig_id = RigId(settings.rig ? *settings.rig : scan.rig);
  result.other_rig = settings.rig.has_value();
  result.depth = settings.depth;
  result.answer_json = answer.json;
  FORESIGHT_TRY(const std::optional<std::int64_t> scan_id, review.FindScan(scan.uuid));
  const auto add = [&](auto record, std::vector<std::string>& uuids) {
    record.uuid = NewUuid();
    record.scan_id = scan_id.value_or(0);
    uuids.push_back(record.uuid);
    return record;
  };
  const Status kept = review.Batch([&]() -> Status {
    if (settings.rig) FORESIGHT_CHECK(review.AddRig(*settings.rig));
    for (const DepthRecord& record : answer.depth_records)
      FORESIGHT_CHECK(review.AddDepth(add(record, result.depth_uuids)));
    // The event comes before the fits: whoever sees one of them knows whose it is.
    std::vector<DetectionRecord> fits;
    for (const DetectionRecord& record : answer.detection_records)
      fits.push_back(add(record, result.detection_uuids));
    FORESIGHT_CHECK(
        review.AddEvent({0, result.utc_ns, kEventSource, "info", name, ToJson(result)}));
    for (const DetectionRecord& record : fits) FORESIGHT_CHECK(review.AddDetection(record));
    return {};
  });
  FORESIGHT_CHECK(kept);
  return result;
}

bool IsSideResult(const EventRecord& event) {
  return event.source == kEventSource || event.source == kChangeSource;
}

Result<std::vector<SideResult>> ListSideResults(const MissionFile& file,
                                                const std::string& scan_uuid) {
  return SideResultsOf(file, nullptr, scan_uuid);
}

Result<std::vector<SideResult>> SideResultsOf(const MissionFile& mission, const MissionFile* review,
                                              const std::string& scan_uuid) {
  FORESIGHT_TRY(std::vector<SideResult> results, AllSideResults({&mission, review}));
  std::erase_if(results, [&](const SideResult& result) {
    return result.deleted || (!scan_uuid.empty() && result.scan_uuid != scan_uuid);
  });
  return results;
}

Status RenameSideResult(MissionFile& review, const std::string& uuid, const std::string& name) {
  if (name.empty()) return Fail(ErrorCode::kInvalidInput, "a side result needs a name");
  return Change(review, uuid, kRenamed, name);
}

Status DeleteSideResult(MissionFile& review, const std::string& uuid) {
  return Change(review, uuid, kDeleted, {});
}

Status RestoreSideResult(MissionFile& review, const std::string& uuid) {
  return Change(review, uuid, kRestored, {});
}

Result<std::set<std::string>> DetectionsOfSideResults(const MissionFile& file) {
  FORESIGHT_TRY(const std::vector<SideResult> results, AllSideResults({&file}));
  std::set<std::string> uuids;
  for (const SideResult& result : results)
    uuids.insert(result.detection_uuids.begin(), result.detection_uuids.end());
  return uuids;
}

Result<std::vector<DetectionRecord>> DetectionsOfScan(const MissionFile& mission,
                                                      const MissionFile* review,
                                                      const std::string& scan_uuid) {
  std::vector<DetectionRecord> all;
  std::set<std::string> of_side_results;
  for (const MissionFile* file : {&mission, review}) {
    if (file == nullptr) continue;
    FORESIGHT_TRY(const std::set<std::string> of_file, DetectionsOfSideResults(*file));
    of_side_results.insert(of_file.begin(), of_file.end());
    FORESIGHT_TRY(const std::vector<DetectionRecord> records, file->ListDetections());
    for (const DetectionRecord& record : records) {
      if (record.scan_uuid != scan_uuid) continue;
      std::erase_if(all, [&](const DetectionRecord& other) { return other.uuid == record.uuid; });
      all.push_back(record);
    }
  }
  std::erase_if(
      all, [&](const DetectionRecord& record) { return of_side_results.contains(record.uuid); });
  return all;
}

Result<std::vector<NoteRecord>> NotesOfMission(const MissionFile& mission,
                                               const MissionFile* review) {
  FORESIGHT_TRY(std::vector<NoteRecord> notes, mission.ListNotes());
  if (review == nullptr) return notes;
  FORESIGHT_TRY(const std::vector<NoteRecord> later, review->ListNotes());
  notes.insert(notes.end(), later.begin(), later.end());
  return CurrentNotes(notes);
}

Result<DepthOptions> OriginalDepthOptions(const MissionFile& mission, std::int64_t scan_id,
                                          std::int64_t image_position) {
  FORESIGHT_TRY(const std::vector<DepthRecord> depths, mission.ListDepths(scan_id));
  FORESIGHT_TRY(const std::vector<SideResult> results, AllSideResults({&mission}));
  const auto is_original = [&](const DepthRecord& record) {
    return std::none_of(results.begin(), results.end(), [&](const SideResult& result) {
      return std::count(result.depth_uuids.begin(), result.depth_uuids.end(), record.uuid) > 0;
    });
  };
  const DepthRecord* last = nullptr;
  for (const DepthRecord& record : depths) {
    if (!is_original(record)) continue;
    const bool better = last == nullptr || record.image_position == image_position ||
                        last->image_position != image_position;
    if (better) last = &record;
  }
  if (last == nullptr) return DefaultsOf(DepthMethod::kForesight);
  FORESIGHT_TRY(const Provenance provenance,
                ProvenanceFromJson(last->provenance_json, "depth map " + last->uuid));
  if (!provenance.depth)
    return Fail(ErrorCode::kBadData, "depth map {}: its provenance names no options", last->uuid);
  return *provenance.depth;
}

std::vector<std::string> DifferencesInWords(const DepthOptions& options, const DepthOptions& than) {
  std::vector<std::string> words;
  const bool same_method = options.method == than.method;
  if (!same_method)
    words.push_back(fmt::format("method {} instead of {}", InfoOf(options.method).name,
                                InfoOf(than.method).name));
  const DepthOptions base = same_method ? than : DefaultsOf(options.method);
  for (const Option<DepthOptions>& option : DepthOptionTable()) {
    if (!option.AppliesTo(options)) continue;
    const OptionValue value = option.get(options), usual = option.get(base);
    if (value == usual) continue;
    words.push_back(fmt::format("{} {} instead of {}", option.info.title,
                                OptionInWords(option.info, value),
                                OptionInWords(option.info, usual)));
  }
  return words;
}

std::vector<std::string> DifferencesInWords(const SideResult& result, const DepthOptions& original,
                                            const SensorRig& own_rig) {
  std::vector<std::string> words = DifferencesInWords(result.depth, original);
  if (result.other_rig)
    words.push_back(
        fmt::format("rig {} instead of {}", result.rig_id.substr(0, 8), ShortRigId(own_rig)));
  for (std::string& word : FitDifferences(result.answer_json)) words.push_back(std::move(word));
  return words;
}

}  // namespace foresight
