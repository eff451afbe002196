#include "hardware/link/burst/datagram_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "core/base/contract.h"
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

/// So many messages of one buffer each.
struct Messages {
  std::array<mmsghdr, DatagramSocket::kAtOnce> headers{};
  std::array<iovec, DatagramSocket::kAtOnce> buffers{};

  void Set(std::size_t i, const void* bytes, std::size_t size) {
    buffers[i] = {const_cast<void*>(bytes), size};
    headers[i].msg_hdr.msg_iov = &buffers[i];
    headers[i].msg_hdr.msg_iovlen = 1;
  }
};

}  // namespace

Result<DatagramSocket> DatagramSocket::Bind(const TcpAddress& address) {
  in_addr ip{};
  if (::inet_pton(AF_INET, address.host.c_str(), &ip) != 1)
    return Fail(ErrorCode::kInvalidOptions, "{}: is no numeric IPv4 address", address.ToText());
  UniqueFd fd(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!fd.IsOpen())
    return Fail(ErrorCode::kDevice, "{}: no socket: {}", address.ToText(),
                std::generic_category().message(errno));
  sockaddr_in name = ToSystem({ntohl(ip.s_addr), address.port});
  if (::bind(fd.Get(), reinterpret_cast<const sockaddr*>(&name), sizeof name) != 0)
    return Fail(ErrorCode::kDevice,
                "{}: cannot receive there: {}: is it an address of this computer, and is the port "
                "free?",
                address.ToText(), std::generic_category().message(errno));
  socklen_t size = sizeof name;
  ::getsockname(fd.Get(), reinterpret_cast<sockaddr*>(&name), &size);
  return DatagramSocket(std::move(fd), {address.host, ntohs(name.sin_port)});
}

std::size_t DatagramSocket::SetBuffers(std::size_t bytes) const {
  const int size = static_cast<int>(bytes);
  // Beyond the system's limit where this program may do so, else up to it.
  if (::setsockopt(fd_.Get(), SOL_SOCKET, SO_RCVBUFFORCE, &size, sizeof size) != 0)
    ::setsockopt(fd_.Get(), SOL_SOCKET, SO_RCVBUF, &size, sizeof size);
  if (::setsockopt(fd_.Get(), SOL_SOCKET, SO_SNDBUFFORCE, &size, sizeof size) != 0)
    ::setsockopt(fd_.Get(), SOL_SOCKET, SO_SNDBUF, &size, sizeof size);
  int given = 0;
  socklen_t length = sizeof given;
  ::getsockopt(fd_.Get(), SOL_SOCKET, SO_RCVBUF, &given, &length);
  return static_cast<std::size_t>(given) / 2;  // the system says the double of what was asked for
}

Status DatagramSocket::Send(const std::vector<std::vector<std::uint8_t>>& datagrams,
                            std::size_t count, const UdpPeer& to) const {
  FORESIGHT_EXPECTS(count <= kAtOnce && count <= datagrams.size(), "so many are sent at once");
  sockaddr_in name = ToSystem(to);
  Messages messages;
  for (std::size_t i = 0; i < count; ++i) {
    messages.Set(i, datagrams[i].data(), datagrams[i].size());
    messages.headers[i].msg_hdr.msg_name = &name;
    messages.headers[i].msg_hdr.msg_namelen = sizeof name;
  }
  for (std::size_t sent = 0; sent < count;) {
    const int n = ::sendmmsg(fd_.Get(), messages.headers.data() + sent,
                             static_cast<unsigned>(count - sent), MSG_NOSIGNAL);
    if (n > 0) {
      sent += static_cast<std::size_t>(n);
      continue;
    }
    // ECONNREFUSED tells of an earlier datagram whose receiver had gone.
    if (errno == EINTR || errno == ECONNREFUSED) continue;
    if (errno != EAGAIN && errno != ENOBUFS)
      return Fail(ErrorCode::kDevice, "{}: cannot send: {}", address_.ToText(),
                  std::generic_category().message(errno));
    if (!PollFd(fd_.Get(), POLLOUT, std::chrono::milliseconds(20), nullptr)) return {};
  }
  return {};
}

void DatagramSocket::Receive(std::chrono::microseconds timeout, const WakeUp* wake,
                             const std::function<void(std::span<const std::uint8_t>)>& take) {
  if (!PollFd(fd_.Get(), POLLIN, timeout, wake)) return;
  constexpr std::size_t kRoom = kLongest + 1;
  buffer_.resize(kAtOnce * kRoom);
  Messages messages;
  for (std::size_t i = 0; i < kAtOnce; ++i) messages.Set(i, buffer_.data() + i * kRoom, kRoom);
  const int n = ::recvmmsg(fd_.Get(), messages.headers.data(), kAtOnce, MSG_DONTWAIT, nullptr);
  for (int i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    take({buffer_.data() + at * kRoom, messages.headers[at].msg_len});
  }
}

Result<std::uint32_t> UnicastIp(const std::string& host) {
  in_addr ip{};
  const bool good = ::inet_pton(AF_INET, host.c_str(), &ip) == 1;
  const std::uint32_t number = ntohl(ip.s_addr);
  if (!good || number >> 24 == 0 || number >= 0xE0000000U)
    return Fail(ErrorCode::kInvalidOptions,
                "'{}': is no numeric IPv4 address of one computer, such as 10.0.0.2", host);
  return number;
}

}  // namespace foresight
