#include "hardware/link/robot/robot_socket.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <future>

#include "core/mission/pose_json.h"
#include "tests/hardware/link/robot/local_robot.h"
#include "tests/support/pose_messages.h"
#include "tests/support/running_program.h"

namespace foresight {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::StartsWith;
using Kind = RobotAnswer::Kind;

/// Longer than any answer in this computer takes, also where it is busy.
constexpr milliseconds kLong{30'000};
/// For answers that never come.
constexpr milliseconds kShort{50};

struct Bench {
  TemporaryFolder folder;
  std::unique_ptr<RobotSocket> socket;

  explicit Bench(milliseconds timeout = kLong)
      : socket(RobotSocket::Listen({Path(), timeout}).value()) {}
  std::filesystem::path Path() const { return folder / "robot.sock"; }
  std::future<RobotAnswer> SendLater(const PoseMessage& message = SamplePose()) {
    return std::async(std::launch::async, [this, message] { return socket->Send(message); });
  }
};

TEST(RobotSocket, CarriesAPoseToTheRobotAndItsAnswerBack) {
  Bench bench;
  LocalRobot robot(bench.Path());
  auto answer = bench.SendLater();
  EXPECT_EQ(robot.Line(), PoseMessageToJson(SamplePose()));
  const std::string id = SamplePose().Id();
  ASSERT_TRUE(robot.Say("{\"id\":\"" + id + "\",\"answer\":\"accepted\"}\n"));
  EXPECT_EQ(answer.get(), (RobotAnswer{Kind::kAccepted, ""}));
}

TEST(RobotSocket, ARefusalComesWithItsReason) {
  Bench bench;
  LocalRobot robot(bench.Path());
  auto answer = bench.SendLater();
  EXPECT_EQ(robot.AnswerOne("refused", "out of reach"), SamplePose().Id());
  EXPECT_EQ(answer.get(), (RobotAnswer{Kind::kRefused, "out of reach"}));
}

TEST(RobotSocket, NobodyThereIsAnAnswerOfItsOwnAndComesAtOnce) {
  const Bench bench;
  EXPECT_FALSE(bench.socket->RobotIsThere());
  const RobotAnswer answer = bench.socket->Send(SamplePose());
  EXPECT_EQ(answer.kind, Kind::kNobodyThere);
  EXPECT_EQ(answer.reason, "No robot is connected to " + bench.Path().string() + ".");
}

TEST(RobotSocket, ARobotThatDoesNotAnswerInTimeIsNamed) {
  Bench bench(kShort);
  LocalRobot robot(bench.Path());
  const RobotAnswer answer = bench.socket->Send(SamplePose());
  EXPECT_EQ(answer.kind, Kind::kNoAnswer);
  EXPECT_EQ(answer.reason, "The robot did not answer within 0.05 s; it may have got the pose.");
}

TEST(RobotSocket, ALateAnswerIsNotTakenForThatToTheNextPose) {
  Bench bench(kShort);
  LocalRobot robot(bench.Path());
  EXPECT_EQ(bench.socket->Send(SamplePose()).kind, Kind::kNoAnswer);
  robot.AnswerOne("accepted");
  PoseMessage next = SamplePose();
  ++next.sending;
  const RobotAnswer answer = bench.socket->Send(next);
  EXPECT_EQ(answer.kind, Kind::kNoAnswer);
  EXPECT_TRUE(bench.socket->RobotIsThere()) << "a slow robot may stay";
}

TEST(RobotSocket, AnAnswerInPiecesIsTakenAsAWhole) {
  Bench bench;
  LocalRobot robot(bench.Path());
  auto answer = bench.SendLater();
  (void)robot.Line();
  const std::string line = "{\"id\":\"" + SamplePose().Id() + "\",\"answer\":\"accepted\"}\r\n";
  for (const char c : line) ASSERT_TRUE(robot.Say({c}));
  EXPECT_EQ(answer.get().kind, Kind::kAccepted);
}

TEST(RobotSocket, GarbageBeforeTheAnswerDoesNotHideIt) {
  Bench bench;
  LocalRobot robot(bench.Path());
  auto answer = bench.SendLater();
  ASSERT_TRUE(robot.Say("garbage\n\n{\"id\":7}\n\xff\xfe\n[[[[\n"));
  robot.AnswerOne("accepted");
  EXPECT_EQ(answer.get().kind, Kind::kAccepted);
}

TEST(RobotSocket, WhatARobotSaidInsteadOfAnAnswerIsShown) {
  Bench bench(milliseconds(500));
  LocalRobot robot(bench.Path());
  auto answer = bench.SendLater();
  (void)robot.Line();
  ASSERT_TRUE(robot.Say("{\"id\":\"x\",\"answer\":\"maybe\"}\n"));
  EXPECT_THAT(answer.get().reason, HasSubstr("What it said last: robot: 'answer' is 'maybe'"));
}

TEST(RobotSocket, ARobotThatDiesBeforeItAnswersMayHaveGotThePose) {
  Bench bench;
  auto robot = std::make_unique<LocalRobot>(bench.Path());
  auto answer = bench.SendLater();
  (void)robot->Line();
  robot.reset();
  const RobotAnswer ended = answer.get();
  EXPECT_EQ(ended.kind, Kind::kNoAnswer);
  EXPECT_THAT(ended.reason, HasSubstr("it may have got the pose"));
  EXPECT_FALSE(bench.socket->RobotIsThere());
  EXPECT_EQ(bench.socket->Send(SamplePose()).kind, Kind::kNobodyThere);
}

TEST(RobotSocket, HalfALineAndThenTheEndIsNoAnswer) {
  Bench bench;
  LocalRobot robot(bench.Path());
  auto answer = bench.SendLater();
  (void)robot.Line();
  ASSERT_TRUE(robot.Say("{\"id\":\"" + SamplePose().Id() + "\",\"answer\":\"accepted\"}"));
  robot.Close();
  EXPECT_EQ(answer.get().kind, Kind::kNoAnswer);
}

TEST(RobotSocket, ARobotThatIsRestartedTakesItsPlaceAgain) {
  Bench bench;
  for (int start = 0; start < 20; ++start) {
    LocalRobot robot(bench.Path());
    auto answer = bench.SendLater();
    robot.AnswerOne("accepted");
    EXPECT_EQ(answer.get().kind, Kind::kAccepted) << start;
  }
}

TEST(RobotSocket, TheFirstRobotStaysAndASecondIsToldAndClosed) {
  Bench bench;
  LocalRobot first(bench.Path());
  LocalRobot second(bench.Path());
  EXPECT_EQ(second.Line(), "{\"error\": \"another robot is connected\"}");
  EXPECT_TRUE(second.IsClosed());
  auto answer = bench.SendLater();
  first.AnswerOne("accepted");
  EXPECT_EQ(answer.get().kind, Kind::kAccepted);
}

TEST(RobotSocket, MegabytesWithoutALineEndCloseTheConnectionAndTheNextRobotIsServed) {
  Bench bench;
  LocalRobot robot(bench.Path());
  EXPECT_FALSE(robot.Say(std::string(8 << 20, 'x'))) << "nobody takes 8 MiB";
  EXPECT_TRUE(robot.IsClosed());
  LocalRobot next(bench.Path());
  auto answer = bench.SendLater();
  next.AnswerOne("accepted");
  EXPECT_EQ(answer.get().kind, Kind::kAccepted);
}

TEST(RobotSocket, ARobotThatTalksWithoutEndIsClosed) {
  Bench bench;
  LocalRobot robot(bench.Path());
  std::string chatter;
  for (int i = 0; i < 1000; ++i) chatter += "{\"id\":\"1\",\"answer\":\"accepted\"}\n";
  (void)robot.Say(chatter);
  EXPECT_TRUE(robot.IsClosed());
}

TEST(RobotSocket, ARobotThatNeverReadsCannotBlockTheHead) {
  Bench bench(milliseconds(1));
  const LocalRobot robot(bench.Path());
  ASSERT_TRUE(WaitUntil([&] { return bench.socket->RobotIsThere(); }));
  // The system takes a few hundred kB for it; 1000 poses are more than that.
  int sent = 0;
  while (sent < 1000 && bench.socket->RobotIsThere()) {
    EXPECT_EQ(bench.socket->Send(SamplePose()).kind, Kind::kNoAnswer);
    ++sent;
  }
  EXPECT_LT(sent, 1000) << "it was given up";
}

TEST(RobotSocket, ManySendersAtOnceEachGetTheirOwnAnswer) {
  Bench bench;
  LocalRobot robot(bench.Path());
  std::vector<std::future<RobotAnswer>> answers;
  for (int i = 1; i <= 8; ++i) {
    PoseMessage pose = SamplePose();
    pose.sending = i;
    answers.push_back(std::async(std::launch::async, [&bench, pose] {
      RobotAnswer answer = bench.socket->Send(pose);
      EXPECT_EQ(answer.reason, pose.Id());
      return answer;
    }));
  }
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const std::string id = nlohmann::json::parse(robot.Line()).at("id");
    (void)robot.Say(nlohmann::json{{"id", id}, {"answer", "accepted"}, {"reason", id}}.dump() +
                    "\n");
  }
  for (auto& answer : answers) EXPECT_EQ(answer.get().kind, Kind::kAccepted);
}

TEST(RobotSocket, EndingTheHeadClosesTheConnectionAndRemovesTheFile) {
  Bench bench;
  const LocalRobot robot(bench.Path());
  ASSERT_TRUE(WaitUntil([&] { return bench.socket->RobotIsThere(); }));
  bench.socket.reset();
  EXPECT_TRUE(robot.IsClosed());
  EXPECT_FALSE(std::filesystem::exists(bench.Path()));
}

TEST(RobotSocket, ASocketThatAnotherHeadListensOnIsLeftToIt) {
  const Bench bench;
  const auto second = RobotSocket::Listen({bench.Path(), kLong});
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kIo);
  EXPECT_THAT(second.error().message, HasSubstr("another program listens there"));
}

TEST(RobotSocket, IsInTheUsersRuntimeFolderUnlessAPathIsGiven) {
  const char* kept = std::getenv("XDG_RUNTIME_DIR");
  const std::string before = kept ? kept : "";
  ::setenv("XDG_RUNTIME_DIR", "/run/user/7", 1);
  EXPECT_EQ(DefaultRobotSocketPath().value(), "/run/user/7/foresight/robot.sock");
  ::unsetenv("XDG_RUNTIME_DIR");
  EXPECT_THAT(DefaultRobotSocketPath().error().message, StartsWith("robot: XDG_RUNTIME_DIR is"));
  if (kept) ::setenv("XDG_RUNTIME_DIR", before.c_str(), 1);
}

TEST(RobotSocketOptions, NamesTheMemberAtFault) {
  EXPECT_TRUE(RobotSocketOptions{}.Check());
  EXPECT_THAT((RobotSocketOptions{"x", milliseconds(0)}.Check().error().message),
              HasSubstr("answer_timeout is 0 ms"));
}

}  // namespace
}  // namespace foresight
