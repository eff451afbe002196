#include "hardware/assembly/head_config.h"

#include <gmock/gmock.h>

#include "core/base/atomic_file.h"
#include "core/geometry/angles.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

const std::string kHeads = FORESIGHT_SOURCE_DIR "/resources/heads/";

/// Line 1 to 4; tests add to it.
const std::string kLeast =
    "foresight_head: 1\n"
    "lidar: {address: 10.0.0.1}\n"
    "motor: {address: 10.0.0.2}\n"
    "camera: {address: 10.0.0.3}\n";

TEST(HeadConfig, TheThreeAddressesAreEnough) {
  const auto config = HeadConfigFromYaml(kLeast, "head.yaml", "");
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(config->lidar.address, (TcpAddress{"10.0.0.1", 10940}));
  EXPECT_EQ(config->motor.host, "10.0.0.2");
  EXPECT_EQ(config->motor.port, 502);
  EXPECT_EQ(config->camera.address, "10.0.0.3");
  EXPECT_FALSE(config->simulated);
}

TEST(HeadConfig, TheShippedExamplesAreValid) {
  const auto real = LoadHeadConfig(kHeads + "drc.yaml");
  ASSERT_TRUE(real) << real.error().message;
  EXPECT_EQ(real->lidar.address.ToText(), "192.168.0.10:10940");
  EXPECT_FALSE(real->capture.simulated);
  const auto emulated = LoadHeadConfig(kHeads + "emulated.yaml");
  ASSERT_TRUE(emulated) << emulated.error().message;
  EXPECT_TRUE(emulated->capture.simulated);
}

TEST(HeadConfig, TheCommentsOfTheRealExampleSayTheDefaults) {
  HeadConfig from_example = LoadHeadConfig(kHeads + "drc.yaml").value();
  HeadConfig least = HeadConfigFromYaml(kLeast, "head.yaml", "").value();
  least.name = from_example.name;
  least.lidar.address = from_example.lidar.address;
  least.motor.host = from_example.motor.host;
  least.camera.address = from_example.camera.address;
  EXPECT_EQ(HeadConfigToYaml(from_example, "r"), HeadConfigToYaml(least, "r"));
}

TEST(HeadConfig, WhatIsWrittenReadsBackTheSame) {
  const TemporaryFolder folder;
  HeadConfig config = HeadConfigFromYaml(kLeast, "head.yaml", "").value();
  config.name = "head 7";
  config.simulated = true;
  config.rig.name = "another";
  config.lidar.data = ScipLidarOptions::Data::kStrongestEcho;
  config.lidar.stamp_offset_s = 0.00313;
  config.motor.word_order = cia402::WordOrder::kLowFirst;
  config.motor.min_angle_rad = RadiansFromDegrees(-40.0);
  config.motor.response_timeout = std::chrono::milliseconds(150);
  config.camera.format = GigeCameraOptions::Format::kMono8;
  config.exposure.gain_db = 6.0;
  config.capture.lidar_timeout_s = 2.0;
  const std::string file = folder / "head.yaml";
  ASSERT_TRUE(SaveHeadConfig(config, file));
  const auto read = LoadHeadConfig(file);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(HeadConfigToYaml(*read, "r"), HeadConfigToYaml(config, "r"));
  EXPECT_EQ(read->rig.name, "another");
  EXPECT_EQ(read->capture.description, "head 7");
}

TEST(HeadConfig, TheCaptureKnowsTheAccelerationOfTheMotor) {
  const auto config = HeadConfigFromYaml(
      "foresight_head: 1\nlidar: {address: a}\nmotor: {address: b, acceleration_deg_s2: 100}\n"
      "camera: {address: 10.0.0.3}\n",
      "head.yaml", "");
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_DOUBLE_EQ(config->capture.acceleration_rad_s2, RadiansFromDegrees(100.0));
}

TEST(HeadConfig, ARigIsSoughtBesideTheFileAndItsFaultsAreNamed) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "head.yaml", kLeast + "rig: my.yaml\n"));
  const auto missing = LoadHeadConfig(folder / "head.yaml");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, testing::HasSubstr("head.yaml:5: 'rig': "));
  EXPECT_THAT(missing.error().message, testing::HasSubstr("my.yaml"));
  SensorRig rig = DefaultSensorRig();
  rig.lidar.beams = 721;
  ASSERT_TRUE(SaveSensorRig(rig, folder / "my.yaml"));
  const auto config = LoadHeadConfig(folder / "head.yaml");
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(config->lidar.last_step, 720);
}

struct BadValue {
  const char* device;  ///< whose mapping gets the line
  const char* line;
  const char* message;
};

class BadHeadConfig : public testing::TestWithParam<BadValue> {};

/// A valid file with one key a line; the bad one is the last of its device.
std::string FileWith(const BadValue& bad) {
  std::string yaml = "foresight_head: 1\n";
  for (const std::string device : {"lidar", "motor", "camera", "capture"}) {
    yaml += device + ":\n";
    if (device == "capture")
      yaml += "  settle_s: 0.05\n";
    else if (bad.line != std::string("") || device != bad.device)
      yaml += "  address: 10.0.0.1\n";
    if (device == bad.device) yaml += std::string("  ") + bad.line + "\n";
  }
  return yaml;
}

