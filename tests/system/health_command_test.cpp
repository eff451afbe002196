// foresightctl health: the devices of a head as a stream of lines.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "app/common/emulation.h"
#include "tests/support/running_program.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(HealthCommand, SaysOnceASecondHowTheDevicesDo) {
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"health", "--emulate", kRoomScene, "--seconds", "2"});
  EXPECT_EQ(result.exit_code, 0) << result.output << result.errors;
  const auto lines = Lines(result.output);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_THAT(lines.back(), testing::HasSubstr("lidar well: "));
  EXPECT_THAT(lines.back(), testing::HasSubstr("camera well: 0 images, 0 lost"));
  EXPECT_THAT(lines.back(), testing::HasSubstr("motor well: "));
}

TEST(HealthCommand, AsJsonEachLineIsAnObject) {
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"health", "--emulate", kRoomScene, "--seconds", "2", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.output << result.errors;
  const auto lines = Lines(result.output);
  ASSERT_EQ(lines.size(), 2u);
  const auto json = nlohmann::json::parse(lines.back());
  EXPECT_EQ(json["condition"], "well");
  // 40 Hz, on a machine with other work to do.
  EXPECT_NEAR(json["lidar"]["line_rate_hz"].get<double>(), 40.0, 10.0);
  EXPECT_TRUE(json["motor"]["connected"]);
}

TEST(HealthCommand, ADamagedLineIsADegradedLidar) {
  const TemporaryFolder folder;
  const std::string faults = folder / "faults.yaml";
  std::ofstream(faults) << "foresight_faults: 1\nlidar: {corrupt_ratio: 0.2}\n";
  const ProgramResult result = RunProgram(
      FORESIGHTCTL, {"health", "--emulate", kRoomScene, "--faults", faults, "--seconds", "2"});
  EXPECT_EQ(result.exit_code, 1) << result.output << result.errors;
  EXPECT_THAT(result.output, testing::HasSubstr("lidar degraded: "));
  EXPECT_THAT(result.output, testing::HasSubstr("damaged replies: "));
}

/// A configuration that points at devices, some of which are gone.
class HealthOfOtherDevices : public testing::Test {
 protected:
  HealthOfOtherDevices() {
    EmulationArguments arguments;
    arguments.scene = kRoomScene;
    devices_ = StartEmulation(arguments).value();
    config_ = ConfigFor(*devices_);
    config_.lidar.connect_timeout_s = 0.5;
    config_.camera.connect_timeout_s = 0.5;
  }
  ProgramResult Run() {
    EXPECT_TRUE(SaveHeadConfig(config_, file_));
    return RunProgram(FORESIGHTCTL, {"health", "--head-config", file_, "--seconds", "1"});
  }

  TemporaryFolder folder_;
  std::string file_ = folder_ / "head.yaml";
  std::unique_ptr<EmulatedDevices> devices_;
  HeadConfig config_;
};

TEST_F(HealthOfOtherDevices, AMissingDeviceIsNamedAndTheOthersAreStillShown) {
  config_.lidar.address.port = 1;
  const ProgramResult result = Run();
  EXPECT_EQ(result.exit_code, 1) << result.output << result.errors;
  EXPECT_THAT(result.output, testing::StartsWith("lidar missing: not connected"));
  EXPECT_THAT(result.output, testing::HasSubstr("motor well: "));
  EXPECT_THAT(result.errors, testing::HasSubstr("lidar 127.0.0.1:1"));
}

TEST_F(HealthOfOtherDevices, WithNoDeviceAtAllThereIsNothingToSay) {
  devices_.reset();
  const ProgramResult result = Run();
  EXPECT_EQ(result.exit_code, 3) << result.output << result.errors;
  EXPECT_EQ(result.output, "");
  EXPECT_THAT(result.errors, testing::HasSubstr("camera "));
}

}  // namespace
}  // namespace foresight
