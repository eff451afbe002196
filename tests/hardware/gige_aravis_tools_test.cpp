// Foreign judges: the tools of Aravis read the emulated camera's description and receive its
// images.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/hardware/gige_bench.h"
#include "tests/support/run_program.h"

namespace foresight {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

class AravisTools : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* tool : {FORESIGHT_ARV_TOOL, FORESIGHT_ARV_CAMERA_TEST})
      if (!std::filesystem::exists(tool))
        GTEST_SKIP() << "the tools of Aravis are not installed: packaging/install-dependencies";
  }
  ProgramResult Tool(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"-a", bench.emulator->address()});
    return RunProgram(FORESIGHT_ARV_TOOL, arguments);
  }
  ProgramResult Stream(std::vector<std::string> arguments) const {
    // The options that our driver sets too, for machines that are busy with other tests.
    arguments.insert(arguments.begin(),
                     {"-n", bench.emulator->address(), "--no-packet-socket", "--duration=2",
                      "--auto", "--packet-request-ratio=1.0", "--frame-retention=500"});
    return RunProgram(FORESIGHT_ARV_CAMERA_TEST, arguments);
  }
  GigeBench bench;
};

TEST_F(AravisTools, FindEveryFeatureOfTheStandardsNames) {
  const ProgramResult result = Tool({"values"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("'Width' = 322"));
  EXPECT_THAT(result.output, HasSubstr("'Height' = 241"));
  EXPECT_THAT(result.output, HasSubstr("'PayloadSize' = 232806"));
  for (const char* name : {"PixelFormat", "ExposureTime", "Gain", "TriggerMode", "TriggerSource",
                           "TriggerSoftware", "AcquisitionMode", "AcquisitionStart",
                           "AcquisitionStop", "DeviceTemperature", "GevSCPSPacketSize"})
    EXPECT_THAT(result.output, HasSubstr(fmt::format("'{}'", name)));
}

TEST_F(AravisTools, WriteAnExposure) {
  const ProgramResult result = Tool({"control", "ExposureTime=2500", "ExposureTime"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, ContainsRegex("ExposureTime = 2500"));
}

TEST_F(AravisTools, ReceiveTriggeredImages) {
  const ProgramResult result = Stream({"--software-trigger=5"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, ContainsRegex("n_completed_buffers *= *[1-9]"));
  EXPECT_THAT(result.output, ContainsRegex("n_size_mismatch_errors *= *0"));
}

TEST_F(AravisTools, ReceiveImagesOfAFreelyRunningCameraInSpiteOfLostPackets) {
  bench.emulator->InjectPacketLoss(0.02);
  const ProgramResult result = Stream({});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, ContainsRegex("n_completed_buffers *= *[1-9]"));
  EXPECT_THAT(result.output, ContainsRegex("n_resent_packets *= *[1-9]"));
}

}  // namespace
}  // namespace foresight
