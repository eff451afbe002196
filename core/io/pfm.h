#pragma once

#include <filesystem>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

/// Reads a one-channel portable float map ('Pf'), of either byte order; infinite values and NaN are
/// kept. The file stores its rows from the bottom up, the image has them from the top down. Fails
/// with kIo, or with kBadData for a colour map ('PF'), a damaged header, a side above 20000 or
/// missing pixels.
Result<FloatImage> ReadPfm(const std::filesystem::path& path);

/// Writes a little-endian 'Pf' file, the whole file or nothing.
Status WritePfm(const std::filesystem::path& path, const FloatImage& image);

}  // namespace foresight
