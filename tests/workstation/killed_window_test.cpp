#include "tests/workstation/killed_mission.h"

namespace foresight {
namespace {

struct KilledWindow : KilledMission {
  KilledWindow() : KilledMission({"--window"}) {}
};

TEST_F(KilledWindow, KeepsEverythingThatItShowedAsKeptFiftyTimes) {
  for (std::uint64_t seed = 101; seed <= 150; ++seed) KillAndCheck(seed);
  std::printf("a whole mission takes %.1f s; %d of 50 kills cut a scan short\n", whole_mission_s_,
              interrupted_);
  EXPECT_GE(interrupted_, 10);
}

}  // namespace
}  // namespace foresight
