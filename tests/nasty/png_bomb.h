#pragma once

#include <string>

namespace foresight::nasty {

enum class PngColor { kGray = 0, kPalette = 3, kRgbAlpha = 6 };

/// A PNG file of black pixels, whole and with right checksums: gigabytes in a megabyte.
/// @param rows how many of its rows are there; 0 = all.
std::string PngBomb(unsigned width, unsigned height, int bits, PngColor color, unsigned rows = 0);

}  // namespace foresight::nasty
