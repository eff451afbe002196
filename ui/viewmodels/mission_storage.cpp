#include "ui/viewmodels/mission_storage.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "core/detection/detection_json.h"

namespace foresight {
namespace {

std::int64_t NowUtc_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

Status AppendScan(MissionFile* file, const Scan& scan, const RunContext& context) {
  FORESIGHT_TRY(const std::int64_t id, file->BeginScan(scan));
  const Status appended = file->Batch([&]() -> Status {
    for (std::size_t i = 0; i < scan.lines.size(); ++i) {
      FORESIGHT_CHECK(file->AppendLine(id, scan.lines[i]));
      context.Report(0.8 * static_cast<double>(i) / static_cast<double>(scan.lines.size()),
                     "writing lines");
    }
    FORESIGHT_CHECK(file->AppendMotorSamples(id, scan.track.samples()));
    for (const CameraFrame& frame : scan.frames) FORESIGHT_CHECK(file->AppendFrame(id, frame));
    return {};
  });
  FORESIGHT_CHECK(appended);
  return file->EndScan(id, scan.state, scan.reason);
}

Result<std::optional<std::int64_t>> IdOf(const MissionFile& file, const std::string& uuid) {
  FORESIGHT_TRY(const std::vector<ScanSummary> summaries, file.ListScans());
  for (const ScanSummary& summary : summaries)
    if (summary.uuid == uuid) return summary.id;
  return std::nullopt;
}

}  // namespace

Status AppendToMission(MissionFile* file, const std::vector<std::shared_ptr<const Scan>>& scans,
                       const std::vector<FoundObject>& objects, const RunContext& context) {
  for (const auto& scan : scans) {
    FORESIGHT_TRY(const auto id, IdOf(*file, scan->uuid));
    if (!id) FORESIGHT_CHECK(AppendScan(file, *scan, context));
  }
  for (const FoundObject& object : objects) {
    FORESIGHT_TRY(const auto id, IdOf(*file, object.scan_uuid));
    if (!id)
      return Fail(ErrorCode::kInvalidInput, "mission file {}: no scan {} for an object",
                  file->path().string(), object.scan_uuid);
    DetectionRecord record;
    record.scan_id = *id;
    record.kind = KindOf(object.detection);
    record.utc_ns = NowUtc_ns();
    record.json = DetectionToJson(object.detection, object.rig.robot_from_base);
    FORESIGHT_CHECK(file->AddDetection(record));
  }
  return {};
}

Result<std::vector<FoundObject>> ObjectsInMission(const MissionFile& file, std::int64_t scan_id,
                                                  const Scan& scan) {
  std::vector<FoundObject> objects;
  FORESIGHT_TRY(const std::vector<DetectionRecord> records, file.ListDetections());
  for (const DetectionRecord& record : records) {
    if (record.scan_id != scan_id) continue;
    FoundObject object;
    FORESIGHT_TRY(object.detection, DetectionFromJson(record.json));
    object.rig = scan.rig;
    object.scan_uuid = scan.uuid;
    object.scan_time = QDateTime::fromMSecsSinceEpoch(scan.start_utc_ns / 1'000'000);
    // An age that goes on where the mission's clock left it.
    object.found = std::chrono::steady_clock::now() -
                   std::chrono::nanoseconds(std::max<std::int64_t>(0, NowUtc_ns() - record.utc_ns));
    objects.push_back(std::move(object));
  }
  return objects;
}

}  // namespace foresight
