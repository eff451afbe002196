#pragma once

#include <deque>
#include <string>

#include "hardware/api/head_health.h"

namespace foresight {

/// How a device does, in order of concern.
enum class DeviceCondition { kWell, kDegraded, kMissing };
/// "well", "degraded", "missing".
const char* ToString(DeviceCondition condition);

struct DeviceDiagnosis {
  DeviceCondition condition = DeviceCondition::kWell;
  std::string problem;  ///< what is wrong, in words; empty when well
};

struct HeadDiagnosis {
  DeviceDiagnosis lidar;
  DeviceDiagnosis camera;
  DeviceDiagnosis motor;

  /// Of the device that does worst.
  DeviceCondition Worst() const;
};

/// Beyond these a device that works is called degraded.
struct HealthLimits {
  double camera_temperature_c = 70.0;    ///< most cameras' own limit of the housing
  double lidar_sync_round_trip_s = 0.1;  ///< twice 50 ms: how far its clock may be off
  double motor_round_trip_s = 0.02;      ///< several polls of the encoder
  double slow_polls = 0.02;              ///< fraction of the polls
};

/// What is wrong now, and what went wrong since `before`.
HeadDiagnosis Diagnose(const HeadHealth& now, const HeadHealth& before,
                       const HealthLimits& limits = {});

/// Follows the health of a head: what went wrong in the last ten seconds still shows, what was
/// longer ago does not. Counters begin at zero, as a driver's do when it is made.
class HealthWatch {
 public:
  static constexpr double kMemory_s = 10.0;

  /// Times do not decrease.
  HeadDiagnosis Update(double time_s, const HeadHealth& health);

 private:
  struct Reading {
    double time_s = 0.0;
    HeadHealth health;
  };
  HeadHealth before_;  ///< the newest reading that is older than the memory
  std::deque<Reading> recent_;
};

}  // namespace foresight
