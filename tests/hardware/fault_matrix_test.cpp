// Every fault of every emulator in every state of the head.
#include <gtest/gtest.h>

#include <array>
#include <future>
#include <ostream>

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

INSTANTIATE_TEST_SUITE_P(All, FaultMatrix, testing::ValuesIn(HeadFaults()), [](const auto& test) {
  std::string name = test.param.device + "_" + test.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

}  // namespace
}  // namespace foresight
