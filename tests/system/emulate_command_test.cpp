// foresightctl emulate in one process, a head in another.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/support/running_program.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

TEST(EmulateCommand, AScanThroughTheNetworkOfTwoProcesses) {
  const TemporaryFolder folder;
  const std::string config = folder / "head.yaml";
  RunningProgram devices(FORESIGHTCTL, {"emulate", kRoomScene, "--head-config", config, "--json"});
  // Printed last, so that it says: they listen.
  ASSERT_TRUE(WaitUntil([&] { return devices.Output().find('}') != std::string::npos; }));
  const auto addresses = nlohmann::json::parse(devices.Output());
  EXPECT_THAT(addresses["lidar"].get<std::string>(), testing::StartsWith("127.0.0.1:"));
  const ProgramResult scan =
      RunProgram(FORESIGHTCTL, {"scan", "--head-config", config, "--from", "-3", "--to", "3",
                                "--out", folder / "mission.foresight", "--json"});
  EXPECT_EQ(scan.exit_code, 0) << scan.errors;
  EXPECT_EQ(nlohmann::json::parse(scan.output)["state"], "complete");
  devices.Signal(SIGINT);
  EXPECT_EQ(devices.Wait().exit_code, 0);
}

TEST(EmulateCommand, EndsByItselfWhenAsked) {
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"emulate", kRoomScene, "--seconds", "0.05"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, testing::StartsWith("lidar 127.0.0.1:"));
}

TEST(EmulateCommand, MovesTheScenesStandAsItIsTold) {
  const TemporaryFolder folder;
  const std::string scene = folder / "scene.yaml";
  std::ofstream(scene) << "foresight_scene: 1\nname: x\nmaterials: {paper: {}}\n"
                          "stands: [{name: s, a: 'checkerboard:7x6:50', material: paper}]\n"
                          "places: [{stand: s, position_m: [1, 0, 1]},\n"
                          "         {stand: s, position_m: [2, 0, 1]}]\n";
  const ProgramResult told = RunProgram(
      "/bin/sh", {"-c", "printf 'place 2\nplace 3\njump\n' | " + std::string(FORESIGHTCTL) +
                            " emulate " + scene + " --commands --seconds 1"});
  EXPECT_EQ(told.exit_code, 0) << told.errors;
  EXPECT_THAT(told.output, testing::HasSubstr("\nplace 2\nerror: scene 'x': there is no place 3; "
                                              "it has 2\nerror: 'jump' is no command"));
  const ProgramResult nowhere =
      RunProgram(FORESIGHTCTL, {"emulate", scene, "--stand-place", "3", "--seconds", "0.05"});
  EXPECT_EQ(nowhere.exit_code, 3);
  EXPECT_THAT(nowhere.errors, testing::HasSubstr("no place 3"));
}

TEST(EmulateCommand, RefusesBadAddressesAndFaultPlans) {
  const TemporaryFolder folder;
  const std::string faults = folder / "faults.yaml";
  std::ofstream(faults) << "foresight_faults: 1\nlidar: {stall_ratio: 2}\n";
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {"emulate", kRoomScene, "--lidar", "127.0.0.1:x"}).exit_code,
            2);
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {"emulate", kRoomScene, "--lidar", "8.8.8.8:1"}).exit_code, 3);
  const ProgramResult bad = RunProgram(FORESIGHTCTL, {"emulate", kRoomScene, "--faults", faults});
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_THAT(bad.errors, testing::HasSubstr("faults.yaml:2"));
}

}  // namespace
}  // namespace foresight
