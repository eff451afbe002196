// Every fault of every emulator in every state of the head, and from power-on.
#include <gtest/gtest.h>

#include <array>
#include <future>
#include <ostream>
#include <set>

#include "tests/hardware/fault_cell.h"

namespace foresight {

static void PrintTo(const HeadFault& fault, std::ostream* stream) {
  *stream << fault.device << ": " << fault.name;
}

namespace {

class FaultMatrix : public testing::TestWithParam<HeadFault> {};

/// The states run side by side: most of their time is waiting.
TEST_P(FaultMatrix, TheMotorStopsTheScanIsKeptAndTheHeadRecoversInEveryState) {
  std::array<std::future<FaultOutcome>, kHeadPhases> outcomes;
  for (int i = 0; i < kHeadPhases; ++i)
    outcomes[i] = std::async(std::launch::async, RunFaultCell, std::cref(GetParam()),
                             static_cast<HeadPhase>(i));
  for (int i = 0; i < kHeadPhases; ++i) {
    const FaultOutcome outcome = outcomes[i].get();
    for (const std::string& violation : outcome.violations)
      ADD_FAILURE() << "while " << ToString(static_cast<HeadPhase>(i)) << ": " << violation;
    EXPECT_FALSE(outcome.summary.empty());
  }
}

/// Several at once: most of their time is waiting, too.
TEST(PlannedFaults, TheMotorStopsAndTheScanIsKeptWhateverIsWrongFromPowerOn) {
  for (const auto& [fault, outcome] : RunPlannedFaults()) {
    for (const std::string& violation : outcome.violations)
      ADD_FAILURE() << fault->device << ", " << fault->name << ": " << violation;
    EXPECT_FALSE(outcome.summary.empty());
  }
}

TEST(PlannedFaults, AreAllThatTheEmulatorsKnow) {
  std::set<std::string> met;
  for (const PlannedFault& fault : PlannedFaults())
    for (const std::string& member : fault.members) met.insert(fault.device + "." + member);
  const std::vector<std::string> members = FaultPlanMembers();
  EXPECT_EQ(met, std::set<std::string>(members.begin(), members.end()));
}

INSTANTIATE_TEST_SUITE_P(All, FaultMatrix, testing::ValuesIn(HeadFaults()), [](const auto& test) {
  std::string name = test.param.device + "_" + test.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

}  // namespace
}  // namespace foresight
