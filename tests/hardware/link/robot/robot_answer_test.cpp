#include "hardware/link/robot/robot_answer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace foresight {
namespace {

using testing::HasSubstr;

TEST(RobotLine, SaysWhichPoseWasAcceptedOrRefusedAndWhy) {
  const auto accepted = RobotLineFromJson(R"({"id":"a/1","answer":"accepted","more":[]})");
  ASSERT_TRUE(accepted) << accepted.error().message;
  EXPECT_EQ(accepted->id, "a/1");
  EXPECT_EQ(accepted->answer, (RobotAnswer{RobotAnswer::Kind::kAccepted, ""}));
  const auto refused =
      RobotLineFromJson(R"({"id":"a/1","answer":"refused","reason":"out of reach"})");
  EXPECT_EQ(refused->answer, (RobotAnswer{RobotAnswer::Kind::kRefused, "out of reach"}));
}

TEST(RobotLine, AReasonIsOneLineThatAWindowCanShow) {
  EXPECT_EQ(
      RobotLineFromJson("{\"id\":\"a\",\"answer\":\"refused\",\"reason\":\"a\\nb\\u001b[2J\"}")
          ->answer.reason,
      "a\\nb\\x1b[2J");
}

TEST(RobotLine, NamesWhatIsWrong) {
  const auto fault = [](const std::string& line) {
    const auto read = RobotLineFromJson(line);
    EXPECT_FALSE(read) << line;
    return read ? "" : read.error().message;
  };
  EXPECT_THAT(fault(R"({"answer":"accepted"})"), HasSubstr("'id'"));
  EXPECT_THAT(fault(R"({"id":"a"})"), HasSubstr("'answer'"));
  EXPECT_THAT(fault(R"({"id":1,"answer":"accepted"})"), HasSubstr("'id' is not text"));
  EXPECT_THAT(fault(R"({"id":"a","answer":"no_answer"})"), HasSubstr("'answer' is 'no_answer'"));
  EXPECT_THAT(fault(R"({"id":"a","answer":"refused","reason":7})"), HasSubstr("'reason'"));
  EXPECT_THAT(fault(R"({"id":"a","answer":"refused","reason":")" + std::string(501, 'x') + "\"}"),
              HasSubstr("501 bytes, more than 500"));
  EXPECT_THAT(fault(std::string(5000, ' ')), HasSubstr("5000 bytes, more than 4096"));
  for (const char* line : {"", "{", "[1]", "null", "accepted", "\xff\xfe"})
    EXPECT_FALSE(RobotLineFromJson(line)) << line;
}

}  // namespace
}  // namespace foresight
