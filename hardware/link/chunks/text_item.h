#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace foresight {

inline constexpr std::size_t kMostTextBytes = std::size_t{1} << 20;

/// A text (YAML, JSON), compressed. Fails with kInvalidInput for more than kMostTextBytes.
Result<std::string> EncodeText(std::string_view text);
/// Fails with kBadData, naming `what`.
Result<std::string> DecodeText(std::string_view bytes, const char* what);

}  // namespace foresight
