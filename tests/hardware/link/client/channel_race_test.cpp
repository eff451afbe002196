#include "hardware/link/client/channel_race.h"

#include "tests/hardware/link/head_bench.h"

namespace foresight {
namespace {

using std::chrono::milliseconds;
using std::chrono::system_clock;

class ChannelRaceTest : public ::testing::Test {
 protected:
  static ChannelMaker ChannelTo(int port, int attempt_ms) {
    return [=] {
      grpc::ChannelArguments arguments;
      SetStationArguments(arguments, LinkPath::kBursts, attempt_ms);
      return grpc::CreateCustomChannel("127.0.0.1:" + std::to_string(port),
                                       grpc::InsecureChannelCredentials(), arguments);
    };
  }
  /// The same, and remembers who was made.
  ChannelMaker Watched(int port, int attempt_ms) {
    return [this, make = ChannelTo(port, attempt_ms)] {
      auto channel = make();
      const std::lock_guard lock(mutex);
      made.push_back(channel);
      return channel;
    };
  }
  int ConnectedOnes() {
    const std::lock_guard lock(mutex);
    int count = 0;
    for (const auto& channel : made)
      if (const auto there = channel.lock(); there)
        count += there->GetState(false) == GRPC_CHANNEL_READY ? 1 : 0;
    return count;
  }
  static bool WaitALittle(const ChannelRace& race) {
    return race.Wait(system_clock::now() + milliseconds(200));
  }
  static bool WaitLong(const ChannelRace& race) {
    return race.Wait(system_clock::now() + milliseconds(10'000));
  }

  HeadBench bench{std::make_shared<FakeHead>()};
  std::mutex mutex;
  std::vector<std::weak_ptr<grpc::Channel>> made;  ///< guarded by mutex
};

TEST_F(ChannelRaceTest, TheOneThatGetsThroughIsUsed) {
  // Nobody listens on port 1.
  const ChannelRace race({ChannelTo(1, 30), ChannelTo(bench.port(), 100)});
  ASSERT_TRUE(WaitLong(race));
  EXPECT_EQ(race.Current()->GetState(false), GRPC_CHANNEL_READY);
}

TEST_F(ChannelRaceTest, WhatTheOthersBeganIsGivenUp) {
  const ChannelRace race(std::vector<ChannelMaker>(8, Watched(bench.port(), 100)));
  ASSERT_TRUE(WaitLong(race));
  // An attempt takes 100 ms at most, and a rest is looked at as often.
  std::this_thread::sleep_for(milliseconds(400));
  EXPECT_EQ(ConnectedOnes(), 1);
  EXPECT_TRUE(race.Connected());
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
  const std::vector<std::shared_ptr<grpc::Channel>> channels = {ChannelTo(bench.port(), 100)(),
                                                                ChannelTo(bench.port(), 100)()};
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

TEST_F(ChannelRaceTest, ADoubtedConnectionIsLeftForAFreshOne) {
  ChannelRace race({ChannelTo(bench.port(), 100), ChannelTo(bench.port(), 101)});
  ASSERT_TRUE(WaitLong(race));
  const auto first = race.Current();
  const auto context = LinkSession::Context(milliseconds(0));
  const auto stream = link::SensorHead::NewStub(first)->Watch(context.get());
  ASSERT_TRUE(stream->Write(link::SignOfLife()));
  race.Doubt();
  ASSERT_TRUE(Eventually([&] { return race.Current() != first; }));
  EXPECT_TRUE(race.Connected());
  // A call that runs stays where it is.
  link::Event event;
  EXPECT_TRUE(stream->Read(&event));
  context->TryCancel();
  stream->Finish();
}

TEST_F(ChannelRaceTest, ADoubtedConnectionStaysWhereNoOtherGetsThrough) {
  ChannelRace race({ChannelTo(bench.port(), 100), ChannelTo(1, 30)});
  ASSERT_TRUE(WaitLong(race));
  const auto first = race.Current();
  race.Doubt();
  std::this_thread::sleep_for(milliseconds(300));
  EXPECT_EQ(race.Current(), first);
  EXPECT_TRUE(race.Connected());
}

}  // namespace
}  // namespace foresight
