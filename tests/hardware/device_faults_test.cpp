#include "hardware/emulator/device_faults.h"

#include <gmock/gmock.h>

namespace foresight {
namespace {

TEST(DeviceFaults, AFileSaysWhatGoesWrongWithEachDevice) {
  const auto faults = DeviceFaultsFromYaml(
      "foresight_faults: 1\n"
      "lidar: {corrupt_ratio: 0.01, fragment_bytes: 7, clock_start_ms: 16777000}\n"
      "motor:\n"
      "  - {kind: dead_link, after_s: 3, duration_s: 0.4}\n"
      "  - {kind: blocked_shaft, after_s: 5}\n"
      "camera: {packet_loss_ratio: 0.05}\n",
      "faults.yaml", 9);
  ASSERT_TRUE(faults) << faults.error().message;
  EXPECT_EQ(faults->lidar.seed, 9u);
  EXPECT_EQ(faults->lidar.corrupt_fraction, 0.01);
  EXPECT_EQ(faults->lidar.fragment_bytes, 7);
  EXPECT_EQ(faults->lidar.clock_start_ms, 16777000u);
  const std::vector<MotorFault> motor = {{MotorFault::Kind::kDeadLink, 3.0, 0.4},
                                         {MotorFault::Kind::kBlockedShaft, 5.0, 0.5}};
  EXPECT_EQ(faults->motor, motor);
  EXPECT_EQ(faults->camera.seed, 9u);
  EXPECT_EQ(faults->camera.packet_loss_ratio, 0.05);
}

TEST(DeviceFaults, RatiosThatWereCalledSharesAreRead) {
  const auto faults = DeviceFaultsFromYaml(
      "foresight_faults: 1\n"
      "lidar: {corrupt_share: 0.01, reset_share: 0.02, stall_share: 0.03}\n"
      "camera: {packet_loss_share: 0.04, ignored_trigger_share: 0.05, slow_frame_share: 0.06}\n",
      "faults.yaml", 9);
  ASSERT_TRUE(faults) << faults.error().message;
  EXPECT_EQ(faults->lidar.corrupt_fraction, 0.01);
  EXPECT_EQ(faults->lidar.reset_fraction, 0.02);
  EXPECT_EQ(faults->lidar.stall_fraction, 0.03);
  EXPECT_EQ(faults->camera.packet_loss_ratio, 0.04);
  EXPECT_EQ(faults->camera.ignored_trigger_fraction, 0.05);
  EXPECT_EQ(faults->camera.slow_frame_fraction, 0.06);
}

TEST(DeviceFaults, RatiosOfAllNamesAreRead) {
  const auto faults = DeviceFaultsFromYaml(
      "foresight_faults: 1\n"
      "lidar: {corrupt_ratio: 0.01, reset_ratio: 0.02, stall_ratio: 0.03}\n"
      "camera: {packet_loss_ratio: 0.04, ignored_trigger_ratio: 0.05, slow_frame_ratio: 0.06}\n",
      "faults.yaml", 9);
  ASSERT_TRUE(faults) << faults.error().message;
  EXPECT_EQ(faults->lidar.corrupt_fraction, 0.01);
  EXPECT_EQ(faults->lidar.reset_fraction, 0.02);
  EXPECT_EQ(faults->lidar.stall_fraction, 0.03);
  EXPECT_EQ(faults->camera.packet_loss_ratio, 0.04);
  EXPECT_EQ(faults->camera.ignored_trigger_fraction, 0.05);
  EXPECT_EQ(faults->camera.slow_frame_fraction, 0.06);
}

TEST(DeviceFaults, RandomFaultsOfTheMotorFollowTheSeed) {
  const std::string yaml = "foresight_faults: 1\nrandom_motor: {mean_interval_s: 2, span_s: 60}\n";
  const auto first = DeviceFaultsFromYaml(yaml, "faults.yaml", 1).value().motor;
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(DeviceFaultsFromYaml(yaml, "faults.yaml", 1).value().motor, first);
  EXPECT_NE(DeviceFaultsFromYaml(yaml, "faults.yaml", 2).value().motor, first);
}

struct BadFaults {
  const char* yaml;
  const char* message;
};

class BadDeviceFaults : public testing::TestWithParam<BadFaults> {};

TEST_P(BadDeviceFaults, AreRefusedWithFileLineAndKey) {
  const auto faults = DeviceFaultsFromYaml(GetParam().yaml, "faults.yaml", 1);
  ASSERT_FALSE(faults);
  EXPECT_EQ(faults.error().code, ErrorCode::kBadData);
  EXPECT_THAT(faults.error().message, testing::HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadDeviceFaults,
    testing::Values(
        BadFaults{"foresight_faults: 1\nrandom_motor: {mean_interval_s: 1, span_s: 1.0e308}\n",
                  "faults.yaml:2: 'span_s' must be at most"},
        BadFaults{"foresight_faults: 1\nrandom_motor: {mean_interval_s: 0.1, span_s: 2.0e6}\n",
                  "faults.yaml:2: one fault in 0.1 s"},
        BadFaults{"foresight_faults: 1\nlidar: {stall_s: 1.0e308}\n", "faults.yaml:2: 'stall_s'"},
        BadFaults{"foresight_faults: 1\ncamera: {slow_s: 1.0e308}\n", "faults.yaml:2: 'slow_s'"},
        BadFaults{"lidar: {}\n", "faults.yaml:1: 'foresight_faults' is missing"},
        BadFaults{"foresight_faults: 2\n", "faults.yaml:1: 'foresight_faults' is 2"},
        BadFaults{"foresight_faults: 1\nlidar:\n  corrupt_ratio: 1.5\n", "corrupt_ratio"},
        BadFaults{"foresight_faults: 1\nlidar:\n  corupt_ratio: 0.5\n",
                  "faults.yaml:3: 'corupt_ratio' is not known here"},
        BadFaults{"foresight_faults: 1\nlidar:\n  corrupt_ratio: 0.1\n  corrupt_share: 0.1\n",
                  "faults.yaml:4: 'corrupt_share' is the old name of 'corrupt_ratio'"},
        BadFaults{"foresight_faults: 1\nlidar:\n  clock_start_ms: 16777216\n",
                  "faults.yaml:3: 'clock_start_ms'"},
        BadFaults{"foresight_faults: 1\nmotor:\n  - {kind: bored}\n",
                  "faults.yaml:3: 'kind' is one of blocked_shaft, lost_home_switch, dead_link, "
                  "stale_status, TCP_reset, encoder_offset; is 'bored'"},
        BadFaults{"foresight_faults: 1\nmotor:\n  - {kind: dead_link, after_s: -1}\n",
                  "faults.yaml:3: 'after_s' must not be negative, is -1"},
        BadFaults{"foresight_faults: 1\nrandom_motor: {mean_interval_s: 0}\n",
                  "faults.yaml:2: 'mean_interval_s'"},
        BadFaults{"foresight_faults: 1\ncamera: {first_block: 65536}\n",
                  "faults.yaml:2: 'first_block'"}));

}  // namespace
}  // namespace foresight
