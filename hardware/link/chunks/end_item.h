#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/sensor/scan.h"

namespace foresight {

/// How a scan ended, and what it is made of.
struct ScanEnd {
  ScanState state = ScanState::kComplete;
  std::string reason;
  std::int64_t lines = 0;
  std::int64_t samples = 0;
  std::int64_t frames = 0;
  bool has_health = false;
  std::string digest;  ///< ScanDigest
  bool operator==(const ScanEnd&) const = default;
};

std::string EncodeEnd(const ScanEnd& end);
/// Fails with kBadData.
Result<ScanEnd> DecodeEnd(std::string_view bytes);

}  // namespace foresight
