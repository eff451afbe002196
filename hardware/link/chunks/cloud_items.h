#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/registration/register_scan.h"
#include "core/sensor/scan.h"
#include "hardware/link/chunks/chunk.h"

namespace foresight {

/// How a cloud thins out the lines: of each block of kLinesPerCloudBlock lines.
struct CloudStep {
  int lines = 32;
  int beams = 8;
  bool operator==(const CloudStep&) const = default;
};
inline constexpr int kLinesPerCloudBlock = 64;
inline constexpr CloudStep kCoarseStep{32, 8};
inline constexpr CloudStep kFineStep{4, 2};
inline constexpr int kCloudUnit_mm = 10;

/// A line of a cloud. It can be put into base without the motor's track.
struct CloudLine {
  std::int64_t seq = 0;
  double time_s = 0.0;
  float first_rad = 0.0f;               ///< motor's angle at beam 0; NaN where the track has none
  float last_rad = 0.0f;                ///< at the last beam
  int beams = 0;                        ///< of the line
  std::vector<std::uint16_t> range_mm;  ///< of every step-th beam, in steps of 10 mm; 0 = no return
  bool operator==(const CloudLine&) const = default;
};
struct CloudBlock {
  CloudStep step;
  std::vector<CloudLine> lines;
};

/// How many blocks of the scan nothing that comes later changes.
std::int64_t CloudBlocksOf(const Scan& scan, const CloudStep& step);
/// @pre block < CloudBlocksOf
Result<std::string> EncodeCloudBlock(const Scan& scan, std::int64_t block, const CloudStep& step);
/// Fails with kBadData.
Result<CloudBlock> DecodeCloudBlock(std::string_view bytes);

/// Lines of clouds in base.
struct PlacedCloud {
  RegisteredScan points;           ///< on the grid of the rig's beams
  std::vector<std::int64_t> seqs;  ///< of its lines
};
/// A line with another number of beams than the rig's lidar is left out.
PlacedCloud RegisterCloud(const std::vector<const CloudBlock*>& blocks, const SensorRig& rig);

}  // namespace foresight
