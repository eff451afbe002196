#pragma once

#include <string>
#include <vector>

#include "core/objects/board_mount.h"

namespace foresight {

/// A stand of boards that goes to its places by itself, as that of a simulated world does, here or
/// at the far end of a link; a real one is carried. Safe from any thread.
class MovingStand {
 public:
  struct Place {
    std::string name;
    bool mount = true;  ///< false: it shows the single board, for the camera alone
    bool operator==(const Place&) const = default;
  };

  MovingStand() = default;
  MovingStand(const MovingStand&) = delete;
  MovingStand& operator=(const MovingStand&) = delete;
  virtual ~MovingStand() = default;

  virtual const BoardMount& Mount() const = 0;
  virtual const CalibrationBoard& SingleBoard() const = 0;
  virtual const std::vector<Place>& Places() const = 0;
  /// Where it is, of Places(); -1 = away. While it moves, where it was.
  virtual int At() const = 0;
  /// Returns at once; the stand is there when it does not move any more, and had no trouble.
  /// @pre -1 <= place < number of places
  virtual void MoveTo(int place) = 0;
  /// It was told to go, and whether it is there is not known yet.
  virtual bool Moving() const { return false; }
  /// Why it did not go where it was told last; empty when it did, or is on its way.
  virtual std::string Trouble() const { return {}; }
};

}  // namespace foresight
