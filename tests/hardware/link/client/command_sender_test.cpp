#include "hardware/link/client/command_sender.h"

#include <gmock/gmock.h>

#include <future>

#include "tests/hardware/link/head_bench.h"

namespace foresight {
namespace {

std::future<CommandEnd> SendTo(CommandSender& sender, link::Command command) {
  auto ended = std::make_shared<std::promise<CommandEnd>>();
  sender.Send(std::move(command), [ended](const CommandEnd& end) { ended->set_value(end); });
  return ended->get_future();
}

TEST(CommandSender, AMoveThatWaitsBehindARetriedCommandIsVoidOnceTheHeadIsStopped) {
  const auto head = std::make_shared<FakeHead>();
  HeadBench bench{head};
  LinkSession session({bench.Channel()}, "head");
  ASSERT_TRUE(session.Begin(std::chrono::milliseconds(3000)));
  bench.StopHead();
  CommandSender sender(session, 1.0);
  link::Command end_scan;
  end_scan.mutable_end_scan();
  link::Command home;
  home.mutable_home();
  std::future<CommandEnd> first = SendTo(sender, std::move(end_scan));
  std::future<CommandEnd> behind = SendTo(sender, std::move(home));
  sender.VoidMoves();
  EXPECT_EQ(first.get().kind, CommandEnd::Kind::kUnknown) << "what ends a scan is not void";
  const CommandEnd end = behind.get();
  EXPECT_EQ(end.kind, CommandEnd::Kind::kRefused);
  EXPECT_THAT(end.error.message,
              testing::HasSubstr("the head was stopped before the command was sent"));
  EXPECT_EQ(head->homings, 0);
}

}  // namespace
}  // namespace foresight
