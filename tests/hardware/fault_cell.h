#pragma once

#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hardware/emulator/emulated_devices.h"

namespace foresight {

/// What the head is doing when the fault begins.
enum class HeadPhase { kDisconnected, kConnecting, kHoming, kReady, kSweeping, kStopping, kFault };
inline constexpr int kHeadPhases = 7;
const char* ToString(HeadPhase phase);

/// An image of this small camera has four packets: of a loss of 5 % most seeds lose none. With this
/// one the first data packets of the first two images are lost, and come when asked for again.
inline constexpr std::uint64_t kLossyCameraSeed = 2234;

/// Where the scan is watched from: beside the head, or at the far end of a link on loopback.
enum class HeadAccess { kDirect, kLinked };

/// Something that goes wrong with one device while a head runs.
struct HeadFault {
  std::string device;  ///< "lidar", "motor" or "camera"
  std::string name;
  /// What goes on beside the head until the fault is over, or an empty thread.
  std::function<std::jthread(EmulatedDevices&)> begin;
  double lasts_s = 0.0;                        ///< then it is over by itself
  std::function<void(EmulatedDevices&)> heal;  ///< what an operator would do; may be empty
  std::vector<HeadPhase> unmet;                ///< phases in which it may pass without an effect
};

/// Every fault that the emulators can show on request (head_faults.cpp).
const std::vector<HeadFault>& HeadFaults();

/// Something that is wrong with one device from its power-on.
struct PlannedFault {
  std::string device;
  std::string name;
  DeviceFaults plan;
  std::vector<std::string> members;  ///< of the device's fault plan that it sets
  bool harmless = false;             ///< the scan is to be complete in every line and image
};

/// Every member of every emulator's fault plan (planned_faults.cpp).
const std::vector<PlannedFault>& PlannedFaults();
/// Names of the members of LidarFaults, MotorFault and CameraFaults, e.g. "lidar.clock_ppm". Does
/// not compile when one of them gets a member that is not named.
std::vector<std::string> FaultPlanMembers();

/// How a head came through a fault.
struct FaultOutcome {
  std::string summary;                  ///< for the table: what the operator gets
  std::int64_t effects = 0;             ///< how often the fault changed what a device did or said
  std::vector<std::string> violations;  ///< of what must hold whatever happens; empty = well
};

/// Executes a small scan with the real drivers on emulated devices, lets the fault begin in
/// `phase`, and looks whether the fault had an effect, the motor ends at rest, the scan is kept and
/// marked, a fault is told in one sentence that names its device, and the same head executes a
/// complete scan once the fault is over. Over a link also whether each scan that began is on the
/// head's disk, bit by bit as the station has it. Takes some ten seconds, most of them waiting.
FaultOutcome RunFaultCell(const HeadFault& fault, HeadPhase phase,
                          HeadAccess access = HeadAccess::kDirect);
/// The same with a fault from power-on and without what comes after: homes, executes, and looks.
FaultOutcome RunPlannedFault(const PlannedFault& fault);
/// All of PlannedFaults(), several at once.
std::vector<std::pair<const PlannedFault*, FaultOutcome>> RunPlannedFaults();

}  // namespace foresight
