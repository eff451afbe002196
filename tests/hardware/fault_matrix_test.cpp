// Every fault of every emulator in every state of the head, and from power-on.
#include <gtest/gtest.h>

#include <future>
#include <iostream>
#include <ostream>
#include <set>
#include <vector>

#include "tests/hardware/fault_cell.h"

namespace foresight {

static void PrintTo(const HeadFault& fault, std::ostream* stream) {
  *stream << fault.device << ": " << fault.name;
}

namespace {

class FaultMatrix : public testing::TestWithParam<HeadFault> {};

/// The states run side by side: most of their time is waiting.
void ExpectWellIn(const std::vector<HeadPhase>& phases, const HeadFault& fault,
                  HeadAccess access = HeadAccess::kDirect) {
  std::vector<std::future<FaultOutcome>> outcomes;
  for (const HeadPhase phase : phases)
    outcomes.push_back(
        std::async(std::launch::async, RunFaultCell, std::cref(fault), phase, access));
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const FaultOutcome outcome = outcomes[i].get();
    for (const std::string& violation : outcome.violations)
      ADD_FAILURE() << "while " << ToString(phases[i]) << ": " << violation;
    EXPECT_FALSE(outcome.summary.empty());
    std::cout << "while " << ToString(phases[i]) << ": " << outcome.effects << " effects; "
              << outcome.summary << "\n";
  }
}

TEST_P(FaultMatrix, TheMotorStopsTheScanIsKeptAndTheHeadRecoversInEveryState) {
  ExpectWellIn({HeadPhase::kConnecting, HeadPhase::kHoming, HeadPhase::kReady, HeadPhase::kSweeping,
                HeadPhase::kStopping},
               GetParam());
}

TEST_P(FaultMatrix, TheHeadRecoversAlsoFromAFaultBeforeItIsConnectedOrInFault) {
  ExpectWellIn({HeadPhase::kDisconnected, HeadPhase::kFault}, GetParam());
}

TEST_P(FaultMatrix, TheSameHoldsAtTheFarEndOfALink) {
  ExpectWellIn({HeadPhase::kDisconnected, HeadPhase::kConnecting, HeadPhase::kHoming,
                HeadPhase::kReady, HeadPhase::kSweeping, HeadPhase::kStopping, HeadPhase::kFault},
               GetParam(), HeadAccess::kLinked);
}

TEST(HeadFaults, AreMetInMostStates) {
  int met = 0;
  for (const HeadFault& fault : HeadFaults())
    met += kHeadPhases - static_cast<int>(fault.unmet.size());
  EXPECT_GT(met, static_cast<int>(HeadFaults().size()) * kHeadPhases * 3 / 4);
}

/// Several at once: most of their time is waiting, too.
TEST(PlannedFaults, TheMotorStopsAndTheScanIsKeptWhateverIsWrongFromPowerOn) {
  for (const auto& [fault, outcome] : RunPlannedFaults()) {
    for (const std::string& violation : outcome.violations)
      ADD_FAILURE() << fault->device << ", " << fault->name << ": " << violation;
    EXPECT_FALSE(outcome.summary.empty());
    std::cout << fault->device << ", " << fault->name << ": " << outcome.effects << " effects; "
              << outcome.summary << "\n";
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
