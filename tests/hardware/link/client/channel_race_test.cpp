#include "hardware/link/client/channel_race.h"

#include "tests/hardware/link/head_bench.h"

namespace foresight {
namespace {

using std::chrono::milliseconds;
using std::chrono::system_clock;

class ChannelRaceTest : public ::testing::Test {
 protected:
  static std::shared_ptr<grpc::Channel> ChannelTo(int port, int attempt_ms) {
    grpc::ChannelArguments arguments;
    SetStationArguments(arguments, LinkPath::kBursts, attempt_ms);
    return grpc::CreateCustomChannel("127.0.0.1:" + std::to_string(port),
                                     grpc::InsecureChannelCredentials(), arguments);
  }
  static bool WaitALittle(const ChannelRace& race) {
    return race.Wait(system_clock::now() + milliseconds(200));
  }
  static bool WaitLong(const ChannelRace& race) {
    return race.Wait(system_clock::now() + milliseconds(10'000));
  }

  HeadBench bench{std::make_shared<FakeHead>()};
};

TEST_F(ChannelRaceTest, TheOneThatGetsThroughIsUsed) {
  // Nobody listens on port 1.
  const ChannelRace race({ChannelTo(1, 30), ChannelTo(bench.port(), 100)});
  ASSERT_TRUE(WaitLong(race));
  EXPECT_EQ(race.Current(), 1u);
}

TEST_F(ChannelRaceTest, WhereNoneGetsThroughTheWaitEnds) {
  const ChannelRace race({ChannelTo(1, 30), ChannelTo(1, 100)});
  EXPECT_FALSE(WaitALittle(race));
  EXPECT_FALSE(race.Connected());
}

TEST_F(ChannelRaceTest, AWaitWithoutAnEndEndsWhereItIsStopped) {
  const ChannelRace race({ChannelTo(1, 30)});
  std::stop_source stop;
  bool connected = true;
  {
    const std::jthread waiter([&] { connected = race.Wait(stop.get_token()); });
    stop.request_stop();
  }
  EXPECT_FALSE(connected);
}

TEST_F(ChannelRaceTest, ChannelsOfTheSameArgumentsTryEachForItself) {
  const std::vector<std::shared_ptr<grpc::Channel>> channels = {ChannelTo(bench.port(), 100),
                                                                ChannelTo(bench.port(), 100)};
  // What one does leaves the other alone.
  ASSERT_TRUE(channels[0]->WaitForConnected(system_clock::now() + milliseconds(10'000)));
  EXPECT_EQ(channels[1]->GetState(false), GRPC_CHANNEL_IDLE);
}

TEST_F(ChannelRaceTest, AHeadThatComesBackIsFoundAgain) {
  const ChannelRace race({ChannelTo(bench.port(), 30), ChannelTo(bench.port(), 100)});
  ASSERT_TRUE(WaitLong(race));
  bench.StopHead();
  ASSERT_TRUE(Eventually([&] { return !race.Connected(); }));
  bench.StartHead();
  EXPECT_TRUE(WaitLong(race));
}

}  // namespace
}  // namespace foresight
