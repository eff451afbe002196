#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace foresight {

/// Where two JSON texts differ, leaf by leaf: "/pose/position_m/0: was 1.2, is 1.3". Members named
/// in `except` (of the outermost objects) are not looked at. Text that is no JSON is compared
/// whole.
std::vector<std::string> JsonDifferences(std::string_view was, std::string_view is,
                                         const std::vector<std::string>& except = {});

}  // namespace foresight
