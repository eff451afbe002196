#include "hardware/net/tcp_listener.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "hardware/net/poll_fd.h"

namespace foresight {
namespace {

constexpr int kBacklog = 4;

/// A socket bound to `address`, whose port is filled in; errno says why not.
int Bind(sockaddr_in& address) {
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0) return -1;
  const int on = 1;
  ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  if (::bind(fd, generic, size) == 0 && ::getsockname(fd, generic, &size) == 0) return fd;
  const int error = errno;
  ::close(fd);
  errno = error;
  return -1;
}

}  // namespace

TcpListener::~TcpListener() {
  if (fd_ >= 0) ::close(fd_);
}

TcpListener::TcpListener(TcpListener&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), address_(std::move(other.address_)) {}

TcpListener& TcpListener::operator=(TcpListener&& other) noexcept {
  std::swap(fd_, other.fd_);
  std::swap(address_, other.address_);
  return *this;
}

Result<TcpListener> TcpListener::Listen(const TcpAddress& address) {
  sockaddr_in bound{};
  bound.sin_family = AF_INET;
  bound.sin_port = htons(address.port);
  if (::inet_pton(AF_INET, address.host.c_str(), &bound.sin_addr) != 1)
    return Fail(ErrorCode::kDevice, "{}: is no numeric address to listen on", address.ToText());
  // A port that the system chose is given back when the socket stops listening (see Refuse); one
  // that was asked for is not. So ask for the chosen one.
  if (address.port == 0)
    if (const int chosen = Bind(bound); chosen >= 0) ::close(chosen);
  TcpListener listener(Bind(bound));
  if (listener.fd_ < 0)
    return Fail(ErrorCode::kDevice, "{}: cannot listen: {}", address.ToText(),
                std::generic_category().message(errno));
  listener.address_ = {address.host, ntohs(bound.sin_port)};
  FORESIGHT_CHECK(listener.Resume());
  return listener;
}

Status TcpListener::Resume() {
  if (::listen(fd_, kBacklog) == 0) return {};
  return Fail(ErrorCode::kDevice, "{}: cannot listen: {}", address_.ToText(),
              std::generic_category().message(errno));
}

void TcpListener::Refuse() {
  // On Linux this ends listening, resets whoever is in the queue, and leaves the socket bound.
  ::shutdown(fd_, SHUT_RDWR);
}

Result<std::optional<TcpSocket>> TcpListener::Accept(TcpSocket::Duration timeout,
                                                     const WakeUp* wake) {
  if (!PollFd(fd_, POLLIN, timeout, wake)) return std::nullopt;
  sockaddr_in peer{};
  socklen_t size = sizeof peer;
  const int fd =
      ::accept4(fd_, reinterpret_cast<sockaddr*>(&peer), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (fd >= 0) {
    char host[INET_ADDRSTRLEN] = {};
    ::inet_ntop(AF_INET, &peer.sin_addr, host, sizeof host);
    return TcpSocket(fd, {host, ntohs(peer.sin_port)});
  }
  // A client may have gone again while it waited.
  if (errno == EAGAIN || errno == EINTR || errno == ECONNABORTED) return std::nullopt;
  return Fail(ErrorCode::kDevice, "{}: cannot accept: {}", address_.ToText(),
              std::generic_category().message(errno));
}

}  // namespace foresight
