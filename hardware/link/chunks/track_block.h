#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/sensor/motor_track.h"
#include "hardware/link/chunks/chunk.h"

namespace foresight {

/// Up to kSamplesPerBlock motor samples, to the last bit. @pre not more
std::string EncodeTrackBlock(std::span<const MotorSample> samples);
/// Fails with kBadData, also where a value is not finite or time does not increase.
Result<std::vector<MotorSample>> DecodeTrackBlock(std::string_view bytes);

}  // namespace foresight
