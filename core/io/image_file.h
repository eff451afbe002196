#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

/// The grey values of a PNG, JPEG or binary PGM file; its first bytes tell which it is. Colours
/// become luminance; a rotation that a JPEG's EXIF tag asks for is not applied: pixels are where
/// the sensor has them. Fails with kIo, or with kBadData where the bytes are damaged or of another
/// format, or a side is longer than 20000 pixels or the image has more than 200 million.
Result<GrayImage> ReadImageGray(const std::filesystem::path& path);

/// Same, from bytes in memory; `source` names them in an error.
Result<GrayImage> DecodeImageGray(std::string_view bytes, const std::string& source);

/// A JPEG alone. A file that ends early is refused, not filled up with grey.
Result<GrayImage> DecodeJpegGray(std::string_view bytes, const std::string& source);

/// Whether ReadImageGray may know a file of this name: .png, .jpg, .jpeg, .pgm in any case.
bool HasImageExtension(const std::filesystem::path& path);

}  // namespace foresight
