#include "hardware/link/client/remote_stand.h"

#include <gmock/gmock.h>

#include <limits>

#include "tests/hardware/link/fake_stand.h"

namespace foresight {
namespace {

using ::testing::HasSubstr;

TEST(StandMessages, ADescriptionSurvivesTheLink) {
  FakeStand stand;
  stand.at = 2;
  const auto read = FromMessage(ToMessage(stand));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->mount, stand.Mount());
  EXPECT_EQ(read->single_board, stand.SingleBoard());
  EXPECT_EQ(read->places, stand.Places());
  EXPECT_EQ(read->at, 2);
}

TEST(StandMessages, NonsenseIsRefused) {
  const link::StandReply good = ToMessage(FakeStand());
  link::StandReply bad = good;
  bad.set_at(4);
  EXPECT_THAT(FromMessage(bad).error().message, HasSubstr("place 4 of 3"));
  bad = good;
  bad.set_board_a("a carpet");
  EXPECT_THAT(FromMessage(bad).error().message, HasSubstr("board A"));
  bad = good;
  bad.mutable_a_from_b()->RemoveLast();
  EXPECT_THAT(FromMessage(bad).error().message, HasSubstr("6 numbers"));
  bad = good;
  bad.set_a_from_b(0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(FromMessage(bad).error().message, HasSubstr("no pose"));
}

struct RemoteStandTest : ::testing::Test {
  /// The head's answer to the last move, at a time of the head's clock.
  void Answer(CommandEnd::Kind kind, double desk_time_s = 0.0) {
    CommandEnd end;
    end.kind = kind;
    end.error.message = "the head sweeps";
    end.outcome.set_desk_time_s(desk_time_s);
    done(end);
  }

  link::Command sent;
  CommandSender::Done done;
  const std::shared_ptr<RemoteStand> stand =
      std::make_shared<RemoteStand>(FromMessage(ToMessage(FakeStand())).value(),
                                    [this](link::Command command, CommandSender::Done answer) {
                                      sent = std::move(command);
                                      done = std::move(answer);
                                    });
};

TEST_F(RemoteStandTest, IsWhereItWasUntilTheHeadSaysThatItWent) {
  stand->MoveTo(1);
  EXPECT_EQ(sent.move_stand().place(), 2);
  EXPECT_TRUE(stand->Moving());
  EXPECT_EQ(stand->At(), 0);
  Answer(CommandEnd::Kind::kDone, 5.0);
  EXPECT_FALSE(stand->Moving());
  EXPECT_EQ(stand->At(), 1);
  EXPECT_EQ(stand->Trouble(), "");
}

TEST_F(RemoteStandTest, AWordThatIsOlderThanTheMoveDoesNotTakeItBack) {
  stand->MoveTo(1);
  stand->Heard(3, 4.0);
  EXPECT_TRUE(stand->Moving());
  Answer(CommandEnd::Kind::kDone, 5.0);
  stand->Heard(1, 4.9);
  EXPECT_EQ(stand->At(), 1);
  stand->Heard(3, 5.1);
  EXPECT_EQ(stand->At(), 2) << "somebody else moved it";
  stand->Forget();
  stand->Heard(0, 0.1);
  EXPECT_EQ(stand->At(), -1) << "the head's program was started anew";
}

TEST_F(RemoteStandTest, AMoveThatWasRefusedLeavesItAndSaysWhy) {
  stand->MoveTo(1);
  Answer(CommandEnd::Kind::kRefused);
  EXPECT_FALSE(stand->Moving());
  EXPECT_EQ(stand->At(), 0);
  EXPECT_EQ(stand->Trouble(), "the head sweeps");
  stand->MoveTo(1);
  EXPECT_EQ(stand->Trouble(), "");
}

TEST_F(RemoteStandTest, WithoutItsLinkItStays) {
  stand->MoveTo(1);
  stand->Leave();
  EXPECT_FALSE(stand->Moving());
  EXPECT_NE(stand->Trouble(), "");
  sent.Clear();
  stand->MoveTo(2);
  EXPECT_FALSE(sent.has_move_stand());
  EXPECT_EQ(stand->At(), 0);
  EXPECT_NE(stand->Trouble(), "");
}

}  // namespace
}  // namespace foresight
