#pragma once

#include <algorithm>
#include <vector>

#include "core/objects/solid_part.h"

namespace foresight {

/// The first part of that name; null where there is none.
inline SolidPart* NamedPart(std::vector<SolidPart>& parts, const char* name) {
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [&](const SolidPart& part) { return part.name == name; });
  return found == parts.end() ? nullptr : &*found;
}
inline const SolidPart* NamedPart(const std::vector<SolidPart>& parts, const char* name) {
  return NamedPart(const_cast<std::vector<SolidPart>&>(parts), name);
}

}  // namespace foresight
