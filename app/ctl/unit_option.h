#pragma once

#include <string>

#include "core/base/result.h"

namespace foresight {

/// --unit: metres in a unit of a file's coordinates. Fails with kInvalidOptions for another text
/// than m, cm and mm.
inline Result<double> UnitFrom(const std::string& text) {
  if (text == "m") return 1.0;
  if (text == "cm") return 0.01;
  if (text == "mm") return 0.001;
  return Fail(ErrorCode::kInvalidOptions, "--unit '{}' is none of m, cm and mm", text);
}

}  // namespace foresight
