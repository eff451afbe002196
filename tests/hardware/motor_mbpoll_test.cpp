// A foreign judge: mbpoll reads and writes the emulated drive's registers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/hardware/motor_bench.h"
#include "tests/support/run_program.h"

namespace foresight {
namespace {

using testing::ContainsRegex;

class Mbpoll : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(FORESIGHT_MBPOLL))
      GTEST_SKIP() << "mbpoll is not installed: packaging/install-dependencies";
  }
  ProgramResult Run(std::vector<std::string> arguments) const {
    std::vector<std::string> all = {"-m", "tcp", "-0",
                                    "-1", "-p",  std::to_string(bench.emulator->address().port)};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return RunProgram(FORESIGHT_MBPOLL, all);
  }
  MotorBench bench;
};

TEST_F(Mbpoll, ReadsTheStatusword) {
  const ProgramResult result = Run({"-r", "5000", "-t", "4:hex", "127.0.0.1"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, ContainsRegex("\\[5000\\]:[^0]*0x0650"));
}

TEST_F(Mbpoll, ReadsThePositionThatTheDriverSees) {
  ASSERT_TRUE(bench.Home() && bench.Go(-3.0, 60.0) && bench.WaitForRest());
  const std::int32_t position = bench.emulator->State().position;
  EXPECT_NEAR(position, -150, 2);
  const ProgramResult result = Run({"-r", "5002", "-t", "4:int", "-B", "127.0.0.1"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, ContainsRegex(fmt::format("\\[5002\\]:[^-]*{}", position)));
}

TEST_F(Mbpoll, WritesATarget) {
  const ProgramResult written =
      Run({"-r", "6002", "-t", "4:int", "-B", "127.0.0.1", "--", "-1500"});
  EXPECT_EQ(written.exit_code, 0) << written.errors;
  const ProgramResult result = Run({"-r", "6002", "-c", "2", "-t", "4:hex", "127.0.0.1"});
  EXPECT_THAT(result.output, ContainsRegex("\\[6002\\]:[^0]*0xFFFF"));
  EXPECT_THAT(result.output, ContainsRegex("\\[6003\\]:[^0]*0xFA24"));
}

TEST_F(Mbpoll, IsToldThatARegisterIsNotThere) {
  const ProgramResult result = Run({"-r", "5010", "-t", "4", "127.0.0.1"});
  EXPECT_THAT(result.output + result.errors, ContainsRegex("Illegal data address"));
}

}  // namespace
}  // namespace foresight
