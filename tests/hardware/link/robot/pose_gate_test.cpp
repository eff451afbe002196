#include "hardware/link/robot/pose_gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "core/mission/pose_json.h"
#include "tests/support/pose_messages.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using Kind = RobotAnswer::Kind;

/// A head with the sample's rig and its scan.
struct Head {
  ScanAtHead scan{std::string(64, 'a'), false, 30.0, true};
  std::string rig_id = std::string(64, 'a');
  bool simulated = false;

  HeadFacts Facts() const {
    return {rig_id, simulated, [scan = scan](const std::string& uuid) -> std::optional<ScanAtHead> {
              if (uuid != "scan-1") return std::nullopt;
              return scan;
            }};
  }
};

/// Why the sample is refused after a change; "" = it may go.
template <class Change>
std::string Why(const Change& change) {
  PoseMessage message = SamplePose();
  Head head;
  change(message, head);
  return WhyNotToSend(message, head.Facts(), {}).value_or("");
}

TEST(PoseGateRules, ALiveAcceptedCertainPoseOfTheNewestScanMayGo) {
  EXPECT_EQ(Why([](auto&, auto&) {}), "");
  EXPECT_EQ(Why([](auto& pose, auto&) { pose.verdict = VerdictLevel::kLikely; }), "");
}

TEST(PoseGateRules, AReviewIsRefused) {
  EXPECT_EQ(Why([](auto& pose, auto&) { pose.origin = PoseMessage::Origin::kReview; }),
            "It comes from a review: the scene may have changed since. Scan and fit again.");
}

TEST(PoseGateRules, ARejectedOrUndecidedObjectIsRefused) {
  EXPECT_EQ(Why([](auto& pose, auto&) { pose.decision = Decision::kRejected; }),
            "It was rejected.");
  EXPECT_EQ(Why([](auto& pose, auto&) { pose.decision = Decision::kOpen; }),
            "Nobody has accepted it. Compare the outline with the image and accept it first.");
}

TEST(PoseGateRules, AnAlternativeIsRefused) {
  EXPECT_EQ(Why([](auto& pose, auto&) {
              pose.is_winner = false;
              pose.candidate = 2;
            }),
            "It is alternative 2, not the best answer.");
}

TEST(PoseGateRules, AnUnsureAnswerIsRefused) {
  EXPECT_EQ(Why([](auto& pose, auto&) { pose.verdict = VerdictLevel::kUnsure; }),
            "Its verdict is UNSURE. Draw the region closer, or scan slower or from nearer.");
}

TEST(PoseGateRules, APoseOfUnknownAccuracyIsRefused) {
  EXPECT_EQ(Why([](auto& pose, auto&) { pose.covariance.reset(); }),
            "How exact it is is not known (no covariance). Fit it again.");
}

TEST(PoseGateRules, AScanThatTheHeadDoesNotHaveIsRefused) {
  EXPECT_EQ(Why([](auto& pose, auto&) { pose.scan_uuid = "other-scan"; }),
            "This head does not have its scan other-sc.");
}

TEST(PoseGateRules, AnotherRigIsRefusedWhoeverNamesIt) {
  const std::string other(64, 'b');
  const char* words =
      "It is of rig bbbbbbbb, and the head has rig aaaaaaaa now. Scan and fit again.";
  EXPECT_EQ(Why([&](auto& pose, auto&) { pose.rig_id = other; }), words);
  EXPECT_EQ(Why([&](auto&, auto& head) { head.scan.rig_id = other; }), words);
  EXPECT_EQ(Why([&](auto&, auto& head) { head.rig_id = other; }),
            "It is of rig aaaaaaaa, and the head has rig bbbbbbbb now. Scan and fit again.");
}

TEST(PoseGateRules, ASimulatedScanIsRefusedUnlessTheHeadIsSimulated) {
  const char* words = "Its scan is simulated, and this head is not.";
  EXPECT_EQ(Why([](auto& pose, auto&) { pose.simulated = true; }), words);
  EXPECT_EQ(Why([](auto&, auto& head) { head.scan.simulated = true; }), words)
      << "whatever the message says of itself";
  EXPECT_EQ(Why([](auto& pose, auto& head) {
              pose.simulated = head.scan.simulated = head.simulated = true;
            }),
            "");
}

TEST(PoseGateRules, AnEarlierScanIsRefused) {
  EXPECT_EQ(Why([](auto&, auto& head) { head.scan.is_newest = false; }),
            "It is from an earlier scan. Fit it again in the newest one.");
}

TEST(PoseGateRules, AnOldScanIsRefusedByTheHeadsClockAndByTheStations) {
  const char* words = "Its scan began 601 s ago, more than 600 s. Scan and fit again.";
  EXPECT_EQ(Why([](auto& pose, auto&) { pose.age_s = 601.0; }), words);
  EXPECT_EQ(Why([](auto&, auto& head) { head.scan.age_s = 601.0; }), words);
  EXPECT_EQ(Why([](auto& pose, auto& head) { pose.age_s = head.scan.age_s = 600.0; }), "");
}

TEST(PoseGateRules, AMemberThatIsNotFiniteIsRefusedByName) {
  EXPECT_THAT(Why([](auto& pose, auto&) { pose.position_m.x() = std::nan(""); }),
              HasSubstr("The message is damaged: 'position_m' is nan"));
}

