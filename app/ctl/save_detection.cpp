#include "app/ctl/save_detection.h"

#include <chrono>

#include "core/detection/detection_json.h"

namespace foresight {

Status SaveDetection(MissionFile& mission, std::int64_t scan_id, const Detection& detection,
                     const SensorRig& rig) {
  DetectionRecord record;
  record.scan_id = scan_id;
  record.kind = KindOf(detection);
  record.utc_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(
                      std::chrono::system_clock::now().time_since_epoch())
                      .count();
  record.json = DetectionToJson(detection, rig.robot_from_base);
  FORESIGHT_CHECK(mission.AddDetection(record));
  return {};
}

}  // namespace foresight
