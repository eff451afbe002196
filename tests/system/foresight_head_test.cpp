// foresight-head as a process, its devices emulated here or in it.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/common/emulation.h"
#include "core/base/atomic_file.h"
#include "core/geometry/angles.h"
#include "core/mission/mission_file.h"
#include "core/mission/plan_json.h"
#include "hardware/motor/modbus_link.h"
#include "tests/hardware/emulated_head.h"
#include "tests/support/running_program.h"
#include "tests/support/sanitized.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

class ForesightHead : public testing::Test {
 protected:
  /// A file of the head that this build can emulate in real time.
  std::string RealTimeRig() {
    const std::string file = folder_ / "true_rig.yaml";
    EXPECT_TRUE(SaveSensorRig(RealTimeDevices().true_rig, file));
    return file;
  }
  /// The devices live in the test, which so knows what the motor does.
  void StartDevices() {
    EmulationArguments arguments;
    arguments.scene = kRoomScene;
    arguments.rig = RealTimeRig();
    devices_ = StartEmulation(arguments).value();
    ASSERT_TRUE(SaveHeadConfig(ConfigFor(*devices_), config_));
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
    return DegreesFromRadians(devices_->ShaftAngle(devices_->clock()->Now())) > 5.0 &&
           devices_->camera().counts().frames > 0;
  }

  TemporaryFolder folder_;
  std::string config_ = folder_ / "head.yaml";
  std::string mission_ = folder_ / "mission.foresight";
  std::unique_ptr<EmulatedDevices> devices_;
};

