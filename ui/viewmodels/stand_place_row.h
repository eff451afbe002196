#pragma once

#include <QString>
#include <limits>
#include <vector>

namespace foresight {

/// One stop of the motor at one place of the stand, as a lamp shows it.
struct StopLamp {
  enum class State {
    kWaiting,  ///< not captured yet
    kLooking,  ///< captured; the boards are being looked for
    kNoImage,
    kNoBoard,
    kOneBoard,
    kBothBoards,  ///< all that the stand has
    kExcluded     ///< by the operator
  };
  double motor_rad = 0.0;
  int number = -1;  ///< of the stops in the session's index; -1 = not captured yet
  State state = State::kWaiting;
  bool has_lines = false;
  double rms_px = std::numeric_limits<double>::quiet_NaN();  ///< under the solution
  QString fault = {};       ///< why a board is missing, where the image says it
  bool stands_out = false;  ///< its rms is far above that of the others
};

/// One place of the stand.
struct StandPlaceRow {
  enum class Sweep { kNone, kThere, kExcluded };

  QString name;
  bool excluded = false;
  std::vector<StopLamp> stops = {};  ///< planned and captured, by angle
  Sweep sweep = Sweep::kNone;
  int sweep_number = -1;
};

/// One image of a single board for the camera alone.
struct BoardImageRow {
  enum class State { kLooking, kUsed, kNoBoard, kLeftOut, kExcluded };
  QString file;
  QString origin;
  State state = State::kLooking;
  QString fault = {};  ///< why the board is missing, where the image says it
  double rms_px = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace foresight
