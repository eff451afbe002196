#include "core/fitting/detection.h"

namespace foresight {

const char* ToString(VerdictLevel level) {
  switch (level) {
    case VerdictLevel::kUnsure:
      return "UNSURE";
    case VerdictLevel::kLikely:
      return "LIKELY";
    case VerdictLevel::kConfirmed:
      return "CONFIRMED";
  }
  return "UNSURE";
}

}  // namespace foresight
