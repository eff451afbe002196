#include "tests/workstation/killed_mission.h"

namespace foresight {
namespace {

TEST_F(KilledMission, KeepsEverythingThatWasShownAsKeptTwice) {
  for (const std::uint64_t in_a_sweep : {2, 4}) KillAndCheck(in_a_sweep);
  EXPECT_GE(interrupted_, 1);
}

TEST_F(KilledMission, KeepsEverythingThatWasShownAsKeptFiftyTimes) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) KillAndCheck(seed);
  std::printf("a whole mission takes %.1f s; %d of 50 kills cut a scan short\n", whole_mission_s_,
              interrupted_);
}

}  // namespace
}  // namespace foresight