TEST(PoseGateOptions, NamesTheMemberAtFault) {
  EXPECT_TRUE(PoseGateOptions{}.Check());
  EXPECT_THAT((PoseGateOptions{.oldest_s = 0.0}.Check().error().message), HasSubstr("oldest_s"));
  EXPECT_THAT((PoseGateOptions{.oldest_s = std::nan("")}.Check().error().message),
              HasSubstr("oldest_s"));
  EXPECT_THAT((PoseGateOptions{.remembered = 0}.Check().error().message), HasSubstr("remembered"));
}

/// A gate before a robot that accepts everything and counts.
struct Door {
  std::vector<PoseMessage> sent;
  RobotAnswer answer{Kind::kAccepted, "on my way"};
  PoseGate gate;

  explicit Door(PoseGateOptions options = {})
      : gate(options, [this](const PoseMessage& message) {
          sent.push_back(message);
          return answer;
        }) {}
  PoseGate::Outcome Publish(const PoseMessage& message, const Head& head = {}) {
    return gate.Publish(PoseMessageToJson(message), head.Facts());
  }
};

TEST(PoseGate, HandsAPoseOnWithTheHeadsOwnAgeAndBringsTheAnswerBack) {
  Door door;
  const PoseGate::Outcome outcome = door.Publish(SamplePose());
  EXPECT_EQ(outcome.answer, (RobotAnswer{Kind::kAccepted, "on my way"}));
  EXPECT_FALSE(outcome.repeated);
  ASSERT_EQ(door.sent.size(), 1u);
  EXPECT_EQ(door.sent[0].age_s, 30.0) << "12.5 s by the station, 30 s by the head";
}

TEST(PoseGate, ARepeatIsAnsweredAsTheFirstTimeAndNotSentAgain) {
  Door door;
  (void)door.Publish(SamplePose());
  door.answer = {Kind::kRefused, "no"};
  PoseMessage repeat = SamplePose();
  repeat.age_s += 5.0;  // it waited in the link
  const PoseGate::Outcome outcome = door.Publish(repeat);
  EXPECT_TRUE(outcome.repeated);
  EXPECT_EQ(outcome.answer, (RobotAnswer{Kind::kAccepted, "on my way"}));
  EXPECT_EQ(door.sent.size(), 1u);
}

TEST(PoseGate, ARefusalIsRepeatedTooEvenWhenItsReasonIsGone) {
  Door door;
  Head head;
  head.scan.is_newest = false;
  const PoseGate::Outcome first = door.Publish(SamplePose(), head);
  EXPECT_EQ(first.answer.kind, Kind::kRefused);
  const PoseGate::Outcome second = door.Publish(SamplePose());
  EXPECT_TRUE(second.repeated);
  EXPECT_EQ(second.answer, first.answer);
  EXPECT_TRUE(door.sent.empty());
}

TEST(PoseGate, ASecondSendingOfTheSameObjectIsANewPose) {
  Door door;
  PoseMessage again = SamplePose();
  (void)door.Publish(again);
  ++again.sending;
  EXPECT_FALSE(door.Publish(again).repeated);
  EXPECT_EQ(door.sent.size(), 2u);
}

TEST(PoseGate, AnotherPoseUnderAKnownIdIsRefused) {
  Door door;
  PoseMessage other = SamplePose();
  (void)door.Publish(other);
  other.position_m.x() += 0.001;
  const PoseGate::Outcome outcome = door.Publish(other);
  EXPECT_EQ(outcome.answer.kind, Kind::kRefused);
  EXPECT_THAT(outcome.answer.reason, HasSubstr("Another pose was sent as 6f9619ff"));
  EXPECT_EQ(door.sent.size(), 1u);
}

TEST(PoseGate, ADamagedMessageIsRefusedWithTheMemberAtFault) {
  Door door;
  const PoseGate::Outcome outcome = door.gate.Publish("{\"version\":1}", Head().Facts());
  EXPECT_EQ(outcome.answer.kind, Kind::kRefused);
  EXPECT_THAT(outcome.answer.reason, HasSubstr("The message is damaged: pose: "));
  EXPECT_THAT(outcome.answer.reason, HasSubstr("'id'"));
}

TEST(PoseGate, RemembersTheNewestAnswersAndForgetsTheOldest) {
  Door door({.remembered = 2});
  PoseMessage pose = SamplePose();
  for (pose.sending = 1; pose.sending <= 3; ++pose.sending) (void)door.Publish(pose);
  ASSERT_EQ(door.sent.size(), 3u);
  pose.sending = 2;
  EXPECT_TRUE(door.Publish(pose).repeated);
  pose.sending = 1;
  EXPECT_FALSE(door.Publish(pose).repeated) << "forgotten: two are remembered";
}

TEST(PoseGate, OfManyRepeatsAtOnceOneIsSent) {
  Door door;
  std::vector<std::thread> callers;
  for (int i = 0; i < 8; ++i) callers.emplace_back([&] { (void)door.Publish(SamplePose()); });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(door.sent.size(), 1u);
}

}  // namespace
}  // namespace foresight
