#include "tests/workstation/killed_mission.h"

namespace foresight {
namespace {

TEST_F(KilledMission, KeepsEverythingThatWasShownAsKeptThreeTimes) {
  for (std::uint64_t seed = 2; seed <= 4; ++seed) KillAndCheck(seed);
  EXPECT_GE(interrupted_, 1);
}

TEST_F(KilledMission, KeepsEverythingThatWasShownAsKeptFiftyTimes) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) KillAndCheck(seed);
  std::printf("a whole mission takes %.1f s; %d of 50 kills cut a scan short\n", whole_mission_s_,
              interrupted_);
}

}  // namespace
}  // namespace foresight
