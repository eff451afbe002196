#pragma once

#include <string>
#include <string_view>

namespace foresight {

/// Text as it stands between tags or in a quoted attribute of HTML and SVG: & < > " are escaped.
std::string EscapeMarkup(std::string_view text);

}  // namespace foresight
