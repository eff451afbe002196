#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/sensor/motor_track.h"
#include "hardware/api/motor_health.h"

namespace foresight {

/// The motor that turns the plate. Calls from one thread at a time, except QuickStop and
/// Health, which any thread may call at any time. Destroying it stops the motor.
class Motor {
 public:
  virtual ~Motor() = default;

  virtual std::string Describe() const = 0;
  virtual Status Connect() = 0;
  /// Begins the search for the zero reference; Moving() until it is done.
  virtual Status StartHoming() = 0;
  virtual bool Homed() const = 0;
  /// Begins a move to `angle_rad` at `speed_rad_s`; fails with kState before homing.
  virtual Status StartMove(double angle_rad, double speed_rad_s) = 0;
  /// Whether a homing or a move is under way. Fails with kDevice when the drive reports a fault.
  virtual Result<bool> Moving() = 0;
  /// Now. Fails with kDevice.
  virtual Result<MotorSample> Position() = 0;
  /// All samples taken since the last call, in time order (the driver polls the encoder by itself).
  virtual std::vector<MotorSample> TakeTrack() = 0;
  /// Stops as fast as the drive allows and holds.
  virtual void QuickStop() = 0;
  /// Never waits for the device. What a device cannot know stays at its default.
  virtual MotorHealth Health() const = 0;
};

}  // namespace foresight
