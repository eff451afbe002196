#pragma once

#include "core/base/result.h"

namespace foresight {

/// What a program tells its caller by its exit code.
enum class ExitCode : int {
  kDone = 0,      ///< done, with a positive result where there is one
  kNegative = 1,  ///< done, but: no object, bad quality
  kUsage = 2,     ///< the command line makes no sense
  kBadData = 3,   ///< a file or a device failed
};

inline ExitCode ExitCodeFor(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidOptions:
      return ExitCode::kUsage;
    case ErrorCode::kTooFewPoints:
    case ErrorCode::kNoConvergence:
      return ExitCode::kNegative;
    default:
      return ExitCode::kBadData;
  }
}

}  // namespace foresight
