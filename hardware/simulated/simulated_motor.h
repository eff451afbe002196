#pragma once

#include <atomic>
#include <memory>

#include "core/geometry/angles.h"
#include "core/simulation/world.h"
#include "hardware/api/motor.h"
#include "hardware/simulated/simulated_clock.h"
#include "hardware/simulated/simulated_shaft.h"

namespace foresight {

/// A drive with limited acceleration, a home switch at 0 and an encoder polled 240 times a second.
/// Before homing the encoder counts from where it was switched on.
class SimulatedMotor final : public Motor {
 public:
  static constexpr double kPowerOnAngle_rad = 0.2;
  static constexpr double kAcceleration_rad_s2 = RadiansFromDegrees(400.0);
  static constexpr double kEndStop_rad = RadiansFromDegrees(120.0);  ///< either way
  static constexpr double kSampleRate_hz = 240.0;

  SimulatedMotor(std::shared_ptr<const World> world, std::shared_ptr<SimulatedClock> clock,
                 std::shared_ptr<SimulatedShaft> shaft);
  ~SimulatedMotor() override;

  std::string Describe() const override { return "simulated motor"; }
  Status Connect() override;
  Status StartHoming() override;
  bool Homed() const override;
  Status StartMove(double angle_rad, double speed_rad_s) override;
  Result<bool> Moving() override;
  Result<MotorSample> Position() override;
  std::vector<MotorSample> TakeTrack() override;
  void QuickStop() override;
  MotorHealth Health() const override;

 private:
  double Report(double time_s) const;

  std::shared_ptr<const World> world_;
  std::shared_ptr<SimulatedClock> clock_;
  std::shared_ptr<SimulatedShaft> shaft_;
  std::atomic<bool> connected_{false};
  std::int64_t next_sample_ = 0;
  /// When the home switch is reached; infinite while nobody looks for it.
  std::atomic<double> homed_at_s_;
};

}  // namespace foresight
