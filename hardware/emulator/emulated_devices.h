#pragma once

#include <memory>
#include <string>

#include "core/simulation/world.h"
#include "hardware/emulator/camera_emulator.h"
#include "hardware/emulator/device_faults.h"
#include "hardware/emulator/motor_emulator.h"
#include "hardware/emulator/scip_emulator.h"

namespace foresight {

/// What an emulated head is made of, and where its devices listen.
struct EmulatedDevicesOptions {
  WorldOptions world;
  SensorRig true_rig = DefaultSensorRig();  ///< the head as it is
  TcpAddress lidar;                         ///< port 0 takes a free one
  TcpAddress motor;
  /// The port is GigE Vision's and cannot be chosen. Empty: a free address of 127.0.0.0/8.
  std::string camera;
  EmulatedDriveOptions drive;
  DeviceFaults faults;
};

/// A scene with a head in it whose lidar, motor and camera answer on this computer's network. One
/// world, one clock and one shaft feed all three, so what they measure fits together and the truth
/// is known.
class EmulatedDevices {
 public:
  /// Fails with kInvalidOptions for a bad rig, world or faults, kDevice when an address is taken.
  static Result<std::unique_ptr<EmulatedDevices>> Start(std::shared_ptr<const Scene> scene,
                                                        const EmulatedDevicesOptions& options);

  ScipEmulator& lidar() { return *lidar_; }
  MotorEmulator& motor() { return *motor_; }
  CameraEmulator& camera() { return *camera_; }

  const std::shared_ptr<const World>& world() const { return world_; }
  /// In real time. A head on the same clock has stamps that can be compared with the truth.
  const std::shared_ptr<SimulatedClock>& clock() const { return clock_; }

  // The truth.
  /// The shaft's angle at a time of clock(); the home switch lies at 0.
  double ShaftAngle(double time_s) const { return shaft_->At(time_s).angle_rad; }
  bool MotorTurns() const { return shaft_->MovingAt(clock_->Now()); }
  /// What a lidar without a wire would measure in the mirror's turn `turn`, counted from the
  /// clock's 0: the same ranges, intensities and stamp.
  LidarLine MeasureTurn(std::int64_t turn) const;
  /// The rig with the angle correction that a perfect calibration would hold.
  SensorRig CalibratedRig() const;

 private:
  EmulatedDevices(std::shared_ptr<const Scene> scene, const EmulatedDevicesOptions& options);

  const std::shared_ptr<const World> world_;
  const std::shared_ptr<SimulatedClock> clock_;
  const std::shared_ptr<SimulatedShaft> shaft_;
  std::unique_ptr<ScipEmulator> lidar_;
  std::unique_ptr<MotorEmulator> motor_;
  std::unique_ptr<CameraEmulator> camera_;
};

}  // namespace foresight
