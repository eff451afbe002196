#pragma once

#include <cstdint>

#include "core/base/random.h"

namespace foresight {

/// What simulated noise is drawn for. The numbers are part of what a seed means: append only.
enum class NoisePurpose : std::uint64_t {
  kMotorPhases = 1,
  kLidarJitter = 2,
  kLidarLine = 3,
  kImageJitter = 4,
  kImageRow = 5,
  kPixelGain = 6,
  kCalibrationError = 7,
  kDrawnRegion = 8,
};

/// The generator of one purpose, of one line or image, of one row: whoever draws first, and on
/// which thread, changes nothing.
inline Random NoiseStream(std::uint64_t seed, NoisePurpose purpose, std::int64_t seq = 0,
                          int row = 0) {
  std::uint64_t stream = static_cast<std::uint64_t>(purpose);
  for (const std::uint64_t word :
       {static_cast<std::uint64_t>(seq), static_cast<std::uint64_t>(row)}) {
    stream = (stream ^ word) * 0x9e3779b97f4a7c15ULL;
    stream ^= stream >> 29;
  }
  return {seed, stream};
}

}  // namespace foresight
