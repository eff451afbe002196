#include "tests/hardware/fault_cell.h"

#include <algorithm>
#include <future>
#include <regex>

#include "hardware/link/chunks/scan_digest.h"
#include "tests/hardware/emulated_head.h"
#include "tests/hardware/link/head_bench.h"

namespace foresight {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPatience_s = 40.0;
/// From "nothing goes on any more" to a shaft at rest: the drive's watchdog and its ramp.
constexpr double kRest_s = 3.0;

/// A camera and a fan small enough that several heads fit one machine.
EmulatedDevicesOptions SmallDevices(const DeviceFaults& faults) {
  EmulatedDevicesOptions options;
  options.true_rig = TinyRig();
  options.faults = faults;
  if (options.faults.camera.seed == CameraFaults().seed)
    options.faults.camera.seed = kLossyCameraSeed;
  return options;
}

/// 3 s at 10 deg/s, an image in the last third.
ScanPlan Plan() {
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(-10.0);
  plan.to_rad = RadiansFromDegrees(20.0);
  plan.image_angles_rad = {RadiansFromDegrees(12.0)};
  return plan;
}

/// One head's way through one fault.
class Cell {
 public:
  Cell(const HeadFault& fault, HeadPhase phase, HeadAccess access,
       const DeviceFaults& from_power_on = {})
      : fault_(fault),
        phase_(phase),
        bench_(std::make_shared<const Scene>(TinyWorld()->scene()), SmallDevices(from_power_on),
               HastyConfig) {
    if (access == HeadAccess::kDirect) return;
    link_ = std::make_unique<HeadBench>(bench_.head);
    bench_.head = link_->Connect().value();
    operator_ = std::jthread([head = bench_.head](const std::stop_token& over) {
      while (!over.stop_requested()) {
        head->OperatorSeen();
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
      }
    });
  }
  ~Cell() {  // the station goes before the head's server
    operator_ = {};
    bench_.head.reset();
  }

  FaultOutcome Run() {
    ExecuteWithFault();
    JudgeOutcome();
    Recover();
    return std::move(outcome_);
  }

  /// What the emulators are set up with may last for ever, so nothing is over afterwards.
  FaultOutcome RunWithoutRecovery(bool harmless) {
    ExecuteWithFault();
    JudgeOutcome();
    if (harmless && outcome_.summary != "scan complete")
      Violation("harmless, but: " + outcome_.summary);
    return std::move(outcome_);
  }

 private:
  static void HastyConfig(HeadConfig& config) {
    config.motor.homing_edge_rad_s = RadiansFromDegrees(4.0);
    config.motor.homing_timeout_s = 10.0;
    config.camera.frame_timeout_s = 1.0;
    config.camera.connect_timeout_s = 20.0;
  }

  void Violation(const std::string& what) { outcome_.violations.push_back(what); }
  HeadState State() const { return bench_.head->Status().state; }

