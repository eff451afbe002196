#include "app/common/fly_scan.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "app/common/interrupt_watcher.h"
#include "hardware/head/scan_recorder.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kPoll{5};

/// Waits until the head leaves `states`, and stands for the operator meanwhile; a cancelled context
/// aborts the scan and stops the motor.
HeadStatus WaitWhile(SensorHead& head, std::initializer_list<HeadState> states,
                     const RunContext& context) {
  bool aborted = false;
  for (;;) {
    head.OperatorSeen();
    const HeadStatus status = head.Status();
    if (std::find(states.begin(), states.end(), status.state) == states.end()) return status;
    if (context.Cancelled() && !aborted) {
      aborted = true;
      const std::string reason = InterruptReason();
      head.EndScan(reason.empty() ? "the scan was cancelled" : reason);
      if (status.state == HeadState::kHoming) head.StopMotor();
    }
    std::this_thread::sleep_for(kPoll);
  }
}

Status HomeAndWait(SensorHead& head, const RunContext& context) {
  head.OperatorSeen();
  FORESIGHT_CHECK(head.Home());
  const HeadStatus status = WaitWhile(head, {HeadState::kHoming}, context);
  if (status.state != HeadState::kReady)
    return Fail(ErrorCode::kDevice, "the head is not ready after homing: {}{}{}", InterruptReason(),
                InterruptReason().empty() ? "" : "; ", status.message);
  return {};
}

/// User and system time of this process.
double CpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

Result<FlownScan> FlyScan(SensorHead& head, const ScanPlan& plan,
                          std::shared_ptr<MissionFile> mission, const RunContext& context) {
  FORESIGHT_CHECK(plan.Check());
  FORESIGHT_CHECK(HomeAndWait(head, context));
  const auto recorder = std::make_shared<ScanRecorder>(std::move(mission));
  const auto start = std::chrono::steady_clock::now();
  const double cpu_before_s = CpuSeconds();
  FORESIGHT_CHECK(head.StartScan(plan, recorder));
  const HeadStatus status = WaitWhile(head, {HeadState::kSweeping, HeadState::kStopping}, context);
  FlownScan flown;
  flown.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  flown.cpu_share = (CpuSeconds() - cpu_before_s) / flown.seconds;
  FORESIGHT_TRY(flown.id, recorder->WaitUntilWritten());
  if (status.state == HeadState::kFault) return Fail(ErrorCode::kDevice, "{}", status.message);
  return flown;
}

Result<std::shared_ptr<MissionFile>> OpenOrCreateMission(const std::string& path) {
  auto opened = std::filesystem::exists(path) ? MissionFile::Open(path) : MissionFile::Create(path);
  if (!opened) return tl::unexpected(opened.error());
  return std::shared_ptr<MissionFile>(std::move(*opened));
}

}  // namespace foresight
