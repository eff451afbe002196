#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <stop_token>

#include "core/base/result.h"
#include "hardware/api/sensor_clock.h"
#include "hardware/net/tcp_socket.h"
#include "hardware/scip/scip_parser.h"
#include "hardware/scip/scip_request.h"

namespace foresight {

/// One connection to a SCIP device: requests out, replies in. Every wait ends at once with
/// kCancelled when `stop` is requested and `wake` raised. One thread.
class ScipSession {
 public:
  using Duration = std::chrono::microseconds;

  struct Arrival {
    ScipReply reply;
    double time_s = 0.0;  ///< when its first byte came, on the head's clock
  };

  /// `clock` and `wake` outlive the session.
  static Result<ScipSession> Open(const TcpAddress& address, Duration timeout,
                                  const SensorClock& clock, const WakeUp& wake,
                                  std::stop_token stop);

  /// Sends `request` with a tag of its own and waits for the reply to it; whatever else comes is
  /// discarded. The reply's status is the caller's to judge.
  Result<Arrival> Ask(ScipRequest request, Duration timeout);
  /// The next reply of any kind; nullopt when none came in time or when woken up.
  Result<std::optional<Arrival>> Receive(Duration timeout);
  /// Discards what comes until `duration` is over.
  Status Drain(Duration duration);
  /// Stops the device before the end of the session, also when stop was requested.
  void Disconnect();

  std::string NextTag();
  std::int64_t damaged() const { return parser_.damaged(); }

 private:
  ScipSession(TcpSocket socket, const SensorClock& clock, const WakeUp& wake, std::stop_token stop);

  Result<Arrival> WaitForEcho(const std::string& echo, Duration timeout);
  Status ReceiveBytes(Duration timeout);
  Status CheckStop() const;

  TcpSocket socket_;
  const SensorClock* clock_;
  const WakeUp* wake_;
  std::stop_token stop_;
  ScipParser parser_;
  std::deque<Arrival> arrivals_;
  double reply_began_s_ = 0.0;
  int tags_ = 0;
};

}  // namespace foresight
