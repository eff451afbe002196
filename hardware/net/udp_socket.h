#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/base/result.h"
#include "hardware/net/tcp_address.h"
#include "hardware/net/wake_up.h"

namespace foresight {

/// An IPv4 address and port as packets carry them.
struct UdpPeer {
  std::uint32_t ip = 0;  ///< 127.0.0.1 is 0x7F000001
  std::uint16_t port = 0;
  bool operator==(const UdpPeer&) const = default;
};

/// A UDP socket on one address of this computer. SendTo may be called by several threads, Receive
/// by one. Errors are kDevice and begin with the socket's address.
class UdpSocket {
 public:
  using Duration = std::chrono::microseconds;

  struct Datagram {
    UdpPeer from;
    std::size_t size = 0;  ///< 0 is a datagram too
  };

  /// On a numeric IPv4 address; port 0 takes a free one.
  static Result<UdpSocket> Bind(const TcpAddress& address);
  ~UdpSocket();
  UdpSocket(UdpSocket&& other) noexcept;
  UdpSocket& operator=(UdpSocket&& other) noexcept;

  /// With the port that was taken.
  const TcpAddress& address() const { return address_; }
  std::uint32_t ip() const { return ip_; }

  /// What the network drops shows nowhere; only this computer's refusal does.
  Status SendTo(std::span<const std::uint8_t> bytes, const UdpPeer& peer) const;
  /// The next datagram, cut to the buffer; nullopt when none came in time or when woken up.
  std::optional<Datagram> Receive(std::span<std::uint8_t> buffer, Duration timeout,
                                  const WakeUp* wake = nullptr) const;

 private:
  UdpSocket(int fd, TcpAddress address, std::uint32_t ip)
      : fd_(fd), address_(std::move(address)), ip_(ip) {}

  int fd_ = -1;
  TcpAddress address_;
  std::uint32_t ip_ = 0;
};

/// This computer's address on the way to a numeric IPv4 address. Sends nothing. Fails with kDevice.
Result<std::string> LocalAddressTowards(const std::string& peer);

}  // namespace foresight
