#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace foresight {

/// Writes the whole file or nothing: to a neighbour first, then renamed over `path`. Fails with
/// kIo.
Status WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes);

/// The whole file. Fails with kIo, and with kBadData when it is larger than `limit_bytes`.
Result<std::string> ReadFile(const std::filesystem::path& path,
                             std::size_t limit_bytes = std::size_t{1} << 31);

}  // namespace foresight
