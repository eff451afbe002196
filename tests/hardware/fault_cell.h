#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hardware/emulator/emulated_site.h"

namespace foresight {

/// Something that goes wrong with one device while a head runs.
struct HeadFault {
  std::string device;  ///< "lidar", "motor" or "camera"
  std::string name;
  std::function<void(EmulatedSite&)> begin;
  double lasts_s = 0.0;                     ///< then it is over by itself
  std::function<void(EmulatedSite&)> heal;  ///< what an operator would do; may be empty
};

/// What the head is doing when the fault begins.
enum class HeadPhase { kConnecting, kHoming, kReady, kSweeping, kStopping };
inline constexpr int kHeadPhases = 5;
const char* ToString(HeadPhase phase);

/// Every fault that the emulators can show on request.
const std::vector<HeadFault>& HeadFaults();

/// How a head came through a fault.
struct FaultOutcome {
  std::string summary;                  ///< for the table: what the operator gets
  std::vector<std::string> violations;  ///< of what must hold whatever happens; empty = well
};

/// Flies a small scan with the real drivers on emulated devices, lets the fault begin in `phase`,
/// and looks whether the motor ends at rest, the scan is kept and marked, a fault is told in one
/// sentence that names its device, and the same head flies a complete scan once the fault is over.
/// Takes some ten seconds, most of them waiting.
FaultOutcome RunFaultCell(const HeadFault& fault, HeadPhase phase);

}  // namespace foresight
