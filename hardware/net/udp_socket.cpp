#include "hardware/net/udp_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "hardware/net/poll_fd.h"

namespace foresight {
namespace {

sockaddr_in ToSystem(const UdpPeer& peer) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(peer.ip);
  address.sin_port = htons(peer.port);
  return address;
}

}  // namespace

Result<UdpSocket> UdpSocket::Bind(const TcpAddress& address) {
  in_addr ip{};
  if (::inet_pton(AF_INET, address.host.c_str(), &ip) != 1)
    return Fail(ErrorCode::kDevice, "{}: is no IPv4 address", address.ToText());
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0)
    return Fail(ErrorCode::kDevice, "{}: no socket: {}", address.ToText(),
                std::generic_category().message(errno));
  UdpSocket bound(fd, address, ntohl(ip.s_addr));
  sockaddr_in name = ToSystem({bound.ip_, address.port});
  if (::bind(fd, reinterpret_cast<const sockaddr*>(&name), sizeof name) != 0)
    return Fail(ErrorCode::kDevice, "{}: cannot bind: {}", address.ToText(),
                std::generic_category().message(errno));
  socklen_t size = sizeof name;
  ::getsockname(fd, reinterpret_cast<sockaddr*>(&name), &size);
  bound.address_.port = ntohs(name.sin_port);
  return bound;
}

UdpSocket::~UdpSocket() {
  if (fd_ >= 0) ::close(fd_);
}

UdpSocket::UdpSocket(UdpSocket&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), address_(std::move(other.address_)), ip_(other.ip_) {}

UdpSocket& UdpSocket::operator=(UdpSocket&& other) noexcept {
  std::swap(fd_, other.fd_);
  std::swap(address_, other.address_);
  std::swap(ip_, other.ip_);
  return *this;
}

Status UdpSocket::SendTo(std::span<const std::uint8_t> bytes, const UdpPeer& peer) const {
  const sockaddr_in to = ToSystem(peer);
  for (;;) {
    const ssize_t sent = ::sendto(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL,
                                  reinterpret_cast<const sockaddr*>(&to), sizeof to);
    if (sent >= 0) return {};
    // ECONNREFUSED tells of an earlier datagram whose receiver had gone.
    if (errno == EINTR || errno == ECONNREFUSED) continue;
    if (errno != EAGAIN)
      return Fail(ErrorCode::kDevice, "{}: cannot send: {}", address_.ToText(),
                  std::generic_category().message(errno));
    PollFd(fd_, POLLOUT, std::chrono::milliseconds(100), nullptr);
  }
}

std::optional<UdpSocket::Datagram> UdpSocket::Receive(std::span<std::uint8_t> buffer,
                                                      Duration timeout, const WakeUp* wake) const {
  if (!PollFd(fd_, POLLIN, timeout, wake)) return std::nullopt;
  sockaddr_in from{};
  socklen_t size = sizeof from;
  const ssize_t n =
      ::recvfrom(fd_, buffer.data(), buffer.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
  if (n < 0) return std::nullopt;
  return Datagram{{ntohl(from.sin_addr.s_addr), ntohs(from.sin_port)}, static_cast<std::size_t>(n)};
}

Result<std::string> LocalAddressTowards(const std::string& peer) {
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_port = htons(1);  // any but 0
  if (::inet_pton(AF_INET, peer.c_str(), &name.sin_addr) != 1)
    return Fail(ErrorCode::kDevice, "{}: is no IPv4 address", peer);
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  socklen_t size = sizeof name;
  // Connecting a UDP socket sends nothing; it looks up the route.
  const bool found = fd >= 0 &&
                     ::connect(fd, reinterpret_cast<const sockaddr*>(&name), sizeof name) == 0 &&
                     ::getsockname(fd, reinterpret_cast<sockaddr*>(&name), &size) == 0;
  const int error = errno;
  if (fd >= 0) ::close(fd);
  if (!found)
    return Fail(ErrorCode::kDevice, "{}: no way there: {}", peer,
                std::generic_category().message(error));
  std::array<char, INET_ADDRSTRLEN> text{};
  ::inet_ntop(AF_INET, &name.sin_addr, text.data(), text.size());
  return std::string(text.data());
}

}  // namespace foresight
