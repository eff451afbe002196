// What the thread of a ScipLidar does; what its owner calls is in scip_lidar.cpp.
#include <algorithm>
#include <utility>

#include "core/base/log.h"
#include "hardware/scip/scip_lidar.h"
#include "hardware/scip/scip_line.h"
#include "hardware/scip/scip_status.h"

namespace foresight {
namespace {

constexpr auto kOpenTimeout = std::chrono::seconds(2);
constexpr auto kIdlePeriod = std::chrono::seconds(1);
/// Lines kept for an owner that does not fetch them: 10 s.
constexpr std::size_t kMostLines = 400;
/// Connections in a row that end in silence before the device is rebooted.
constexpr int kFruitlessBeforeReboot = 2;
/// Stamps in a row that cannot be true before the device's clock is read anew, which takes a new
/// connection. A line that is believed afterwards has its true time again.
constexpr int kBadStampsBeforeReconnect = 2;

}  // namespace

ScipLidar::DesiredState ScipLidar::CurrentDesiredState() const {
  const std::lock_guard lock(mutex_);
  return desired_;
}

std::string ScipLidar::Explain(const Error& error) const {
  // Errors of the socket begin with the address already.
  const std::string address = options_.address.ToText() + ": ";
  if (error.message.rfind(address, 0) == 0) return "lidar " + error.message;
  return name_ + ": " + error.message;
}

void ScipLidar::Work(const std::stop_token& stop) {
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, stop, [this] { return desired_.connection; });
    }
    if (stop.stop_requested()) return;
    Status served;
    try {
      served = Serve(stop);
    } catch (const std::exception& error) {
      served = Fail(ErrorCode::kDevice, "{}", error.what());
    }
    if (stop.stop_requested()) return;
    if (!served) AfterFailure(served.error(), stop);
  }
}

/// One connection, from its beginning to its end.
Status ScipLidar::Serve(const std::stop_token& stop) {
  FORESIGHT_TRY(ScipSession session,
                ScipSession::Open(options_.address, kOpenTimeout, *clock_, wake_, stop));
  damaged_in_session_ = 0;
  Status served = std::exchange(reboot_due_, false) ? RebootDevice(session) : Talk(session, stop);
  if (!served && served.error().code == ErrorCode::kState) {
    LogWarning("{}: rebooting it", Explain(served.error()));
    served = RebootDevice(session);
  }
  if (stop.stop_requested()) session.Disconnect();
  return served;
}

/// Ends the connection, so it always returns an error.
Status ScipLidar::RebootDevice(ScipSession& session) {
  FORESIGHT_CHECK(Reboot(session, DurationOf(options_.reply_timeout_s)));
  const std::lock_guard lock(mutex_);
  ++health_.reboots;
  return Fail(ErrorCode::kDevice, "was rebooted");
}

Status ScipLidar::Talk(ScipSession& session, const std::stop_token& stop) {
  FORESIGHT_TRY(const ScipIdentity identity, Identify(session, options_));
  if (!line_clock_) line_clock_.emplace(60.0 / identity.parameters.turns_per_min);
  FORESIGHT_CHECK(Synchronise(session));
  MarkConnected(identity);
  Stream stream;
  while (!stop.stop_requested()) {
    if (const DesiredState desired = CurrentDesiredState(); desired.number != stream.number) {
      FORESIGHT_CHECK(ReachDesiredState(session, desired, stream));
    } else if (stream.running) {
      FORESIGHT_CHECK(ReceiveScan(session, stream));
    } else {
      FORESIGHT_CHECK(session.Receive(kIdlePeriod));
    }
  }
  return {};
}

Status ScipLidar::Synchronise(ScipSession& session) {
  FORESIGHT_TRY(const std::vector<ClockReading> readings,
                ReadDeviceClock(session, *clock_, options_));
  line_clock_->Synchronise(readings);
  StampUnwrapper unwrapper;
  std::int64_t device_ms = 0;
  for (const ClockReading& reading : readings) device_ms = unwrapper.Unwrap(reading.stamp_ms);
  stamps_.Reset(device_ms);
  bad_stamps_ = 0;
  synchronised_ = SteadyClock::now();
  const std::lock_guard lock(mutex_);
  health_.clock_offset_s = line_clock_->offset_s();
  health_.clock_drift_ppm = line_clock_->drift_ppm();
  health_.sync_round_trip_s = line_clock_->round_trip_s();
  return {};
}

void ScipLidar::MarkConnected(const ScipIdentity& identity) {
  const std::lock_guard lock(mutex_);
  if (!identity_.parameters.model.empty()) ++health_.reconnects;
  identity_ = identity;
  connected_ = true;
  desired_.give_up.reset();
  backoff_s_ = options_.first_backoff_s;
  changed_.notify_all();
}

Status ScipLidar::ReachDesiredState(ScipSession& session, const DesiredState& desired,
                                    Stream& stream) {
  const auto timeout = DurationOf(options_.reply_timeout_s);
  FORESIGHT_CHECK(Quit(session, timeout));
  if (desired.stream) {
    if (SteadyClock::now() - synchronised_ > DurationOf(options_.resync_s))
      FORESIGHT_CHECK(Synchronise(session));
    stream.request = StreamRequest(options_);
    stream.request.tag = session.NextTag();
    FORESIGHT_CHECK(BeginStream(session, stream.request, timeout));
  }
  stream.running = desired.stream;
  stream.number = desired.number;
  stream.last_scan = SteadyClock::now();
  stream.stalls = 0;
  const std::lock_guard lock(mutex_);
  running_ = desired.number;
  changed_.notify_all();
  return {};
}

