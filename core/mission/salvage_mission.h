#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/sensor/scan.h"

namespace foresight {

/// What was saved of one scan. -1 = it is not known how many there were: the scan had not ended, or
/// its own row is lost.
struct SalvagedScan {
  std::int64_t id = 0;
  std::string uuid;  ///< empty = its own row is lost
  ScanState state = ScanState::kInterrupted;
  bool saved =
      false;  ///< false: what was found of it could not be put into a mission, see `losses`
  std::int64_t lines = 0;
  std::int64_t lines_before = -1;
  std::int64_t images = 0;
  std::int64_t images_before = -1;
};

struct SalvageReport {
  std::vector<SalvagedScan> scans;
  std::int64_t detections = 0;
  std::int64_t depth_maps = 0;
  std::int64_t notes = 0;  ///< states of notes and measurements
  std::int64_t events = 0;
  /// What is missing, one sentence each. Empty: the file was whole.
  std::vector<std::string> losses;
};

struct SalvageOptions {
  /// Of scans whose own rig is lost; without it such scans are left out and told about.
  std::optional<SensorRig> rig;
};

/// Reads a mission file page by page, however damaged, and writes a new one with every row whose
/// checksum is good. A scan that is whole is the same to the last bit. One that misses lines, motor
/// samples or images becomes interrupted and says how many; its images keep their order, and depth
/// maps and fits of those that moved name the new positions. `damaged` is only read; `target` is
/// written whole or not at all. Fails with kIo, with kBadData where nothing can be saved, and with
/// kCancelled. O(size of the file), with every byte of damaged pages tried as a row's beginning.
Result<SalvageReport> SalvageMission(const std::filesystem::path& damaged,
                                     const std::filesystem::path& target,
                                     const SalvageOptions& options, const RunContext& context);

}  // namespace foresight
