#pragma once

#include <span>
#include <string_view>

namespace foresight {

/// A resource that was made part of the program when it was built (foresight_embed in
/// packaging/cmake), so that a result never depends on where the program was started.
struct EmbeddedFile {
  std::string_view name;  ///< from the project's root
  std::string_view text;
};

}  // namespace foresight
