#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/sensor/lidar_line.h"
#include "hardware/link/chunks/chunk.h"

namespace foresight {

/// Lossless codec of blocks of up to kLinesPerBlock consecutive lines (docs/protocols.md): each
/// value is predicted from the beam before and the line before, differences go as planes of low and
/// of high bytes. Any value, number of beams and seq survives, times to the last bit.

inline constexpr std::size_t kMostBeamsOfALine = 100'000;

/// Lines without their intensities. Fails with kInvalidInput for more lines than a block has, or
/// more beams than kMostBeamsOfALine.
Result<std::string> EncodeRanges(std::span<const LidarLine* const> lines);
/// Fails with kBadData; takes no more memory than kLinesPerBlock lines of kMostBeamsOfALine beams.
Result<std::vector<LidarLine>> DecodeRanges(std::string_view bytes);

/// Of each line of a block; empty where the line has none.
using IntensityBlock = std::vector<std::vector<std::uint16_t>>;
Result<std::string> EncodeIntensities(std::span<const LidarLine* const> lines);
Result<IntensityBlock> DecodeIntensities(std::string_view bytes);

}  // namespace foresight
