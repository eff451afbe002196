#pragma once

#include <atomic>
#include <memory>

#include "core/simulation/world.h"
#include "hardware/api/lidar.h"
#include "hardware/simulated/simulated_clock.h"
#include "hardware/simulated/simulated_shaft.h"

namespace foresight {

/// A lidar whose mirror turns for ever; a line is ready when its last beam has come back.
class SimulatedLidar final : public Lidar {
 public:
  SimulatedLidar(std::shared_ptr<const World> world, std::shared_ptr<SimulatedClock> clock,
                 std::shared_ptr<const SimulatedShaft> shaft);

  std::string Describe() const override { return "simulated lidar"; }
  Status Connect() override;
  Status Start() override;
  void Stop() override;
  Result<std::optional<LidarLine>> WaitForLine(std::chrono::milliseconds timeout) override;
  LidarHealth Health() const override;

 private:
  std::shared_ptr<const World> world_;
  std::shared_ptr<SimulatedClock> clock_;
  std::shared_ptr<const SimulatedShaft> shaft_;
  std::int64_t next_turn_ = 0;  ///< of the mirror since the head was switched on
  std::atomic<bool> connected_{false};
  std::atomic<bool> running_{false};
  std::atomic<std::int64_t> lines_{0};
};

}  // namespace foresight
