#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "hardware/net/tcp_address.h"
#include "hardware/net/udp_socket.h"
#include "hardware/net/unique_fd.h"

namespace foresight {

/// A UDP socket that moves many datagrams with one call of the system. Send and Receive may each be
/// called by one thread.
class DatagramSocket {
 public:
  static constexpr std::size_t kAtOnce = 32;

  /// On a numeric IPv4 address; port 0 takes a free one. Fails with kInvalidOptions, kDevice.
  static Result<DatagramSocket> Bind(const TcpAddress& address);

  const TcpAddress& address() const { return address_; }
  /// Asks the system for so large buffers; returns what it gives for receiving.
  std::size_t SetBuffers(std::size_t bytes) const;

  /// The first `count` of `datagrams`, at most kAtOnce. What the network drops shows nowhere; only
  /// this computer's refusal does (kDevice).
  Status Send(const std::vector<std::vector<std::uint8_t>>& datagrams, std::size_t count,
              const UdpPeer& to) const;
  /// Calls `take` with each datagram that is there, kAtOnce at most, waiting a while for the first.
  /// One longer than `kLongest` is cut to one byte more.
  void Receive(std::chrono::microseconds timeout, const WakeUp* wake,
               const std::function<void(std::span<const std::uint8_t>)>& take);
  static constexpr std::size_t kLongest = 2048;

 private:
  DatagramSocket(UniqueFd fd, TcpAddress address)
      : fd_(std::move(fd)), address_(std::move(address)) {}

  UniqueFd fd_;
  TcpAddress address_;
  std::vector<std::uint8_t> buffer_;
};

/// Of a numeric IPv4 address that datagrams may be sent to: no network's name for all or many.
/// Fails with kInvalidOptions.
Result<std::uint32_t> UnicastIp(const std::string& host);

}  // namespace foresight
