#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/sensor/lidar_line.h"

namespace foresight {

/// How a line's ranges and intensities are packed; the number stands in the mission file.
enum class LineCodec : std::int64_t {
  /// Each channel as differences from beam to beam, zigzag, low bytes then high bytes; then zlib.
  kDeltaPlanesZlib = 1,
};

/// A line's values as stored, without its number and time.
struct PackedLine {
  LineCodec codec = LineCodec::kDeltaPlanesZlib;
  std::int64_t beams = 0;
  bool has_intensity = false;
  std::string bytes;
};

/// Fails with kInvalidInput when there are more than 100000 beams, or intensities that are not one
/// a beam.
Result<PackedLine> PackLine(const LidarLine& line);

/// Fills range and intensity of `line`, exactly as they were packed. Fails with kBadData where the
/// bytes are not what PackLine makes for that many beams.
Status UnpackLine(const PackedLine& packed, LidarLine& line);

}  // namespace foresight
