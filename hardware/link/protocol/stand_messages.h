#pragma once

#include <vector>

#include "hardware/api/moving_stand.h"
#include "sensor_head.pb.h"

namespace foresight {

/// What does not change of a head's moving stand, and where it is.
struct StandDescription {
  BoardMount mount;
  CalibrationBoard single_board;
  std::vector<MovingStand::Place> places;
  int at = -1;
};

link::StandReply ToMessage(const MovingStand& stand);
/// Fails with kBadData, naming what is wrong.
Result<StandDescription> FromMessage(const link::StandReply& message);

}  // namespace foresight
