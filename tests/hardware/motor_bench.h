#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include "hardware/emulator/motor_emulator.h"
#include "hardware/motor/modbus_motor.h"
#include "tests/hardware/tiny_head.h"

namespace foresight {

/// For tests that do not look at the zero: the edge of the switch is taken at 4 deg/s.
inline ModbusMotorOptions HastyHoming() {
  ModbusMotorOptions options;
  options.homing_edge_rad_s = RadiansFromDegrees(4.0);
  return options;
}

/// A driver on an emulated drive, over a real socket in real time.
struct MotorBench {
  /// Of a move's end: half a count of the target, five sigma of the switch, and a drive's cycle of
  /// hasty homing.
  static constexpr double kTolerance_deg = 0.01 + 0.015 + 0.004;

  explicit MotorBench(MotorEmulatorOptions emulated = {},
                      ModbusMotorOptions options = HastyHoming(), double start_deg = 2.0)
      : shaft(std::make_shared<SimulatedShaft>(RadiansFromDegrees(start_deg))) {
    auto started = MotorEmulator::Start(TinyWorld(), clock, shaft, emulated);
    if (!started) throw std::runtime_error(started.error().message);
    emulator = std::move(*started);
    options.host = emulator->address().host;
    options.port = emulator->address().port;
    motor = std::make_unique<ModbusMotor>(options, clock);
  }

  /// Looks often; the time only ends what would never come.
  static bool WaitFor(const std::function<bool()>& condition, double seconds = 10.0) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    return true;
  }
  bool WaitForRest() const {
    return WaitFor([this] {
      const Result<bool> moving = motor->Moving();
      return !moving || !*moving;
    });
  }
  bool WaitForError() const {
    return WaitFor([this] { return !motor->Moving(); });
  }
  bool Home() const {
    return motor->Connect() && motor->StartHoming() && WaitForRest() && motor->Homed();
  }
  Status Go(double deg, double deg_s) const {
    return motor->StartMove(RadiansFromDegrees(deg), RadiansFromDegrees(deg_s));
  }
  bool ShaftTurns() const { return shaft->MovingAt(clock->Now()); }
  double ShaftDeg() const { return DegreesFromRadians(shaft->At(clock->Now()).angle_rad); }
  bool WaitForShaft(const std::function<bool(double deg)>& condition) const {
    return WaitFor([&] { return condition(ShaftDeg()); });
  }
  /// Is being moved for some time to come.
  bool Sweep() const {
    return Home() && Go(80.0, 20.0) && WaitForShaft([](double deg) { return deg > 3.0; });
  }

  std::shared_ptr<SimulatedClock> clock =
      std::make_shared<SimulatedClock>(SimulationSpeed::kRealTime);
  std::shared_ptr<SimulatedShaft> shaft;
  std::unique_ptr<MotorEmulator> emulator;
  std::unique_ptr<ModbusMotor> motor;  ///< last: goes first
};

}  // namespace foresight
