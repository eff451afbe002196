#include "core/mission/new_records.h"

#include <pwd.h>
#include <unistd.h>

#include <chrono>

#include "core/base/utc_text.h"
#include "core/detection/detection_json.h"
#include "core/mission/depth_numbers.h"

namespace foresight {

std::string OperatorName() {
  const passwd* account = getpwuid(getuid());
  return account != nullptr && account->pw_name != nullptr ? account->pw_name : "operator";
}

DetectionRecord NewDetectionRecord(const Scan& scan, const Detection& detection,
                                   const Provenance& provenance) {
  DetectionRecord record;
  record.scan_uuid = scan.uuid;
  record.kind = KindOf(detection);
  record.utc_ns = NowUtc_ns();
  record.author = OperatorName();
  record.json = DetectionToJson(detection, scan.rig.robot_from_base);
  record.provenance_json = ProvenanceToJson(provenance);
  return record;
}

Result<DepthRecord> NewDepthRecord(const Scan& scan, const DepthResult& depth,
                                   const MaskImage& mask, const ConfidenceMaskOptions& options) {
  FORESIGHT_TRY(const Provenance provenance, ProvenanceOfDepth(scan, depth, options));
  DepthRecord record;
  record.scan_uuid = scan.uuid;
  record.image_position = provenance.image_position;
  record.utc_ns = NowUtc_ns();
  record.author = OperatorName();
  record.provenance_json = ProvenanceToJson(provenance);
  record.digest = DigestOf(depth.dense, mask);
  record.statistics = StatisticsOf(depth.dense, mask);
  return record;
}

}  // namespace foresight
