#pragma once

#include <string>
#include <vector>

#include "core/registration/register_scan.h"
#include "core/sensor/scan.h"

namespace foresight {

/// What a cloud and images do not say of the scan that they were exported from: scan.json of an
/// export, /foresight/scan of a bag.
struct ScanRecord {
  std::string scan_uuid;
  std::int64_t start_utc_ns = 0;
  std::string source;
  bool simulated = false;
  SensorRig rig;
  int lines = 0;
  int beams = 0;
  std::vector<Eigen::Vector3f> origins;  ///< one a line, in base; NaN = not known
  std::vector<CameraFrame> images;       ///< in their order, without pixels
};

/// @param cloud of this scan
std::string ScanRecordToJson(const Scan& scan, const RegisteredScan& cloud);
/// Fails with kBadData, naming `source`.
Result<ScanRecord> ScanRecordFromJson(const std::string& json, const std::string& source);

}  // namespace foresight
