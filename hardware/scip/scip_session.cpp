#include "hardware/scip/scip_session.h"

#include <array>
#include <utility>

namespace foresight {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr ScipSession::Duration kSendTimeout = std::chrono::seconds(1);
constexpr ScipSession::Duration kDisconnectTimeout = std::chrono::milliseconds(100);

ScipSession::Duration Left(SteadyClock::time_point deadline) {
  return std::chrono::duration_cast<ScipSession::Duration>(deadline - SteadyClock::now());
}

}  // namespace

ScipSession::ScipSession(TcpSocket socket, const SensorClock& clock, const WakeUp& wake,
                         std::stop_token stop)
    : socket_(std::move(socket)), clock_(&clock), wake_(&wake), stop_(std::move(stop)) {}

Result<ScipSession> ScipSession::Open(const TcpAddress& address, Duration timeout,
                                      const SensorClock& clock, const WakeUp& wake,
                                      std::stop_token stop) {
  // A wake-up that was meant for an earlier wait; a stop that it meant is asked for below.
  wake.Lower();
  if (stop.stop_requested())
    return Fail(ErrorCode::kCancelled, "{}: connecting was cancelled", address.ToText());
  FORESIGHT_TRY(TcpSocket socket, TcpSocket::Connect(address, timeout, &wake));
  return ScipSession(std::move(socket), clock, wake, std::move(stop));
}

std::string ScipSession::NextTag() {
  return fmt::format("s{}", ++tags_);
}

Status ScipSession::CheckStop() const {
  if (!stop_.stop_requested()) return {};
  return Fail(ErrorCode::kCancelled, "{}: was stopped", socket_.peer().ToText());
}

Status ScipSession::ReceiveBytes(Duration timeout) {
  std::array<char, 16384> buffer;
  FORESIGHT_TRY(const std::size_t size, socket_.Receive(buffer, timeout, wake_));
  const double now_s = clock_->Now();
  if (size == 0) {
    wake_->Lower();
    return {};
  }
  if (!parser_.InReply()) reply_began_s_ = now_s;
  parser_.Push({buffer.data(), size});
  while (auto reply = parser_.Take()) {
    arrivals_.push_back({std::move(*reply), reply_began_s_});
    reply_began_s_ = now_s;
  }
  return {};
}

Result<std::optional<ScipSession::Arrival>> ScipSession::Receive(Duration timeout) {
  FORESIGHT_CHECK(CheckStop());
  if (arrivals_.empty()) FORESIGHT_CHECK(ReceiveBytes(timeout));
  if (arrivals_.empty()) return std::nullopt;
  Arrival arrival = std::move(arrivals_.front());
  arrivals_.pop_front();
  return arrival;
}

Result<ScipSession::Arrival> ScipSession::WaitForEcho(const std::string& echo, Duration timeout) {
  const auto deadline = SteadyClock::now() + timeout;
  do {
    FORESIGHT_TRY(std::optional<Arrival> arrival, Receive(Left(deadline)));
    if (arrival && arrival->reply.echo == echo) return std::move(*arrival);
  } while (SteadyClock::now() < deadline);
  return Fail(ErrorCode::kDevice, "{}: did not answer {} within {} ms", socket_.peer().ToText(),
              echo.substr(0, echo.find(';')), timeout.count() / 1000);
}

Result<ScipSession::Arrival> ScipSession::Ask(ScipRequest request, Duration timeout) {
  if (request.tag.empty()) request.tag = NextTag();
  const std::string text = EncodeScipRequest(request);
  FORESIGHT_CHECK(socket_.Send(text + "\n", kSendTimeout));
  return WaitForEcho(text, timeout);
}

Status ScipSession::Drain(Duration duration) {
  const auto deadline = SteadyClock::now() + duration;
  while (SteadyClock::now() < deadline) FORESIGHT_CHECK(Receive(Left(deadline)));
  return {};
}

void ScipSession::Disconnect() {
  // Closing with bytes unread resets the connection, and the request could be lost with it.
  stop_ = {};
  wake_->Lower();
  // A device that does not answer cannot be helped from here.
  static_cast<void>(Ask({.command = ScipCommand::kQuit}, kDisconnectTimeout));
}

}  // namespace foresight
