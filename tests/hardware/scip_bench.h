#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <thread>

#include "hardware/emulator/scip_emulator.h"
#include "hardware/scip/scip_lidar.h"
#include "tests/hardware/tiny_head.h"

namespace foresight {

/// A condition has so long to come true. Far more than it takes: this machine may be busy.
constexpr std::chrono::seconds kDeadline{20};

/// Waits for a condition, not for a time.
inline bool Eventually(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + kDeadline;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::yield();
  }
  return true;
}

/// An emulated lidar on a turning shaft, and a driver connected to it over loopback.
struct ScipBench {
  explicit ScipBench(const LidarFaults& faults = {},
                     const std::function<void(ScipLidarOptions&)>& change = {},
                     std::shared_ptr<const World> seen = TinyWorld())
      : world(std::move(seen)) {
    ScipEmulatorOptions emulated;
    emulated.faults = faults;
    emulator = ScipEmulator::Start(world, clock, shaft, emulated).value();
    options.address = emulator->address();
    options.last_step = world->true_rig().lidar.beams - 1;
    options.connect_timeout_s = 20.0;
    options.drain_s = 0.02;
    if (change) change(options);
    lidar = std::make_unique<ScipLidar>(options, clock);
  }

  bool Begin() { return lidar->Connect() && lidar->Start(); }

  /// The next line, or the test fails.
  LidarLine NextLine() {
    const auto deadline = std::chrono::steady_clock::now() + kDeadline;
    while (std::chrono::steady_clock::now() < deadline) {
      const auto line = lidar->WaitForLine(std::chrono::milliseconds(100));
      if (line && *line) return **line;
    }
    ADD_FAILURE() << "no line: " << lidar->Health().last_error;
    return {};
  }

  double period_s() const { return world->true_rig().lidar.period_s; }
  /// The turn of the mirror that a line was measured in.
  std::int64_t TurnOf(const LidarLine& line) const {
    return std::llround(line.time_s / period_s());
  }
  /// By how much a line's stamp is off.
  double StampError_s(const LidarLine& line) const {
    return line.time_s - static_cast<double>(TurnOf(line)) * period_s();
  }
  /// How far off a stamp can be: half a tick where every stamp is rounded alike, half a tick where
  /// every reading of the device's clock was, half the round trip of the best reading, which is
  /// longer on a busy machine, and 0.1 ms where late arrivals pass for a drift.
  double MostStampError_s() const { return MostStampError_s(*lidar); }
  static double MostStampError_s(const ScipLidar& lidar) {
    return 1.1e-3 + 0.5 * lidar.Health().sync_round_trip_s;
  }
  /// What the simulated lidar in this process would measure in that turn.
  LidarLine Truth(const LidarLine& line) const {
    const std::int64_t turn = TurnOf(line);
    return world->MeasureLine(turn, static_cast<double>(turn) * period_s(),
                              [this](double time_s) { return shaft->At(time_s).angle_rad; });
  }

  std::shared_ptr<const World> world;
  std::shared_ptr<SimulatedClock> clock =
      std::make_shared<SimulatedClock>(SimulationSpeed::kRealTime);
  std::shared_ptr<SimulatedShaft> shaft = std::make_shared<SimulatedShaft>(0.0);
  ScipLidarOptions options;
  std::unique_ptr<ScipEmulator> emulator;
  std::unique_ptr<ScipLidar> lidar;
};

}  // namespace foresight
