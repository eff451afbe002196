#pragma once

#include "core/base/result.h"

namespace foresight {

/// A pole, a pipe, a bottle: the part of it that was seen.
struct CylinderModel {
  double radius_m = 0.0;
  double length_m = 0.0;  ///< of what lies in the region; it may go on

  /// Fails with kInvalidOptions: a size that is not within 0 to kLargest_m.
  Status Check() const;
  static constexpr double kLargest_m = 10.0;
};

}  // namespace foresight
