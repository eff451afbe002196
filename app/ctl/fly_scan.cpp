#include "app/ctl/fly_scan.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "hardware/head/scan_recorder.h"
#include "hardware/simulated/simulated_head.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kPoll{5};

/// Waits until the head leaves `state`; a cancelled context aborts the scan and stops the motor.
HeadStatus WaitWhile(SensorHead& head, std::initializer_list<HeadState> states,
                     const RunContext& context) {
  bool aborted = false;
  for (;;) {
    const HeadStatus status = head.Status();
    if (std::find(states.begin(), states.end(), status.state) == states.end()) return status;
    if (context.Cancelled() && !aborted) {
      aborted = true;
      head.AbortScan();
      if (status.state == HeadState::kHoming) head.StopMotor();
    }
    std::this_thread::sleep_for(kPoll);
  }
}

Status HomeAndWait(SensorHead& head, const RunContext& context) {
  FORESIGHT_CHECK(head.Home());
  const HeadStatus status = WaitWhile(head, {HeadState::kHoming}, context);
  if (status.state != HeadState::kReady)
    return Fail(ErrorCode::kDevice, "the head is not ready after homing: {}", status.message);
  return {};
}

}  // namespace

Result<SimulatedSite> SetUpSite(const SimulationArguments& arguments) {
  FORESIGHT_TRY(Scene scene, LoadScene(arguments.scene));
  SimulatedHeadOptions options;
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(options.true_rig, LoadSensorRig(arguments.rig));
  }
  options.world.seed = arguments.seed;
  options.speed =
      arguments.real_time ? SimulationSpeed::kRealTime : SimulationSpeed::kAsFastAsPossible;
  const auto shared = std::make_shared<const Scene>(std::move(scene));
  SimulatedSite site;
  site.world = std::make_shared<const World>(shared, options.true_rig, options.world);
  options.believed_rig = options.true_rig;
  options.believed_rig.angle_correction = site.world->CalibratedCorrection();
  FORESIGHT_TRY(site.head, MakeSimulatedHead(shared, options));
  return site;
}

Result<std::int64_t> FlyScan(SensorHead& head, const ScanPlan& plan,
                             std::shared_ptr<MissionFile> mission, const RunContext& context) {
  FORESIGHT_CHECK(plan.Check());
  FORESIGHT_CHECK(HomeAndWait(head, context));
  const auto recorder = std::make_shared<ScanRecorder>(std::move(mission));
  FORESIGHT_CHECK(head.StartScan(plan, recorder));
  const HeadStatus status = WaitWhile(head, {HeadState::kSweeping, HeadState::kStopping}, context);
  FORESIGHT_TRY(const std::int64_t id, recorder->WaitUntilWritten());
  if (status.state == HeadState::kFault) return Fail(ErrorCode::kDevice, "{}", status.message);
  return id;
}

Result<std::shared_ptr<MissionFile>> OpenOrCreateMission(const std::string& path) {
  auto opened = std::filesystem::exists(path) ? MissionFile::Open(path) : MissionFile::Create(path);
  if (!opened) return tl::unexpected(opened.error());
  return std::shared_ptr<MissionFile>(std::move(*opened));
}

}  // namespace foresight
