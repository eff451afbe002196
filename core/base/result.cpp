#include "core/base/result.h"

namespace foresight {

const char* ToString(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidOptions:
      return "invalid options";
    case ErrorCode::kInvalidInput:
      return "invalid input";
    case ErrorCode::kBadData:
      return "bad data";
    case ErrorCode::kIo:
      return "file error";
    case ErrorCode::kDevice:
      return "device error";
    case ErrorCode::kState:
      return "not possible now";
    case ErrorCode::kTooFewPoints:
      return "too few points";
    case ErrorCode::kNoConvergence:
      return "no convergence";
    case ErrorCode::kCancelled:
      return "cancelled";
  }
  return "unknown error";
}

}  // namespace foresight
