#pragma once

#include <functional>
#include <vector>

#include "core/base/result.h"
#include "hardware/motor/cia402.h"

namespace foresight {

/// Registers to write in one go.
struct DriveWrite {
  std::uint16_t first;
  std::vector<std::uint16_t> values;
};
using DriveWrites = std::vector<DriveWrite>;

/// Something that a drive does in stages, each of which shows in what it says of itself. No
/// transport and no thread: whoever polls the drive lets it step.
class DriveProcedure {
 public:
  struct Stage {
    const char* goal;  ///< completes "did not ... within"
    double timeout_s;
    bool needs_power;  ///< fails as soon as the drive is not in operation enabled
    /// Writes at the begin of the stage.
    std::function<void(DriveWrites&)> begin;
    /// Whether the goal is reached; may write more. Sees only what the drive said after `begin`.
    std::function<Result<bool>(const cia402::TxImage&, DriveWrites&)> reached;
  };

  explicit DriveProcedure(std::vector<Stage> stages);

  /// With what the drive says at `time_s`: appends what is to be written now. True when the last
  /// goal is reached. Errors are kDevice without the address.
  Result<bool> Step(double time_s, const cia402::TxImage& drive, DriveWrites& writes);

 private:
  std::vector<Stage> stages_;
  std::size_t at_ = 0;
  bool begun_ = false;
  double deadline_s_ = 0.0;
};

/// Speeds and lengths in the drive's counts.
struct HomingProfile {
  int method = 20;
  std::int32_t search_speed = 0;
  std::int32_t edge_speed = 0;
  std::int32_t acceleration = 0;
  /// The switch comes back on within this of where it went off, or homing fails.
  std::int32_t edge_window = 1000;
  double timeout_s = 60.0;
};
struct MoveProfile {
  std::int32_t target = 0;
  std::int32_t speed = 0;
  std::int32_t acceleration = 0;
  std::int32_t window = 0;  ///< the target is reached when the position is this close to it
  double timeout_s = 10.0;
};

/// Clears a fault, enables the drive and lets it search its zero.
DriveProcedure HomingProcedure(const HomingProfile& profile, cia402::WordOrder order);
/// Enables the drive unless it has a fault, and lets it go to a position.
DriveProcedure MoveProcedure(const MoveProfile& profile, cia402::WordOrder order);
/// Quick stop, until the shaft is at rest.
DriveProcedure StopProcedure(double timeout_s);

}  // namespace foresight