TEST_P(BadHeadConfig, IsRefusedWithFileLineAndKey) {
  const auto config = HeadConfigFromYaml(FileWith(GetParam()), "head.yaml", "");
  ASSERT_FALSE(config);
  EXPECT_EQ(config.error().code, ErrorCode::kBadData);
  const std::string device = GetParam().device;
  const int line = device == "lidar" ? 4 : device == "motor" ? 6 : device == "camera" ? 8 : 10;
  EXPECT_THAT(config.error().message, testing::StartsWith(fmt::format("head.yaml:{}: ", line)));
  EXPECT_THAT(config.error().message, testing::HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Values, BadHeadConfig,
    testing::Values(
        BadValue{"lidar", "data: colour", "'data' is one of range, range_intensity"},
        BadValue{"lidar", "stamp_offset_s: 3", "'stamp_offset_s' must be from -0.1 to 0.1, is 3"},
        BadValue{"lidar", "stall_s: 0", "'stall_s'"}, BadValue{"lidar", "lost_s: -1", "'lost_s'"},
        BadValue{"lidar", "connect_timeout_s: soon", "'connect_timeout_s' is not a finite number"},
        BadValue{"lidar", "boot_timeout_s: .inf", "'boot_timeout_s' is not a finite number"},
        BadValue{"lidar", "adress: 10.0.0.1", "'adress' is not known here"},
        BadValue{"motor", "word_order: middle", "'word_order' is one of high_first, low_first"},
        BadValue{"motor", "counts_per_turn: 1.5", "'counts_per_turn' is not a whole number"},
        BadValue{"motor", "counts_per_turn: 0", "'counts_per_turn' must be from 360"},
        BadValue{"motor", "min_angle_deg: -200", "'min_angle_deg'"},
        BadValue{"motor", "max_angle_deg: 181", "'max_angle_deg'"},
        BadValue{"motor", "max_speed_deg_s: 0", "'max_speed_deg_s'"},
        BadValue{"motor", "acceleration_deg_s2: -400", "'acceleration_deg_s2'"},
        BadValue{"motor", "poll_rate_hz: 10", "'poll_rate_hz'"},
        BadValue{"motor", "response_timeout_s: 0", "'response_timeout_s'"},
        BadValue{"motor", "homing: {edge_deg_s: 90}", "'edge_deg_s'"},
        BadValue{"motor", "homing: {metod: 20}", "'metod' is not known here"},
        BadValue{"camera", "pixel_format: YUV422", "'pixel_format' is one of Mono8"},
        BadValue{"camera", "exposure_s: 0", "'exposure_s'"},
        BadValue{"camera", "gain_db: 60", "'gain_db'"},
        BadValue{"camera", "packet_bytes: 10000", "'packet_bytes'"},
        BadValue{"camera", "packet_delay_s: 1", "'packet_delay_s'"},
        BadValue{"camera", "frame_timeout_s: 0", "'frame_timeout_s'"},
        BadValue{"capture", "lidar_timeout_s: 0", "'lidar_timeout_s'"},
        BadValue{"capture", "travel_speed_deg_s: 1000", "'travel_speed_deg_s'"}));

/// Faults that are not a value of one key.
TEST(HeadConfig, AFileThatIsNoHeadIsRefused) {
  const auto message = [](const std::string& yaml) {
    const auto config = HeadConfigFromYaml(yaml, "head.yaml", "");
    return config ? std::string("accepted") : config.error().message;
  };
  EXPECT_EQ(message(""), "head.yaml:1: expected a mapping (key: value)");
  EXPECT_EQ(message("foresight_rig: 1\n"), "head.yaml:1: 'foresight_head' is missing");
  EXPECT_THAT(message("foresight_head: 2\n"), testing::HasSubstr("this program knows version 1"));
  EXPECT_EQ(message("foresight_head: 1\nlidar: {}\n"), "head.yaml:2: 'address' is missing");
  EXPECT_EQ(message("foresight_head: 1\nlidar: {address: a}\n"), "head.yaml:1: 'motor' is missing");
  EXPECT_THAT(message("foresight_head: 1\nlidar: {address: \"a:b\"}\n"),
              testing::HasSubstr("head.yaml:2: 'address': address a:b: 'b' is no port number"));
  EXPECT_THAT(message("foresight_head: 1\nlidar: {address: \"a:0\"}\n"),
              testing::HasSubstr("port 0"));
  EXPECT_THAT(message("foresight_head: 1\nlidar: {address: a}\n"
                      "motor: {address: b, min_angle_deg: 30, max_angle_deg: 20}\n"),
              testing::HasSubstr("head.yaml:3: motor: min_angle_rad"));
  EXPECT_THAT(message(kLeast + "lydar: {}\n"),
              testing::HasSubstr("head.yaml:5: 'lydar' is not known here"));
  EXPECT_THAT(message("foresight_head: [1\n"), testing::StartsWith("head.yaml:2: "));
}

}  // namespace
}  // namespace foresight
