#pragma once

#include <chrono>
#include <string>

#include "core/base/result.h"
#include "core/geometry/angles.h"
#include "hardware/motor/cia402.h"

namespace foresight {

/// Where the motor's drive is and how it is driven.
struct ModbusMotorOptions {
  std::string host = "127.0.0.1";  ///< address or name
  std::uint16_t port = 502;
  cia402::WordOrder word_order = cia402::WordOrder::kHighFirst;
  int counts_per_turn = 18000;  ///< 0.02 deg; counts grow when the head turns up

  /// Moves beyond are refused. The defaults let every ScanPlan through with its run-up; a head
  /// whose cables allow less says so here.
  double min_angle_rad = RadiansFromDegrees(-115.0);
  double max_angle_rad = RadiansFromDegrees(115.0);
  double max_speed_rad_s = RadiansFromDegrees(120.0);
  double acceleration_rad_s2 = RadiansFromDegrees(400.0);
  double homing_search_rad_s = RadiansFromDegrees(20.0);  ///< to the switch
  double homing_edge_rad_s = RadiansFromDegrees(1.0);     ///< onto its edge
  double homing_timeout_s = 60.0;

  double poll_rate_hz = 240.0;  ///< while something is asked of the motor or it turns; else 20
  std::chrono::milliseconds response_timeout{200};
  /// Samples whose round trip took longer (and thrice the usual) are left out of the track.
  double slow_round_trip_s = 0.002;
  double remembered_s = 10.0;  ///< of the track; who does not fetch for longer loses the oldest

  Status Check() const;
};

}  // namespace foresight
