#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/sensor/scan.h"

namespace foresight {

/// What is known of a scan when it starts, but the rig.
struct ScanHeader {
  std::string uuid;
  std::int64_t start_utc_ns = 0;
  std::string source;
  bool simulated = false;
  ScanPlan plan;
  std::string rig_id;      ///< RigId
  std::string rig_digest;  ///< SHA-256 of the rig's YAML: rigs of one RigId may have other names
  bool operator==(const ScanHeader&) const = default;
};

std::string EncodeHeader(const Scan& scan);
/// Fails with kBadData.
Result<ScanHeader> DecodeHeader(std::string_view bytes);

}  // namespace foresight
