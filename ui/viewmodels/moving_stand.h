#pragma once

#include <string>
#include <vector>

#include "core/calibration/calibration_session.h"

namespace foresight {

/// A stand of boards that goes to its places by itself, as that of a simulated world does; a real
/// one is carried.
class MovingStand {
 public:
  struct Place {
    std::string name;
    bool mount = true;  ///< false: it shows the single board, for the camera alone
  };

  MovingStand() = default;
  MovingStand(const MovingStand&) = delete;
  MovingStand& operator=(const MovingStand&) = delete;
  virtual ~MovingStand() = default;

  virtual const BoardMount& Mount() const = 0;
  virtual const CalibrationBoard& SingleBoard() const = 0;
  virtual const std::vector<Place>& Places() const = 0;
  /// Where it is, of Places(); -1 = away.
  virtual int At() const = 0;
  /// At once. @pre -1 <= place < number of places
  virtual void MoveTo(int place) = 0;
};

}  // namespace foresight
