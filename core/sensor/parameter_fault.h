#pragma once

#include <string>
#include <string_view>

namespace foresight {

/// Which parameter of a camera has a value that no camera has, and why.
struct ParameterFault {
  std::string_view parameter;  ///< as in the rig's file; lives for ever
  std::string message;         ///< "k 3 is neither 0 (pinhole) nor in (0.05, 2)"
};

}  // namespace foresight
