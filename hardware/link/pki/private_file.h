#pragma once

#include <filesystem>
#include <string_view>

#include "core/base/result.h"

namespace foresight {

/// Writes a file that only its owner can read (0600), whole or not at all: at no moment is there a
/// file of that name, or a part of one, that others can read. A file of that name is replaced.
/// Fails with kIo.
Status WritePrivateFile(const std::filesystem::path& path, std::string_view bytes);

/// Fails with kBadData where others than the owner may read or write the file.
Status CheckIsPrivate(const std::filesystem::path& path);

}  // namespace foresight
