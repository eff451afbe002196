#pragma once

#include <memory>
#include <string>

#include "app/common/exit_code.h"
#include "core/base/run_context.h"
#include "hardware/api/moving_stand.h"
#include "hardware/api/sensor_head.h"

namespace foresight {

/// How a head serves its stations, as the command line says it.
struct ListenArguments {
  std::string address;     ///< HOST:PORT; empty = not at all
  std::string keys;        ///< folder; empty = /etc/foresight/link
  bool plaintext = false;  ///< on loopback only
  std::string scans;       ///< folder; empty = the user's
  double disk_ratio = 0.5;
  double lease_s = 60.0;
  std::string robot_socket;     ///< path; empty = no robot
  bool announce = true;         ///< on the local network, where stations from elsewhere can connect
  double burst_mbit_s = 250.0;  ///< of a one-way path to the station; 0 = no bursts
  bool json = false;
};

/// Serves `head` until the context is cancelled; `stand` is the one of its simulated world, or
/// null.
Result<ExitCode> Listen(std::shared_ptr<SensorHead> head, bool simulated, MovingStand* stand,
                        const ListenArguments& arguments, const RunContext& context);

}  // namespace foresight
