#include "hardware/net/tcp_socket.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <system_error>
#include <utility>

#include "hardware/net/poll_fd.h"

namespace foresight {
namespace {

using SteadyClock = std::chrono::steady_clock;

void SetOption(int fd, int level, int name, int value) {
  // An option that the system does not know costs promptness, not correctness.
  ::setsockopt(fd, level, name, &value, sizeof value);
}

/// A device that lost its power answers nothing at all: without these a write waits for minutes.
void NoticeADeadPeerSoon(int fd) {
  SetOption(fd, IPPROTO_TCP, TCP_NODELAY, 1);
  SetOption(fd, SOL_SOCKET, SO_KEEPALIVE, 1);
  SetOption(fd, IPPROTO_TCP, TCP_KEEPIDLE, 1);
  SetOption(fd, IPPROTO_TCP, TCP_KEEPINTVL, 1);
  SetOption(fd, IPPROTO_TCP, TCP_KEEPCNT, 2);
  SetOption(fd, IPPROTO_TCP, TCP_USER_TIMEOUT, 2000);
}

TcpSocket::Duration Left(SteadyClock::time_point deadline) {
  return std::chrono::duration_cast<TcpSocket::Duration>(deadline - SteadyClock::now());
}

}  // namespace

TcpSocket::TcpSocket(int fd, TcpAddress peer) : fd_(fd), peer_(std::move(peer)) {
  NoticeADeadPeerSoon(fd_);
}

TcpSocket::TcpSocket(TcpSocket&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), peer_(std::move(other.peer_)) {}

TcpSocket& TcpSocket::operator=(TcpSocket&& other) noexcept {
  if (this == &other) return *this;
  Close();
  fd_ = std::exchange(other.fd_, -1);
  peer_ = std::move(other.peer_);
  return *this;
}

Result<TcpSocket> TcpSocket::Connect(const TcpAddress& peer, Duration timeout, const WakeUp* wake) {
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const std::string port = std::to_string(peer.port);
  if (const int error = ::getaddrinfo(peer.host.c_str(), port.c_str(), &hints, &found); error != 0)
    return Fail(ErrorCode::kDevice, "{}: {}", peer.ToText(), ::gai_strerror(error));
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, &::freeaddrinfo);

  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0)
    return Fail(ErrorCode::kDevice, "{}: no socket: {}", peer.ToText(),
                std::generic_category().message(errno));
  TcpSocket socket(fd, peer);
  if (::connect(fd, addresses->ai_addr, addresses->ai_addrlen) == 0) return socket;
  if (errno != EINPROGRESS)
    return Fail(ErrorCode::kDevice, "{}: cannot connect: {}", peer.ToText(),
                std::generic_category().message(errno));
  if (!PollFd(fd, POLLOUT, timeout, wake)) {
    if (wake && PollFd(wake->fd(), POLLIN, Duration(0), nullptr))
      return Fail(ErrorCode::kCancelled, "{}: connecting was cancelled", peer.ToText());
    return Fail(ErrorCode::kDevice, "{}: cannot connect: no answer within {} ms", peer.ToText(),
                timeout.count() / 1000);
  }
  int error = 0;
  socklen_t size = sizeof error;
  ::getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size);
  if (error != 0)
    return Fail(ErrorCode::kDevice, "{}: cannot connect: {}", peer.ToText(),
                std::generic_category().message(error));
  return socket;
}

Status TcpSocket::Send(std::span<const std::byte> bytes, Duration timeout) {
  return Send(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), timeout);
}

Status TcpSocket::Send(std::string_view bytes, Duration timeout) {
  if (!IsOpen()) return Fail(ErrorCode::kDevice, "{}: is not connected", peer_.ToText());
  const auto deadline = SteadyClock::now() + timeout;
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t n = ::send(fd_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n >= 0) {
      sent += static_cast<std::size_t>(n);
      continue;
    }
    if (errno == EINTR) continue;
    if (errno != EAGAIN)
      return Fail(ErrorCode::kDevice, "{}: cannot send: {}", peer_.ToText(),
                  std::generic_category().message(errno));
    if (Left(deadline) <= Duration(0))
      return Fail(ErrorCode::kDevice, "{}: took {} of {} bytes within {} ms", peer_.ToText(), sent,
                  bytes.size(), timeout.count() / 1000);
    PollFd(fd_, POLLOUT, Left(deadline), nullptr);
  }
  return {};
}

Result<std::size_t> TcpSocket::Receive(std::span<char> buffer, Duration timeout,
                                       const WakeUp* wake) {
  if (!IsOpen()) return Fail(ErrorCode::kDevice, "{}: is not connected", peer_.ToText());
  if (!PollFd(fd_, POLLIN, timeout, wake)) return 0;
  const ssize_t n = ::recv(fd_, buffer.data(), buffer.size(), 0);
  if (n > 0) return static_cast<std::size_t>(n);
  if (n == 0) return Fail(ErrorCode::kDevice, "{}: closed the connection", peer_.ToText());
  if (errno == EAGAIN || errno == EINTR) return 0;
  return Fail(ErrorCode::kDevice, "{}: cannot receive: {}", peer_.ToText(),
              std::generic_category().message(errno));
}

void TcpSocket::Close() {
  if (fd_ >= 0) ::close(std::exchange(fd_, -1));
}

void TcpSocket::Reset() {
  if (fd_ < 0) return;
  const linger discard{1, 0};
  ::setsockopt(fd_, SOL_SOCKET, SO_LINGER, &discard, sizeof discard);
  Close();
}

}  // namespace foresight
