// foresight-head as a process, its devices emulated here or in it.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/common/emulation.h"
#include "core/base/atomic_file.h"
#include "core/geometry/angles.h"
#include "core/mission/mission_file.h"
#include "core/mission/plan_json.h"
#include "tests/support/running_program.h"

namespace foresight {
namespace {

const std::string kRoom = FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml";

class ForesightHead : public testing::Test {
 protected:
  /// The devices live in the test, which so knows what the motor does.
  void StartDevices() {
    EmulationArguments arguments;
    arguments.scene = kRoom;
    site_ = StartEmulation(arguments).value();
    ASSERT_TRUE(SaveHeadConfig(ConfigFor(*site_), config_));
  }
  std::string Plan(double from_deg, double to_deg, double speed_deg_s) {
    ScanPlan plan;
    plan.from_rad = RadiansFromDegrees(from_deg);
    plan.to_rad = RadiansFromDegrees(to_deg);
    plan.speed_rad_s = RadiansFromDegrees(speed_deg_s);
    plan.image_angles_rad = {plan.from_rad + 0.02};
    const std::string file = folder_ / "plan.json";
    EXPECT_TRUE(WriteFileAtomically(file, PlanToJson(plan)));
    return file;
  }
  /// The only scan of the mission, read anew.
  Scan RecordedScan() const {
    const auto mission = MissionFile::Open(mission_).value();
    const auto scans = mission->ListScans().value();
    EXPECT_EQ(scans.size(), 1u);
    return mission->LoadScan(scans.front().id).value();
  }
  bool DeepInTheSweep() const {
    return DegreesFromRadians(site_->ShaftAngle(site_->clock()->Now())) > 5.0 &&
           site_->camera().counts().frames > 0;
  }

  TemporaryFolder folder_;
  std::string config_ = folder_ / "head.yaml";
  std::string mission_ = folder_ / "mission.foresight";
  std::unique_ptr<EmulatedSite> site_;
};

TEST_F(ForesightHead, FliesAPlanThroughItsOwnEmulatedDevices) {
  const ProgramResult result = RunProgram(
      FORESIGHT_HEAD,
      {"--emulate", kRoom, "--seed", "4", "--scan", Plan(-5, 5, 10), "--out", mission_, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json["state"], "complete");
  EXPECT_EQ(json["source"], "emulated: room, seed 4");
  const Scan scan = RecordedScan();
  EXPECT_TRUE(scan.simulated);
  EXPECT_EQ(static_cast<int>(scan.lines.size()), json["lines"].get<int>());
  EXPECT_GE(scan.lines.size(), 40u);
  EXPECT_EQ(scan.frames.size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(mission_ + "-wal"));
}

TEST_F(ForesightHead, NeedsLessThanThreeFifthsOfACore) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer's time says nothing about the program's";
#endif
  StartDevices();
  const ProgramResult result = RunProgram(
      FORESIGHT_HEAD,
      {"--head-config", config_, "--scan", Plan(-20, 20, 10), "--out", mission_, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.output);
  RecordProperty("cpu_share", json["cpu_share"].dump());
  EXPECT_LT(json["cpu_share"].get<double>(), 0.6) << "over " << json["seconds"] << " s";
}

TEST_F(ForesightHead, ATerminatedSweepIsKeptAndMarkedAndTheMotorStops) {
  StartDevices();
  RunningProgram head(FORESIGHT_HEAD, {"--head-config", config_, "--scan", Plan(-5, 60, 10),
                                       "--out", mission_, "--json"});
  ASSERT_TRUE(WaitUntil([&] { return DeepInTheSweep(); }));
  head.Signal(SIGTERM);
  const ProgramResult result = head.Wait();
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  EXPECT_FALSE(site_->MotorTurns());
  const Scan scan = RecordedScan();
  EXPECT_EQ(scan.state, ScanState::kAborted);
  EXPECT_EQ(scan.reason, "the program was told to end (SIGTERM)");
  EXPECT_GE(scan.lines.size(), 30u);
  EXPECT_EQ(scan.frames.size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(mission_ + "-wal"));
}

TEST_F(ForesightHead, AKilledHeadLeavesAStoppedMotorAndAReadableMission) {
  StartDevices();
  RunningProgram head(FORESIGHT_HEAD,
                      {"--head-config", config_, "--scan", Plan(-5, 60, 10), "--out", mission_});
  ASSERT_TRUE(WaitUntil([&] { return DeepInTheSweep(); }));
  head.Signal(SIGKILL);
  EXPECT_EQ(head.Wait().exit_code, 128 + SIGKILL);
  // The drive's watchdog: half a second without a request.
  EXPECT_TRUE(WaitUntil([&] { return !site_->MotorTurns(); }, 3.0));
  const Scan scan = RecordedScan();
  EXPECT_EQ(scan.state, ScanState::kInterrupted);
  EXPECT_GE(scan.lines.size(), 30u);
}

TEST_F(ForesightHead, ALidarThatDiesInTheSweepIsAFaultThatKeepsTheScan) {
  StartDevices();
  RunningProgram head(FORESIGHT_HEAD,
                      {"--head-config", config_, "--scan", Plan(-5, 60, 10), "--out", mission_});
  ASSERT_TRUE(WaitUntil([&] { return DeepInTheSweep(); }));
  site_->lidar().InjectSilence(60.0);
  const ProgramResult result = head.Wait();
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors, testing::HasSubstr("lidar " + site_->lidar().address().ToText()));
  EXPECT_FALSE(site_->MotorTurns());
  const Scan scan = RecordedScan();
  EXPECT_EQ(scan.state, ScanState::kInterrupted);
  EXPECT_THAT(scan.reason, testing::HasSubstr("no line for"));
  EXPECT_GE(scan.lines.size(), 30u);
}

TEST_F(ForesightHead, SaysWhatIsWrongWithItsArguments) {
  const std::string plan = Plan(-5, 5, 10);
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--out", mission_});
    return RunProgram(FORESIGHT_HEAD, arguments);
  };
  EXPECT_EQ(run({"--scan", plan}).exit_code, 2);
  EXPECT_EQ(run({"--scan", plan, "--emulate", kRoom, "--head-config", config_}).exit_code, 2);
  EXPECT_EQ(run({"--scan", plan, "--head-config", config_, "--seed", "2"}).exit_code, 2);
  ASSERT_TRUE(WriteFileAtomically(config_, "foresight_head: 1\nlidar: {adress: 10.0.0.1}\n"));
  const ProgramResult bad = run({"--scan", plan, "--head-config", config_});
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_THAT(bad.errors, testing::HasSubstr("head.yaml:2: 'address' is missing"));
  EXPECT_FALSE(std::filesystem::exists(mission_));
}

TEST_F(ForesightHead, SaysWhichDeviceIsNotThere) {
  StartDevices();
  HeadConfig config = ConfigFor(*site_);
  config.lidar.connect_timeout_s = 0.5;
  const std::string lidar = config.lidar.address.ToText();
  ASSERT_TRUE(SaveHeadConfig(config, config_));
  site_.reset();
  const ProgramResult result = RunProgram(
      FORESIGHT_HEAD, {"--head-config", config_, "--scan", Plan(-5, 5, 10), "--out", mission_});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors,
              testing::HasSubstr(fmt::format("motor {}:{}", config.motor.host, config.motor.port)));
}

}  // namespace
}  // namespace foresight
