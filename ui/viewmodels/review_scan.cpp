#include "ui/viewmodels/review_scan.h"

#include <algorithm>

#include "ui/viewmodels/mission_objects.h"
#include "ui/viewmodels/recording_view_model.h"

namespace foresight {
namespace {

/// A detection with what was done to it.
struct Listed {
  DetectionRecord record;
  std::vector<DetectionEvent> actions;
};

Result<std::vector<Listed>> DetectionsOf(const MissionFile& file, const std::string& scan_uuid) {
  FORESIGHT_TRY(std::vector<DetectionRecord> records, file.ListDetections());
  std::vector<Listed> listed;
  for (DetectionRecord& record : records) {
    if (record.scan_uuid != scan_uuid) continue;
    FORESIGHT_TRY(std::vector<DetectionEvent> actions, file.ListDetectionEvents(record.id));
    listed.push_back({std::move(record), std::move(actions)});
  }
  return listed;
}

/// What was decided in a review counts more than what the mission says of the same object; when it
/// was found, and what was done to it before, the mission knows.
std::vector<Listed> Join(std::vector<Listed> listed, std::vector<Listed> reviewed) {
  for (Listed& review : reviewed) {
    const auto same = std::find_if(listed.begin(), listed.end(), [&](const Listed& one) {
      return one.record.uuid == review.record.uuid;
    });
    if (same != listed.end()) {
      review.record.utc_ns = same->record.utc_ns;
      review.actions.insert(review.actions.begin(), same->actions.begin(), same->actions.end());
      listed.erase(same);
    }
    listed.push_back(std::move(review));
  }
  return listed;
}

}  // namespace

std::vector<FoundObject> ReviewedScan::Objects() const {
  std::vector<FoundObject> present;
  for (const ReviewedObject& one : objects)
    if (!one.deleted) present.push_back(one.object);
  return present;
}

std::filesystem::path ReviewFolder() {
  return RecordingViewModel::DefaultFolder().toStdString();
}

Result<ReviewedScan> LoadReviewedScan(const MissionFile& mission,
                                      const std::filesystem::path& folder,
                                      const ScanSummary& summary,
                                      std::shared_ptr<const Scan> known) {
  ReviewedScan loaded;
  loaded.scan = std::move(known);
  if (!loaded.scan) {
    FORESIGHT_TRY(Scan scan, mission.LoadScan(summary.id));
    loaded.scan = std::make_shared<const Scan>(std::move(scan));
  }
  FORESIGHT_TRY(std::vector<Listed> listed, DetectionsOf(mission, summary.uuid));
  FORESIGHT_TRY(const auto review, MissionFile::FindReviewOf(mission.path(), folder));
  if (review) {
    FORESIGHT_TRY(std::vector<Listed> reviewed, DetectionsOf(*review, summary.uuid));
    listed = Join(std::move(listed), std::move(reviewed));
  }
  for (Listed& one : listed) {
    ReviewedObject object;
    FORESIGHT_TRY(object.object, ObjectOf(one.record, loaded.scan->rig, BeginUtc_ns(*loaded.scan)));
    object.object.scan_uuid = summary.uuid;
    object.found_utc_ns = one.record.utc_ns;
    object.actions = std::move(one.actions);
    object.deleted = one.record.deleted;
    loaded.objects.push_back(std::move(object));
  }
  return loaded;
}

}  // namespace foresight
