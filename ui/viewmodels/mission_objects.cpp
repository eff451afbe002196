#include "ui/viewmodels/mission_objects.h"

#include <algorithm>

#include "core/base/utc_text.h"
#include "core/detection/candidates.h"
#include "core/detection/detection_json.h"
#include "core/mission/complete_scan.h"
#include "core/mission/provenance.h"

namespace foresight {

DetectionRecord RecordOf(const FoundObject& object, const std::string& author) {
  DetectionRecord record;
  record.uuid = object.uuid;
  record.scan_uuid = object.scan_uuid;
  record.kind = KindOf(object.detection);
  record.utc_ns = NowUtc_ns();
  record.author = author;
  record.json = DetectionToJson(object.detection, object.rig.robot_from_base);
  record.provenance_json = object.provenance_json;
  return record;
}

DetectionEvent EventOf(const ObjectEvent& event, const std::string& author) {
  DetectionEvent kept;
  kept.utc_ns = NowUtc_ns();
  kept.author = author;
  kept.action = event.action;
  kept.text = event.text.toStdString();
  return kept;
}

Result<FoundObject> ObjectOf(const DetectionRecord& record, const SensorRig& rig,
                             std::int64_t scan_begin_utc_ns) {
  FoundObject object;
  FORESIGHT_TRY(object.detection, DetectionFromJson(record.json));
  object.rig = rig;
  object.uuid = record.uuid;
  object.scan_uuid = record.scan_uuid;
  object.scan_time = QDateTime::fromMSecsSinceEpoch(scan_begin_utc_ns / 1'000'000);
  // An age that goes on where the mission's clock left it.
  object.found = std::chrono::steady_clock::now() -
                 std::chrono::nanoseconds(std::max<std::int64_t>(0, NowUtc_ns() - record.utc_ns));
  object.name = QString::fromStdString(record.name);
  object.decision = record.decision;
  object.decided_candidate =
      std::clamp(record.decided_candidate, 0, std::max(0, CandidateCount(object.detection) - 1));
  object.provenance_json = record.provenance_json;
  if (const auto made = ProvenanceFromJson(record.provenance_json, record.uuid))
    object.part = made->part;
  object.kept = true;
  return object;
}

Status KeepObject(MissionFile* file, const FoundObject& object, const std::string& author) {
  DetectionRecord record = RecordOf(object, author);
  FORESIGHT_TRY(const auto scan_id, file->FindScan(object.scan_uuid));
  record.scan_id = scan_id.value_or(0);
  FORESIGHT_CHECK(file->AddDetection(record));
  return {};
}

Status KeepObjectEvent(MissionFile* file, const ObjectEvent& event, const std::string& author) {
  FORESIGHT_TRY(const auto id, file->FindDetection(event.uuid));
  if (!id)
    return Fail(ErrorCode::kInvalidInput, "mission file {}: no object {}", file->path().string(),
                event.uuid);
  return file->AddDetectionEvent(*id, EventOf(event, author));
}

Status KeepNote(MissionFile* file, NoteRecord note) {
  note.scan_id = 0;  // that of another file, perhaps
  FORESIGHT_CHECK(file->AddNote(note));
  return {};
}

Status KeepCheck(MissionFile* file, const KeptCheck& check) {
  FORESIGHT_TRY(const auto scan_id, file->FindScan(check.scan_uuid));
  if (!scan_id)
    return Fail(ErrorCode::kInvalidInput, "mission file {}: no scan {}", file->path().string(),
                check.scan_uuid);
  return AddScanCheck(*file, check);
}

Status KeepDepth(MissionFile* file, const Scan& scan, const DepthResult& depth) {
  FORESIGHT_TRY(DepthRecord record, NewDepthRecord(scan, depth, depth.mask, depth.options.mask));
  FORESIGHT_TRY(const auto scan_id, file->FindScan(scan.uuid));
  if (!scan_id)
    return Fail(ErrorCode::kInvalidInput, "mission file {}: no scan {}", file->path().string(),
                scan.uuid);
  record.scan_id = *scan_id;
  FORESIGHT_CHECK(file->AddDepth(record));
  return {};
}

Status AppendScan(MissionFile* file, const Scan& scan, const RunContext& context) {
  FORESIGHT_TRY(const auto known, file->FindScan(scan.uuid));
  if (known) {
    FORESIGHT_TRY(const bool whole, HoldsAllOf(*file, *known, scan));
    if (whole) return {};
  }
  FORESIGHT_CHECK(CompleteScan(*file, scan, context));
  return {};
}

}  // namespace foresight