Status ScipLidar::ReceiveScan(ScipSession& session, Stream& stream) {
  const auto stall = stream.last_scan + DurationOf(options_.stall_s);
  const auto left = std::chrono::duration_cast<ScipSession::Duration>(stall - SteadyClock::now());
  FORESIGHT_TRY(const std::optional<ScipSession::Arrival> arrival, session.Receive(left));
  if (const std::int64_t damaged = session.damaged(); damaged != damaged_in_session_) {
    const std::int64_t more = damaged - std::exchange(damaged_in_session_, damaged);
    {
      const std::lock_guard lock(mutex_);
      health_.damaged += more;
    }
    for (std::int64_t i = 0; i < more; ++i) NoteLine(ScipLineTrouble::kBadSum, "in its status");
  }
  if (arrival) FORESIGHT_CHECK(TakeReply(*arrival, stream));
  if (SteadyClock::now() < stream.last_scan + DurationOf(options_.stall_s)) return {};
  return RecoverFromSilence(session, stream);
}

Status ScipLidar::RecoverFromSilence(ScipSession& session, Stream& stream) {
  ++stream.stalls;
  {
    const std::lock_guard lock(mutex_);
    ++health_.stalls;
  }
  if (stream.stalls >= options_.stalls_before_reconnect) {
    if (++fruitless_ >= kFruitlessBeforeReboot) {
      fruitless_ = 0;
      reboot_due_ = true;
    }
    return Fail(ErrorCode::kDevice, "no scan for {:.0f} ms",
                1e3 * options_.stall_s * stream.stalls);
  }
  stream.request.tag = session.NextTag();
  const Status begun = BeginStream(session, stream.request, DurationOf(options_.stall_s));
  stream.last_scan = SteadyClock::now();
  // A device that does not answer either gets its next chance at the next silence.
  if (!begun && begun.error().code != ErrorCode::kDevice) return begun;
  return {};
}

/// Fails where the device's clock must be read anew.
Status ScipLidar::TakeReply(const ScipSession::Arrival& arrival, Stream& stream) {
  if (arrival.reply.status != scip_status::kScan) return {};
  if (arrival.reply.echo != EncodeScipRequest(stream.request)) {
    const std::lock_guard lock(mutex_);
    ++health_.stale;
    return {};
  }
  const Result<ScipScan> scan = DecodeScipScan(arrival.reply);
  if (!scan) {
    const std::lock_guard lock(mutex_);
    ++health_.damaged;
    health_.last_error = Explain(scan.error());
    const bool wrong_count = scan.error().code == ErrorCode::kInvalidInput;
    troubles_.Note(
        clock_->Now(), wrong_count ? ScipLineTrouble::kWrongBeams : ScipLineTrouble::kBadSum,
        wrong_count ? scan.error().message.substr(scan.error().message.rfind(": ") + 2) : "");
    return {};
  }
  if (const auto wrong = stamps_.Check(scan->stamp_ms, arrival.time_s, line_clock_->offset_s())) {
    NoteLine(ScipLineTrouble::kBadStamp, *wrong);
    if (++bad_stamps_ < kBadStampsBeforeReconnect) return {};
    return Fail(ErrorCode::kDevice, "time stamps {}", *wrong);
  }
  bad_stamps_ = 0;
  NoteLine(ScipLineTrouble::kNone, "");
  stream.last_scan = SteadyClock::now();
  stream.stalls = 0;
  fruitless_ = 0;
  const ScipClock::LineTime placed = line_clock_->Place(scan->stamp_ms, arrival.time_s);
  LidarLine line = LineFromScan(*scan, options_.data);
  seq_ += placed.turns;
  line.seq = seq_;
  line.time_s = placed.time_s + options_.stamp_offset_s;
  // Turns between two streams were not wanted.
  const bool same_stream = std::exchange(counted_stream_, stream.number) == stream.number;
  HandOn(std::move(line), same_stream ? placed.turns - 1 : 0, stream.number);
  return {};
}

void ScipLidar::NoteLine(ScipLineTrouble trouble, const std::string& detail) {
  const std::lock_guard lock(mutex_);
  troubles_.Note(clock_->Now(), trouble, detail);
}

void ScipLidar::HandOn(LidarLine line, std::int64_t lost, std::int64_t stream_number) {
  const std::lock_guard lock(mutex_);
  health_.clock_offset_s = line_clock_->offset_s();
  health_.clock_drift_ppm = line_clock_->drift_ppm();
  if (desired_.number != stream_number) return;
  ++health_.lines;
  health_.lost_lines += lost;
  last_scan_ = SteadyClock::now();
  recent_.push_back(last_scan_);
  while (recent_.front() < last_scan_ - std::chrono::seconds(1)) recent_.pop_front();
  lines_.push_back(std::move(line));
  if (lines_.size() > kMostLines) {
    lines_.pop_front();
    ++health_.lost_lines;
  }
  changed_.notify_all();
}

/// Notes what went wrong and waits before the next attempt, if there is to be one.
void ScipLidar::AfterFailure(const Error& error, const std::stop_token& stop) {
  const std::string message = Explain(error);
  std::unique_lock lock(mutex_);
  connected_ = false;
  running_.reset();
  if (health_.last_error != message) LogWarning("{}", message);
  health_.last_error = message;
  const bool hopeless = error.code == ErrorCode::kInvalidInput;
  if (desired_.give_up && (hopeless || SteadyClock::now() >= *desired_.give_up)) {
    gave_up_ = Error{error.code, message};
    desired_.connection = false;
    changed_.notify_all();
    return;
  }
  changed_.wait_for(lock, stop, DurationOf(backoff_s_), [] { return false; });
  backoff_s_ = std::min(2.0 * backoff_s_, options_.last_backoff_s);
}

}  // namespace foresight
