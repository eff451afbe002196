#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string_view>

#include "core/base/result.h"
#include "hardware/net/tcp_address.h"
#include "hardware/net/wake_up.h"

namespace foresight {

/// One TCP connection to a device, or to a client of an emulated one. Sends without delay (Nagle is
/// off) and notices a dead peer within about 2 s. Every wait has an end: a timeout, or a WakeUp
/// (which may be nullptr). Errors are kDevice and begin with the peer's address. One thread at a
/// time.
class TcpSocket {
 public:
  using Duration = std::chrono::microseconds;

  TcpSocket() = default;
  ~TcpSocket() { Close(); }
  TcpSocket(TcpSocket&& other) noexcept;
  TcpSocket& operator=(TcpSocket&& other) noexcept;

  /// Fails also when woken up (kCancelled).
  static Result<TcpSocket> Connect(const TcpAddress& peer, Duration timeout,
                                   const WakeUp* wake = nullptr);

  bool IsOpen() const { return fd_ >= 0; }
  const TcpAddress& peer() const { return peer_; }

  /// All of `bytes`, or an error.
  Status Send(std::string_view bytes, Duration timeout);
  Status Send(std::span<const std::byte> bytes, Duration timeout);
  /// As much as is there, at least one byte; 0 when nothing came in time or when woken up. Fails
  /// when the peer has closed.
  Result<std::size_t> Receive(std::span<char> buffer, Duration timeout,
                              const WakeUp* wake = nullptr);

  void Close();
  /// Closes so that the peer sees "connection reset", as after a crash.
  void Reset();

 private:
  friend class TcpListener;
  TcpSocket(int fd, TcpAddress peer);

  int fd_ = -1;
  TcpAddress peer_;
};

}  // namespace foresight