  bool WaitFor(const std::function<bool()>& condition, double seconds = kPatience_s) const {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (!condition()) {
      if (Clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    return true;
  }
  bool Idle() const {
    const HeadState state = State();
    return state == HeadState::kReady || state == HeadState::kFault ||
           state == HeadState::kDisconnected;
  }

  /// Not what a scan before had.
  bool SweepsWithLines() const {
    constexpr int kSome = 10;
    const HeadStatus status = bench_.head->Status();
    return status.state == HeadState::kSweeping && status.lines >= kSome;
  }

  void BeginFault() {
    effects_before_ = Effects();
    beside_ = fault_.begin(*bench_.devices);
    over_at_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                  std::chrono::duration<double>(fault_.lasts_s));
  }

  /// How often a fault of the device changed something.
  std::int64_t Effects() const {
    if (fault_.device == "lidar") return bench_.devices->lidar().counts().fault_effects;
    if (fault_.device == "motor") return bench_.devices->motor().fault_effects();
    return bench_.devices->camera().counts().fault_effects;
  }

  /// The head is told to home although it is disconnected or in fault, and to scan if it can.
  void HomeAndScan() {
    if (!bench_.head->Home()) return Violation("the head refused to home");
    WaitFor([this] { return State() == HeadState::kHoming; }, 1.0);
    if (!WaitFor([this] { return Idle(); })) return Violation("homing never ended");
    if (State() == HeadState::kReady) Scan();
  }

  /// Something else has happened before: the head is in fault.
  void GoIntoFault() {
    if (!bench_.Home()) return Violation("no homing before the fault");
    bench_.devices->motor().Inject({MotorFault::Kind::kTcpReset, 0.0, 0.0});
    if (!bench_.WaitFor(HeadState::kFault)) Violation("a broken connection was not noticed");
  }

  void ExecuteWithFault() {
    if (phase_ == HeadPhase::kDisconnected || phase_ == HeadPhase::kFault) {
      if (phase_ == HeadPhase::kFault) GoIntoFault();
      BeginFault();
      return HomeAndScan();
    }
    if (phase_ == HeadPhase::kConnecting || phase_ == HeadPhase::kHoming) {
      if (!bench_.head->Home()) return Violation("the head refused to home");
      if (phase_ == HeadPhase::kHoming)
        WaitFor([this] { return bench_.devices->MotorTurns() || Idle(); });
      BeginFault();
      if (!WaitFor([this] { return Idle(); })) return Violation("homing never ended");
      if (State() == HeadState::kReady) Scan();
      return;
    }
    if (!bench_.Home()) return Violation("no homing before the fault");
    if (phase_ == HeadPhase::kReady) {
      BeginFault();
      WaitFor([this] { return State() == HeadState::kFault; }, 1.0);
      if (State() == HeadState::kReady) Scan();
      return;
    }
    Scan();
  }

  /// Executes the plan; begins the fault on the way where that is the phase.
  void Scan() {
    const auto watch = std::make_shared<ScanWatch>();
    assembler_ = std::make_shared<ScanAssembler>();
    const auto sinks =
        std::make_shared<ScanFanout>(std::vector<std::shared_ptr<ScanSink>>{assembler_, watch});
    if (const Status started = bench_.head->StartScan(Plan(), sinks); !started) {
      assembler_.reset();
      refused_ = started.error().message;
      return;
    }
    if (phase_ == HeadPhase::kSweeping && WaitFor([this] { return SweepsWithLines() || Idle(); }))
      BeginFault();
    if (phase_ == HeadPhase::kStopping &&
        WaitFor([this] { return State() == HeadState::kStopping || Idle(); }))
      BeginFault();
    if (!watch->WaitForEnd()) return Violation("the scan never ended");
    if (!WaitFor([this] { return Idle(); })) Violation("the head never came to rest");
  }

  void JudgeOutcome() {
    const HeadStatus status = bench_.head->Status();
    if (!WaitFor([this] { return !bench_.devices->MotorTurns(); }, kRest_s))
      Violation("the motor still turns");
    outcome_.effects = Effects() - effects_before_;
    if (outcome_.effects == 0 && std::ranges::count(fault_.unmet, phase_) == 0)
      Violation("the fault had no effect");
    if (assembler_) JudgeScan(*assembler_->Snapshot());
    if (assembler_ && link_) JudgeTransfer(*assembler_->Snapshot());
    if (status.state == HeadState::kFault) {
      if (status.message.find('\n') != std::string::npos || status.message.empty())
        Violation("the message is no sentence: " + status.message);
      if (DeviceIn(status.message) != fault_.device)
        Violation("the message names another device: " + status.message);
      outcome_.summary += (assembler_ ? "; " : "") + std::string("fault: ") +
                          Short(status.message.substr(0, status.message.find(';')));
    } else if (!assembler_) {
      outcome_.summary = "no scan: " + Short(refused_.empty() ? status.message : refused_);
    }
  }

  void JudgeScan(const foresight::Scan& scan) {
    const int lost = bench_.head->Status().lost_lines;
    outcome_.summary =
        fmt::format("scan {}{}{}", ToString(scan.state), lost > 0 ? ", lines lost" : "",
                    scan.frames.empty() ? ", no image" : "");
    if (scan.state == ScanState::kRunning) Violation("the scan is not marked");
    // The switch is repeatable to 0.003 deg; hasty homing adds a cycle at 4 deg/s.
    const double zero_deg = DegreesFromRadians(bench_.devices->motor().zero_rad());
    if (scan.state == ScanState::kComplete && std::abs(zero_deg) > 0.1)
      Violation(fmt::format("a complete scan with a zero that is off by {:.2f} deg", zero_deg));
    if (scan.state == ScanState::kInterrupted && scan.reason.empty())
      Violation("the scan does not say why it was interrupted");
    const bool swept = phase_ == HeadPhase::kSweeping || phase_ == HeadPhase::kStopping;
    if (swept && scan.lines.size() < 10) Violation("lines from before the fault are missing");
    if (scan.state == ScanState::kComplete &&
        static_cast<int>(scan.lines.size()) + lost < 118)  // 120 were asked for
      Violation(
          fmt::format("{} lines and {} lost ones make no complete scan", scan.lines.size(), lost));
  }

  /// A scan that the head did not begin is at the station alone, without a line.
  void JudgeTransfer(const foresight::Scan& scan) {
    const auto at_head = link_->shelf().Snapshot(scan.uuid);
    if (!at_head) {
      if (!scan.lines.empty()) Violation("not on the head's disk: " + at_head.error().message);
    } else if (ScanDigest(scan) != ScanDigest(**at_head)) {
      Violation("the station's scan is not the head's");
    }
  }

  /// The same head, the same emulators, as soon as the fault is over.
  void Recover() {
    std::this_thread::sleep_until(over_at_);
    if (fault_.heal) fault_.heal(*bench_.devices);
    auto scan = bench_.Execute(Plan());
    // That this machine stood still, and its threads read no motor, is no fault of the devices.
    for (int tries = 2; tries > 0 && scan && HasHole(scan->track); --tries)
      scan = bench_.Execute(Plan());
    if (!scan) return Violation("did not recover: " + bench_.head->Status().message);
    if (scan->state != ScanState::kComplete) Violation("did not recover: " + scan->reason);
    if (scan->frames.size() != 1) Violation("no image after the recovery");
    if (bench_.head->Status().lost_lines != 0) Violation("lines are lost after the recovery");
    if (link_) JudgeTransfer(*scan);
  }

  static bool HasHole(const MotorTrack& track) {
    const auto samples = track.samples();
    for (std::size_t i = 1; i < samples.size(); ++i)
      if (samples[i].time_s - samples[i - 1].time_s > MotorTrack::kMaxGap_s) return true;
    return false;
  }

  /// The first device that a message names.
  static std::string DeviceIn(const std::string& message) {
    static const std::regex kDevice("lidar|motor|camera");
    std::smatch found;
    return std::regex_search(message, found, kDevice) ? found.str() : "";
  }

  /// Without addresses, which differ from run to run.
  static std::string Short(const std::string& message) {
    static const std::regex kAddress(R"( \d+\.\d+\.\d+\.\d+(:\d+)?)");
    static const std::regex kIdentity(R"( \([^)]*E0000001\))");
    static const std::regex kNumber(R"(\d+ ms)");
    std::string text = std::regex_replace(message, kAddress, "");
    text = std::regex_replace(text, kIdentity, "");
    return std::regex_replace(text, kNumber, "... ms");
  }

  const HeadFault& fault_;
  const HeadPhase phase_;
  EmulatedHead bench_;
  std::unique_ptr<HeadBench> link_;  ///< where the head is watched over a link
  std::jthread operator_;            ///< sits at the station
  std::shared_ptr<ScanAssembler> assembler_;
  std::string refused_;
  std::jthread beside_;  ///< of the fault
  Clock::time_point over_at_ = Clock::now();
  std::int64_t effects_before_ = 0;
  FaultOutcome outcome_;
};

}  // namespace

const char* ToString(HeadPhase phase) {
  switch (phase) {
    case HeadPhase::kDisconnected:
      return "disconnected";
    case HeadPhase::kConnecting:
      return "connecting";
    case HeadPhase::kHoming:
      return "homing";
    case HeadPhase::kReady:
      return "ready";
    case HeadPhase::kSweeping:
      return "sweeping";
    case HeadPhase::kStopping:
      return "stopping";
    case HeadPhase::kFault:
      return "fault";
  }
  return "unknown";
}

FaultOutcome RunFaultCell(const HeadFault& fault, HeadPhase phase, HeadAccess access) {
  return Cell(fault, phase, access).Run();
}

FaultOutcome RunPlannedFault(const PlannedFault& fault) {
  const HeadFault nothing_more{
      fault.device, fault.name, [](EmulatedDevices&) { return std::jthread(); }, 0.0, {}, {}};
  return Cell(nothing_more, HeadPhase::kConnecting, HeadAccess::kDirect, fault.plan)
      .RunWithoutRecovery(fault.harmless);
}

std::vector<std::pair<const PlannedFault*, FaultOutcome>> RunPlannedFaults() {
  constexpr std::size_t kAtOnce = 6;
  const std::vector<PlannedFault>& faults = PlannedFaults();
  std::vector<std::pair<const PlannedFault*, FaultOutcome>> outcomes;
  for (std::size_t begin = 0; begin < faults.size(); begin += kAtOnce) {
    const std::size_t end = std::min(begin + kAtOnce, faults.size());
    std::vector<std::future<FaultOutcome>> running;
    for (std::size_t i = begin; i < end; ++i)
      running.push_back(std::async(std::launch::async, RunPlannedFault, std::cref(faults[i])));
    for (std::size_t i = begin; i < end; ++i)
      outcomes.emplace_back(&faults[i], running[i - begin].get());
  }
  return outcomes;
}

}  // namespace foresight
