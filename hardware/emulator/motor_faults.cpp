#include "hardware/emulator/motor_faults.h"

#include <cmath>

#include "core/base/contract.h"
#include "core/base/random.h"

namespace foresight {
namespace {

constexpr std::uint64_t kStream = 0x6d6661756c7473;  // "mfaults"

}  // namespace

const char* ToString(MotorFault::Kind kind) {
  switch (kind) {
    case MotorFault::Kind::kBlockedShaft:
      return "blocked shaft";
    case MotorFault::Kind::kLostHomeSwitch:
      return "lost home switch";
    case MotorFault::Kind::kDeadLink:
      return "dead link";
    case MotorFault::Kind::kStaleStatus:
      return "stale status";
    case MotorFault::Kind::kTcpReset:
      return "TCP reset";
    case MotorFault::Kind::kEncoderOffset:
      return "encoder offset";
  }
  return "unknown fault";
}

std::vector<MotorFault> RandomMotorFaults(std::uint64_t seed, double mean_interval_s,
                                          double span_s) {
  FORESIGHT_EXPECTS(mean_interval_s > 0.0, "faults need some time between them");
  Random random(seed, kStream);
  std::vector<MotorFault> faults;
  double time_s = 0.0;
  for (;;) {
    time_s -= mean_interval_s * std::log(1.0 - random.Uniform());
    if (time_s >= span_s) return faults;
    const auto kind = static_cast<MotorFault::Kind>(random.Index(MotorFault::kKinds));
    faults.push_back({kind, time_s, random.Uniform(0.2, 1.0)});
    time_s += faults.back().duration_s;
  }
}

}  // namespace foresight