TEST_F(ForesightHead, FliesAPlanThroughItsOwnEmulatedDevices) {
  const ProgramResult result =
      RunProgram(FORESIGHT_HEAD, {"--emulate", kRoomScene, "--rig", RealTimeRig(), "--seed", "4",
                                  "--scan", Plan(-5, 5, 10), "--out", mission_, "--json"});
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
  if (kSanitized) GTEST_SKIP() << "a sanitizer's time says nothing about the program's";
  StartDevices();
  const ProgramResult result = RunProgram(
      FORESIGHT_HEAD,
      {"--head-config", config_, "--scan", Plan(-20, 20, 10), "--out", mission_, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.output);
  RecordProperty("cpu_ratio", json["cpu_ratio"].dump());
  EXPECT_LT(json["cpu_ratio"].get<double>(), 0.6) << "over " << json["seconds"] << " s";
}

TEST_F(ForesightHead, ATerminatedSweepIsKeptAndMarkedAndTheMotorStops) {
  StartDevices();
  RunningProgram head(FORESIGHT_HEAD, {"--head-config", config_, "--scan", Plan(-5, 60, 10),
                                       "--out", mission_, "--json"});
  ASSERT_TRUE(WaitUntil([&] { return DeepInTheSweep(); }));
  head.Signal(SIGTERM);
  const ProgramResult result = head.Wait();
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  EXPECT_FALSE(devices_->MotorTurns());
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
  EXPECT_TRUE(WaitUntil([&] { return !devices_->MotorTurns(); }, 3.0));
  const Scan scan = RecordedScan();
  EXPECT_EQ(scan.state, ScanState::kInterrupted);
  EXPECT_GE(scan.lines.size(), 30u);
}

/// Somebody else who reads the drive's registers all the time, as a monitor does.
class Monitor {
 public:
  explicit Monitor(const TcpAddress& address)
      : thread_([address](const std::stop_token& stop) {
          ModbusLink link(address.host, address.port, std::chrono::milliseconds(200));
          cia402::TxImage::Registers registers{};
          if (link.Connect())
            while (!stop.stop_requested() && link.Read(cia402::TxImage::kFirst, registers))
              std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }) {}

 private:
  std::jthread thread_;
};

TEST_F(ForesightHead, AMonitorDoesNotKeepTheMotorOfAKilledHeadTurning) {
  StartDevices();
  const Monitor monitor(devices_->motor().address());
  RunningProgram head(FORESIGHT_HEAD,
                      {"--head-config", config_, "--scan", Plan(-5, 60, 10), "--out", mission_});
  ASSERT_TRUE(WaitUntil([&] { return DeepInTheSweep(); }));
  head.Signal(SIGKILL);
  EXPECT_EQ(head.Wait().exit_code, 128 + SIGKILL);
  // At 10 deg/s the sweep would take five seconds more.
  EXPECT_TRUE(WaitUntil([&] { return !devices_->MotorTurns(); }, 3.0));
}

TEST_F(ForesightHead, FarFewerLinesThanPlannedAreInterruptedWithTheCounts) {
  const std::string faults = folder_ / "faults.yaml";
  ASSERT_TRUE(WriteFileAtomically(faults, "foresight_faults: 1\nlidar: {corrupt_ratio: 0.5}\n"));
  const ProgramResult result = RunProgram(
      FORESIGHT_HEAD,
      {"--emulate", kRoomScene, "--faults", faults, "--scan", Plan(-5, 5, 10), "--out", mission_});
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  const Scan scan = RecordedScan();
  EXPECT_EQ(scan.state, ScanState::kInterrupted);
  EXPECT_THAT(scan.reason, testing::StartsWith(fmt::format(
                               "{} of 41 planned lines came from the lidar: ", scan.lines.size())));
  EXPECT_THAT(scan.reason, testing::HasSubstr("had a bad check sum"));
  EXPECT_EQ(result.output, fmt::format("{}: scan 1 interrupted, {} lines, 1 image: {}\n", mission_,
                                       scan.lines.size(), scan.reason));
  const ProgramResult depth =
      RunProgram(FORESIGHTCTL, {"depth", mission_, "--out", folder_ / "depth", "--json"});
  EXPECT_THAT(depth.errors, testing::HasSubstr("warning: " + mission_ +
                                               ": scan 1 is interrupted: " + scan.reason));
  EXPECT_EQ(nlohmann::json::parse(depth.output)["scan_state"], "interrupted");
}

TEST_F(ForesightHead, AnEncoderThatIsOffByEightyDegreesIsAFaultAndNoCompleteScan) {
  StartDevices();
  RunningProgram head(FORESIGHT_HEAD,
                      {"--head-config", config_, "--scan", Plan(-5, 60, 10), "--out", mission_});
  ASSERT_TRUE(WaitUntil([&] { return DeepInTheSweep(); }));
  devices_->motor().Inject({MotorFault::Kind::kEncoderOffset, 0.0, 60.0});
  const ProgramResult result = head.Wait();
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors, testing::HasSubstr("motor " + devices_->motor().address().ToText() +
                                                ": its encoder jumped from"));
  EXPECT_FALSE(devices_->MotorTurns());
  const Scan scan = RecordedScan();
  EXPECT_EQ(scan.state, ScanState::kInterrupted);
  EXPECT_THAT(scan.reason, testing::HasSubstr("its encoder jumped from"));
}

/// `program` with files of at most so many blocks of 512 bytes, as on a full disk.
ProgramResult RunWithSmallFiles(int blocks, const std::string& program,
                                const std::vector<std::string>& arguments) {
  std::string command = fmt::format("ulimit -f {}; exec '{}'", blocks, program);
  for (const std::string& argument : arguments) command += " '" + argument + "'";
  return RunProgram("/bin/sh", {"-c", command});
}

TEST_F(ForesightHead, ADiskThatFillsUpEndsTheSweepAndKeepsWhatIsThere) {
  // Room for the image, which is taken at the beginning, and for some of the 401 lines.
  const ProgramResult result =
      RunWithSmallFiles(6000, FORESIGHT_HEAD,
                        {"--emulate", kRoomScene, "--scan", Plan(-5, 60, 6.5), "--out", mission_});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors, testing::ContainsRegex("[0-9]+ of 401 lines were kept"));
  const Scan scan = RecordedScan();
  EXPECT_THAT(result.errors,
              testing::HasSubstr(fmt::format(": {} of 401 lines", scan.lines.size())));
  EXPECT_EQ(scan.state, ScanState::kInterrupted);
  EXPECT_GE(scan.lines.size(), 20u);
  EXPECT_LT(scan.lines.size(), 300u);
}

