#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

/// PNG files of every colour type. 16-bit samples are scaled to 8 bits, palettes are resolved,
/// alpha is dropped (not blended), no gamma is applied: equal numbers in the file stay equal. Fails
/// with kIo, or with kBadData where the bytes are damaged or a side is longer than 20000 pixels or
/// the image has more than 200 million.
Result<ColorImage> ReadPng(const std::filesystem::path& path);
/// Same; colours become luminance.
Result<GrayImage> ReadPngGray(const std::filesystem::path& path);
/// Numbers of a one-channel PNG of 16 bits as they are; any other PNG is refused.
Result<Image<std::uint16_t>> ReadPng16(const std::filesystem::path& path);

/// Same, from bytes in memory; `source` names them in an error.
Result<ColorImage> DecodePng(std::string_view bytes, const std::string& source);
Result<GrayImage> DecodePngGray(std::string_view bytes, const std::string& source);
Result<Image<std::uint16_t>> DecodePng16(std::string_view bytes, const std::string& source);

/// What a PNG is of. Both are lossless; each makes the other's files larger.
enum class PngContent {
  kDrawing,  ///< areas of one colour, which repeat: lines, maps, text
  kCapture,  ///< what a camera saw, with its noise
};

/// Lossless. Fails with kInvalidInput for an empty image or a side longer than 20000 pixels.
Result<std::string> EncodePng(const ColorImage& image, PngContent content = PngContent::kDrawing);
Result<std::string> EncodePng(const GrayImage& image);
Result<std::string> EncodePng16(const Image<std::uint16_t>& image);

/// Encodes and writes the whole file or nothing.
Status WritePng(const std::filesystem::path& path, const ColorImage& image,
                PngContent content = PngContent::kDrawing);
Status WritePng(const std::filesystem::path& path, const GrayImage& image);
Status WritePng16(const std::filesystem::path& path, const Image<std::uint16_t>& image);

}  // namespace foresight
