#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "hardware/net/tcp_listener.h"
#include "hardware/net/tcp_socket.h"

namespace foresight {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

constexpr seconds kLong{10};

struct Pair {
  TcpListener listener = TcpListener::Listen({}).value();
  TcpSocket client = TcpSocket::Connect(listener.address(), kLong).value();
  TcpSocket server = listener.Accept(kLong).value().value();
};

std::string Read(TcpSocket& socket) {
  std::array<char, 100> buffer;
  return std::string(buffer.data(), socket.Receive(buffer, kLong).value());
}

TEST(TcpAddress, TakesTheDefaultPortWhereNoneIsGiven) {
  EXPECT_EQ(TcpAddress::Parse("10.0.0.2:5020", 502).value(), (TcpAddress{"10.0.0.2", 5020}));
  EXPECT_EQ(TcpAddress::Parse("10.0.0.2", 502).value(), (TcpAddress{"10.0.0.2", 502}));
}

TEST(TcpAddress, RefusesWhatIsNoAddress) {
  for (const char* text : {"", ":1", "a:", "a:x", "a:1x", "a:70000", "a:1:2"})
    EXPECT_EQ(TcpAddress::Parse(text, 1).error().code, ErrorCode::kInvalidOptions) << text;
}

TEST(TcpSocket, CarriesBytesBothWays) {
  Pair pair;
  ASSERT_TRUE(pair.client.Send(std::string_view("hello"), kLong));
  EXPECT_EQ(Read(pair.server), "hello");
  ASSERT_TRUE(pair.server.Send(std::string_view("yes"), kLong));
  EXPECT_EQ(Read(pair.client), "yes");
}

TEST(TcpSocket, ConnectingToAClosedPortSaysSo) {
  TcpListener listener = TcpListener::Listen({}).value();
  listener.Refuse();
  const auto refused = TcpSocket::Connect(listener.address(), kLong);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kDevice);
  EXPECT_EQ(refused.error().message,
            listener.address().ToText() + ": cannot connect: Connection refused");
}

TEST(TcpSocket, AClientThatCloseIsNoticedAsClosed) {
  Pair pair;
  pair.client.Close();
  std::array<char, 10> buffer;
  EXPECT_THAT(pair.server.Receive(buffer, kLong).error().message, HasSubstr("closed the conn"));
}

TEST(TcpSocket, ResetIsSeenByThePeerAsAReset) {
  Pair pair;
  pair.server.Reset();
  std::array<char, 10> buffer;
  EXPECT_THAT(pair.client.Receive(buffer, kLong).error().message, HasSubstr("reset by peer"));
}

TEST(TcpSocket, AWakeUpEndsTheWaitForBytes) {
  Pair pair;
  const WakeUp wake;
  std::thread waker([&] { wake.Raise(); });
  std::array<char, 10> buffer;
  EXPECT_EQ(pair.client.Receive(buffer, std::chrono::hours(1), &wake).value(), 0u);
  waker.join();
  wake.Lower();
  EXPECT_EQ(pair.client.Receive(buffer, milliseconds(1), &wake).value(), 0u);
}

TEST(TcpSocket, APeerThatReadsNothingEndsSendingInTime) {
  Pair pair;
  const std::string much(64 << 20, 'x');
  EXPECT_THAT(pair.client.Send(much, milliseconds(50)).error().message,
              HasSubstr("of 67108864 bytes within 50 ms"));
}

TEST(TcpListener, KeepsItsPortWhileItRefuses) {
  TcpListener listener = TcpListener::Listen({}).value();
  listener.Refuse();
  EXPECT_FALSE(TcpSocket::Connect(listener.address(), kLong));
  ASSERT_TRUE(listener.Resume());
  EXPECT_TRUE(TcpSocket::Connect(listener.address(), kLong));
  EXPECT_TRUE(listener.Accept(kLong).value());
}

TEST(TcpListener, SeveralDevicesShareAPortOnAddressesOfTheirOwn) {
  const TcpListener first = TcpListener::Listen({"127.0.0.2", 0}).value();
  const auto second = TcpListener::Listen({"127.0.0.3", first.address().port});
  EXPECT_TRUE(second) << second.error().message;
}

}  // namespace
}  // namespace foresight