TEST_F(ForesightHead, ADiskWithoutRoomForAMissionLeavesNothingInTheWay) {
  const std::vector<std::string> arguments = {"--emulate",       kRoomScene, "--scan",
                                              Plan(-5, 5, 10.0), "--out",    mission_};
  const ProgramResult full = RunWithSmallFiles(16, FORESIGHT_HEAD, arguments);
  EXPECT_EQ(full.exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(mission_)) << full.errors;
  EXPECT_FALSE(std::filesystem::exists(mission_ + "-wal"));
}

TEST_F(ForesightHead, AnEmptyDatabaseOfAnEarlierFailureIsReplaced) {
  // The first page of a database in which no table was made.
  std::string stub(8192, '\0');
  stub.replace(0, 16, std::string("SQLite format 3\0", 16));
  stub[100] = 0x0D;
  ASSERT_TRUE(WriteFileAtomically(mission_, stub));
  const ProgramResult result = RunProgram(
      FORESIGHT_HEAD, {"--emulate", kRoomScene, "--scan", Plan(-5, 5, 10), "--out", mission_});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(RecordedScan().state, ScanState::kComplete);
}

TEST_F(ForesightHead, AFileThatIsNoMissionIsLeftAlone) {
  ASSERT_TRUE(WriteFileAtomically(mission_, "a letter"));
  const ProgramResult result = RunProgram(
      FORESIGHT_HEAD, {"--emulate", kRoomScene, "--scan", Plan(-5, 5, 10), "--out", mission_});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(ReadFile(mission_).value(), "a letter");
}

TEST_F(ForesightHead, PutsAnotherCalibrationInForce) {
  SensorRig rig = DefaultSensorRig();
  rig.lidar.range_offset_m = 0.0123;
  const std::string file = folder_ / "rig.yaml";
  ASSERT_TRUE(SaveSensorRig(rig, file));
  const ProgramResult result =
      RunProgram(FORESIGHT_HEAD, {"--emulate", kRoomScene, "--calibration", file, "--scan",
                                  Plan(-5, 5, 10), "--out", mission_});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NEAR(RecordedScan().rig.lidar.range_offset_m, 0.0123, 1e-9);
}

TEST_F(ForesightHead, ALidarThatDiesInTheSweepIsAFaultThatKeepsTheScan) {
  StartDevices();
  RunningProgram head(FORESIGHT_HEAD,
                      {"--head-config", config_, "--scan", Plan(-5, 60, 10), "--out", mission_});
  ASSERT_TRUE(WaitUntil([&] { return DeepInTheSweep(); }));
  devices_->lidar().InjectSilence(60.0);
  const ProgramResult result = head.Wait();
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors, testing::HasSubstr("lidar " + devices_->lidar().address().ToText()));
  EXPECT_FALSE(devices_->MotorTurns());
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
  EXPECT_EQ(run({"--scan", plan, "--emulate", kRoomScene, "--head-config", config_}).exit_code, 2);
  EXPECT_EQ(run({"--scan", plan, "--head-config", config_, "--seed", "2"}).exit_code, 2);
  ASSERT_TRUE(WriteFileAtomically(config_, "foresight_head: 1\nlidar: {adress: 10.0.0.1}\n"));
  const ProgramResult bad = run({"--scan", plan, "--head-config", config_});
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_THAT(bad.errors, testing::HasSubstr("head.yaml:2: 'address' is missing"));
  EXPECT_FALSE(std::filesystem::exists(mission_));
}

TEST_F(ForesightHead, SaysWhichDeviceIsNotThere) {
  StartDevices();
  HeadConfig config = ConfigFor(*devices_);
  config.lidar.connect_timeout_s = 0.5;
  const std::string lidar = config.lidar.address.ToText();
  ASSERT_TRUE(SaveHeadConfig(config, config_));
  devices_.reset();
  const ProgramResult result = RunProgram(
      FORESIGHT_HEAD, {"--head-config", config_, "--scan", Plan(-5, 5, 10), "--out", mission_});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors,
              testing::HasSubstr(fmt::format("motor {}:{}", config.motor.host, config.motor.port)));
  EXPECT_FALSE(std::filesystem::exists(mission_)) << "it holds no scan";
}

}  // namespace
}  // namespace foresight
