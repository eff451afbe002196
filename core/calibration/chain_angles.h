#pragma once

#include "core/calibration/chain_state.h"

namespace foresight {

/// The plate's angle at a stop, or at a time of a sweep, as a state of the chain has it.
class PlateAngles {
 public:
  PlateAngles(const ChainData& data, const ChainState& state);

  /// NaN outside of the sweep's track.
  double At(int pose, int stop, int visit, double time_s) const;

 private:
  const ChainData& data_;
  const ChainState& state_;
  AngleCorrection correction_;
};

}  // namespace foresight
