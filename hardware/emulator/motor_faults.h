#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/angles.h"

namespace foresight {

/// What can go wrong with an emulated motor, at a moment and for a while.
struct MotorFault {
  enum class Kind {
    kBlockedShaft,    ///< something holds the plate: following error 8611h when it should turn
    kLostHomeSwitch,  ///< the switch never shows: homing ends with its error bits
    kDeadLink,        ///< requests are taken and lost; the drive's watchdog stops the motor
    kStaleStatus,     ///< bits 10, 12 and 13 of the statusword stay as they are
    kTcpReset,        ///< all connections break; lasts no time
    kEncoderOffset,   ///< the encoder says kEncoderOffset_rad too much: counts were lost
  };
  static constexpr int kKinds = 6;
  static constexpr double kEncoderOffset_rad = RadiansFromDegrees(80.0);

  Kind kind = Kind::kTcpReset;
  double after_s = 0.0;  ///< since the emulator began
  double duration_s = 0.5;

  bool operator==(const MotorFault&) const = default;
};

const char* ToString(MotorFault::Kind kind);

/// Faults of all kinds at random moments of `span_s`, on average one in `mean_interval_s`, each of
/// 0.2 to 1 s, in time order and never two at once. The same seed gives the same faults.
std::vector<MotorFault> RandomMotorFaults(std::uint64_t seed, double mean_interval_s,
                                          double span_s);

}  // namespace foresight
