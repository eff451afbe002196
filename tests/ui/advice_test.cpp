#include "ui/viewmodels/advice.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

/// A confirmed wheel with an alternative that is 275 nats behind.
FoundObject ConfirmedValve() {
  ValveDetection valve;
  valve.verdict = {VerdictLevel::kConfirmed, 0.997, "All agree.", {}};
  valve.alternatives = {valve.best};
  valve.alternatives[0].log_likelihood = valve.best.log_likelihood - 275.0;
  FoundObject object;
  object.detection = valve;
  return object;
}

TEST(Advice, OnlyALiveCurrentWinningAnswerIsGoodToActOn) {
  const FoundObject valve = ConfirmedValve();
  EXPECT_TRUE(AdviceFor(valve, 0, true, SessionMode::kLive).text.startsWith("Good to act on."));
  EXPECT_FALSE(AdviceFor(valve, 1, true, SessionMode::kLive).text.contains("Good"));
  EXPECT_FALSE(AdviceFor(valve, 0, false, SessionMode::kLive).text.contains("Good"));
  EXPECT_FALSE(AdviceFor(valve, 0, true, SessionMode::kReplay).text.contains("Good"));
  EXPECT_TRUE(AdviceFor(valve, 0, true, SessionMode::kSimulation).text.contains("simulation"));
}

TEST(Advice, AnAlternativeDoesNotBorrowTheTrustOfTheBestAnswer) {
  const FoundObject valve = ConfirmedValve();
  const Advice best = AdviceFor(valve, 0, true, SessionMode::kLive);
  const Advice other = AdviceFor(valve, 1, true, SessionMode::kLive);
  EXPECT_EQ(best.badge.toStdString(), "CONFIRMED, over 99 %");
  EXPECT_EQ(other.badge.toStdString(), "ALTERNATIVE");
  EXPECT_EQ(other.level, VerdictLevel::kUnsure);
  EXPECT_TRUE(other.text.startsWith("Do not act"));
  EXPECT_TRUE(ReasonFor(valve.detection, 1).isEmpty());
}

TEST(Advice, NobodyIsToldToStepThroughAlternativesThatAreNone) {
  FoundObject valve = ConfirmedValve();
  auto& found = std::get<ValveDetection>(valve.detection);
  found.verdict.level = VerdictLevel::kLikely;
  const auto says_so = [&] {
    return AdviceFor(valve, 0, true, SessionMode::kLive).text.contains("alternatives");
  };
  EXPECT_TRUE(says_so());
  found.alternatives.clear();
  EXPECT_FALSE(says_so());
}

TEST(StateText, AnAcceptedAlternativeDoesNotBorrowTheVerdictOfTheBestAnswer) {
  FoundObject valve = ConfirmedValve();
  EXPECT_EQ(StateText(valve, true).toStdString(), "CONFIRMED");
  valve.decision = Decision::kAccepted;
  EXPECT_EQ(StateText(valve, false).toStdString(), "accepted, CONFIRMED, earlier scan");
  valve.decided_candidate = 1;
  EXPECT_EQ(StateText(valve, true).toStdString(), "accepted: alternative 1, although UNSURE");
  auto& found = std::get<ValveDetection>(valve.detection);
  found.alternatives[0].log_likelihood = found.best.log_likelihood;  // about as likely
  EXPECT_EQ(StateText(valve, true).toStdString(), "accepted: alternative 1");
  found.verdict.level = VerdictLevel::kUnsure;
  valve.decided_candidate = 0;
  EXPECT_EQ(StateText(valve, true).toStdString(), "accepted, although UNSURE");
}

TEST(StateText, ATerrainWithoutASurfaceIsUnsureAndNotWithoutAWord) {
  FoundObject terrain;
  TerrainDetection nothing;
  nothing.verdict.level = VerdictLevel::kUnsure;
  terrain.detection = nothing;
  EXPECT_EQ(StateText(terrain, true).toStdString(), "UNSURE");
}

TEST(Advice, WhatWasRejectedIsNotAdvised) {
  FoundObject valve = ConfirmedValve();
  valve.decision = Decision::kRejected;
  EXPECT_FALSE(AdviceFor(valve, 0, true, SessionMode::kLive).text.contains("Good"));
}

}  // namespace
}  // namespace foresight
