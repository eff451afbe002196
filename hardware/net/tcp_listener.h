#pragma once

#include <chrono>
#include <optional>

#include "core/base/result.h"
#include "hardware/net/tcp_address.h"
#include "hardware/net/tcp_socket.h"

namespace foresight {

/// Where clients of an emulated device knock. One thread at a time.
class TcpListener {
 public:
  TcpListener() = default;
  ~TcpListener();
  TcpListener(TcpListener&& other) noexcept;
  TcpListener& operator=(TcpListener&& other) noexcept;

  /// On a numeric IPv4 address, e.g. 127.0.0.2; port 0 takes a free one. Fails with kDevice.
  static Result<TcpListener> Listen(const TcpAddress& address);

  /// With the port that was taken.
  const TcpAddress& address() const { return address_; }

  /// The next client; nullopt when none came in time or when woken up.
  Result<std::optional<TcpSocket>> Accept(TcpSocket::Duration timeout,
                                          const WakeUp* wake = nullptr);

  /// From now on clients are refused, as by a device that serves one at a time. The port stays
  /// ours.
  void Refuse();
  /// Ends Refuse.
  Status Resume();

 private:
  explicit TcpListener(int fd) : fd_(fd) {}

  int fd_ = -1;
  TcpAddress address_;
};

}  // namespace foresight
