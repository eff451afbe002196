#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/sensor/lidar_line.h"
#include "hardware/api/lidar_health.h"

namespace foresight {

/// A 2D lidar that streams lines. One owner; calls from one thread at a time, except Health, which
/// any thread may call at any time. Destroying it stops it.
class Lidar {
 public:
  virtual ~Lidar() = default;

  /// Maker, model, serial number and address, for messages and the mission file.
  virtual std::string Describe() const = 0;
  virtual Status Connect() = 0;
  /// Starts the stream; lines that were measured before are discarded.
  virtual Status Start() = 0;
  virtual void Stop() = 0;
  /// The next line in order, waiting for it at most `timeout`; nullopt when none came. Fails with
  /// kDevice when the device is lost. Stamps are on the head's clock (see SensorClock).
  virtual Result<std::optional<LidarLine>> WaitForLine(std::chrono::milliseconds timeout) = 0;
  /// Never waits for the device. What a device cannot know stays at its default.
  virtual LidarHealth Health() const = 0;
};

}  // namespace foresight
