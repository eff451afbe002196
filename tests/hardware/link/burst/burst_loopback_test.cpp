#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "hardware/link/burst/burst_receiver.h"
#include "hardware/link/burst/burst_sender.h"

namespace foresight {
namespace {

constexpr std::uint32_t kLoopback = 0x7F000001;

class BurstLoopback : public testing::Test {
 protected:
  std::unique_ptr<BurstSender> Start(double bytes_per_s, BurstSender::Source source) {
    BurstSenderOptions options;
    options.to = {kLoopback, receiver->address().port};
    options.bytes_per_s = bytes_per_s;
    EXPECT_TRUE(receiver->Expect(key, "scan", {}));
    return BurstSender::Start(options, key, std::move(source)).value();
  }
  std::vector<Chunk> Receive(std::size_t count) {
    std::vector<Chunk> all;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (all.size() < count && std::chrono::steady_clock::now() < end) {
      for (Chunk& chunk : receiver->TakeChunks()) all.push_back(std::move(chunk));
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return all;
  }

  const BurstKey key = BurstKey::Make().value();
  const std::unique_ptr<BurstReceiver> receiver = BurstReceiver::Listen({"127.0.0.1", 0}).value();
};

TEST_F(BurstLoopback, ChunksOfManySizesArrive) {
  std::vector<Chunk> chunks;
  for (const std::size_t bytes : {0u, 1u, 1335u, 1336u, 60'000u})
    chunks.push_back(
        SplitItem({ChunkKind::kImage, static_cast<std::int64_t>(bytes)}, std::string(bytes, 'x'))
            .value()
            .front());
  std::size_t next = 0;
  const auto sender = Start(10e6, [&](bool, const std::stop_token&) -> ChunkToBurst {
    // Over and over: a busy computer may lose some.
    return {BurstScanTag("scan"), std::make_shared<const Chunk>(chunks[next++ % chunks.size()])};
  });
  const auto received = Receive(chunks.size());
  ASSERT_EQ(received.size(), chunks.size());
  for (const Chunk& chunk : received)
    EXPECT_NE(std::find(chunks.begin(), chunks.end(), chunk), chunks.end());
  EXPECT_EQ(receiver->Counts().Refused(), 0);
  EXPECT_LT(receiver->SilenceSeconds(), 10.0);
}

TEST_F(BurstLoopback, TheRateOnTheWireIsTheOneThatWasSet) {
  const auto chunk = std::make_shared<const Chunk>(
      SplitItem({ChunkKind::kImage, 0}, std::string(60'000, 'x')).value().front());
  const auto begin = std::chrono::steady_clock::now();
  std::int64_t sent = 0;
  double seconds = 0.0;
  {
    const auto sender = Start(4e6, [&](bool, const std::stop_token&) -> ChunkToBurst {
      return {1, chunk};
    });
    while (sender->SentBytes() < 2'000'000 && seconds < 10.0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      sent = sender->SentBytes();
      seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
  }
  // A busy computer may be slower, never faster; 90 kB: 0.01 s at once, and what one call sends.
  EXPECT_LE(static_cast<double>(sent), 4e6 * seconds + 90e3);
  EXPECT_GE(sent, 2'000'000);
}

TEST_F(BurstLoopback, NothingIsSentWhereThereIsNothing) {
  const auto sender = Start(1e6, [](bool wait, const std::stop_token& stop) -> ChunkToBurst {
    while (wait && !stop.stop_requested())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return {};
  });
  EXPECT_EQ(sender->SentBytes(), 0);
}

TEST(BurstReceiver, SaysWhereItCannotListen) {
  const auto first = BurstReceiver::Listen({"127.0.0.1", 0}).value();
  const auto second = BurstReceiver::Listen(first->address());
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("is the port free"), std::string::npos);
  EXPECT_FALSE(BurstReceiver::Listen({"station.example", 0}));
}

TEST(BurstSenderOptions, NamesTheMemberAtFault) {
  BurstSenderOptions options;
  options.to.port = 1;
  EXPECT_TRUE(options.Check());
  options.datagram_bytes = 255;
  EXPECT_NE(options.Check().error().message.find("datagram_bytes = 255"), std::string::npos);
  options = {};
  EXPECT_NE(options.Check().error().message.find("port"), std::string::npos);
  options.to.port = 1;
  options.bytes_per_s = 0.0;
  EXPECT_FALSE(options.Check());
}

TEST(UnicastIp, RefusesWhatNamesNoSingleComputer) {
  EXPECT_EQ(UnicastIp("127.0.0.1").value(), kLoopback);
  for (const char* host : {"", "0.0.0.0", "224.0.0.1", "255.255.255.255", "10.0.0", "::1", "x"})
    EXPECT_FALSE(UnicastIp(host)) << host;
}

}  // namespace
}  // namespace foresight
