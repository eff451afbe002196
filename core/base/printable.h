#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace foresight {

/// Text that a terminal, a log or a window can show: control characters (of ASCII and of Unicode),
/// and bytes that are no UTF-8, become \n, \t, \r or \xNN; everything else stays as it is. The
/// result is one line of valid UTF-8.
std::string Printable(std::string_view text);

/// The same for text of several lines: line feeds stay.
std::string PrintableLines(std::string_view text);

/// Where the first byte is that is no UTF-8; npos where all of it is.
std::size_t FirstInvalidUtf8(std::string_view text);

}  // namespace foresight
