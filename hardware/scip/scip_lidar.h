#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "hardware/api/lidar.h"
#include "hardware/api/sensor_clock.h"
#include "hardware/net/wake_up.h"
#include "hardware/scip/scip_handshake.h"
#include "hardware/scip/scip_lidar_options.h"
#include "hardware/scip/scip_line_troubles.h"
#include "hardware/scip/scip_stamp_watch.h"

namespace foresight {

/// A Hokuyo UTM-30LX-EW over Ethernet, or anything else that speaks SCIP 2.2.
///
/// A thread of its own holds the connection and repairs it: a silent stream is asked for again,
/// then the connection is made anew, then the device is rebooted. What is missed meanwhile shows as
/// a jump of LidarLine::seq. A line that is damaged, has another number of beams or a time stamp
/// that cannot be true is dropped, and LidarHealth::trouble says what was wrong with it. Errors
/// begin with "lidar HOST:PORT: ".
class ScipLidar final : public Lidar {
 public:
  /// `options` have passed their Check(). `clock` runs in real time.
  ScipLidar(const ScipLidarOptions& options, std::shared_ptr<const SensorClock> clock);
  ~ScipLidar() override;

  std::string Describe() const override;
  /// Tries until options.connect_timeout_s is over. Returns at once when connected. Fails with
  /// kInvalidInput when another device answers than the options expect.
  Status Connect() override;
  Status Start() override;
  void Stop() override;
  Result<std::optional<LidarLine>> WaitForLine(std::chrono::milliseconds timeout) override;

  LidarHealth Health() const override;

 private:
  using SteadyClock = std::chrono::steady_clock;

  /// What the owner asks of the thread.
  struct DesiredState {
    bool connection = false;
    /// Until then attempts to connect go on; nullopt: for ever, a connection is to be restored.
    std::optional<SteadyClock::time_point> give_up;
    bool stream = false;
    std::int64_t number = 0;  ///< counts the changes of the desired state
  };
  /// The stream that the thread receives.
  struct Stream {
    std::int64_t number = -1;  ///< of the desired state that it reached
    bool running = false;
    ScipRequest request;
    SteadyClock::time_point last_scan;
    int stalls = 0;  ///< since the last scan
  };

  // In the thread:
  void Work(const std::stop_token& stop);
  Status Serve(const std::stop_token& stop);
  Status Talk(ScipSession& session, const std::stop_token& stop);
  Status RebootDevice(ScipSession& session);
  Status Synchronise(ScipSession& session);
  Status ReachDesiredState(ScipSession& session, const DesiredState& desired, Stream& stream);
  Status ReceiveScan(ScipSession& session, Stream& stream);
  Status RecoverFromSilence(ScipSession& session, Stream& stream);
  Status TakeReply(const ScipSession::Arrival& arrival, Stream& stream);
  void NoteLine(ScipLineTrouble trouble, const std::string& detail);
  void HandOn(LidarLine line, std::int64_t lost, std::int64_t stream_number);
  void MarkConnected(const ScipIdentity& identity);
  void AfterFailure(const Error& error, const std::stop_token& stop);
  DesiredState CurrentDesiredState() const;
  std::string Explain(const Error& error) const;

  const ScipLidarOptions options_;
  const std::shared_ptr<const SensorClock> clock_;
  const std::string name_;  ///< "lidar HOST:PORT"
  const WakeUp wake_;       ///< ends the thread's wait for bytes

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  DesiredState desired_;
  bool connected_ = false;
  std::optional<Error> gave_up_;
  std::optional<std::int64_t> running_;  ///< number of the desired state that was reached
  std::deque<LidarLine> lines_;
  SteadyClock::time_point last_scan_;
  std::deque<SteadyClock::time_point> recent_;  ///< arrivals of the last second
  ScipIdentity identity_;
  LidarHealth health_;
  ScipLineTroubles troubles_;

  // Of the thread alone:
  std::optional<ScipClock> line_clock_;
  ScipStampWatch stamps_;
  int bad_stamps_ = 0;  ///< in a row
  SteadyClock::time_point synchronised_;
  std::int64_t seq_ = -1;
  std::optional<std::int64_t> counted_stream_;  ///< whose losses are counted
  int fruitless_ = 0;                           ///< connections in a row that ended in silence
  bool reboot_due_ = false;
  double backoff_s_;
  std::int64_t damaged_in_session_ = 0;

  std::jthread thread_;  ///< last: it uses all of the above
};

}  // namespace foresight
