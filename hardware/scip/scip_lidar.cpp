#include "hardware/scip/scip_lidar.h"

#include <algorithm>
#include <utility>

#include "core/base/contract.h"

namespace foresight {
namespace {

template <class Duration>
std::int64_t Milliseconds(Duration duration) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(duration).count();
}

}  // namespace

ScipLidar::ScipLidar(const ScipLidarOptions& options, std::shared_ptr<const SensorClock> clock)
    : options_(options),
      clock_(std::move(clock)),
      name_("lidar " + options.address.ToText()),
      backoff_s_(options.first_backoff_s) {
  FORESIGHT_EXPECTS(options_.Check().has_value(), options_.Check().error().message);
  FORESIGHT_EXPECTS(clock_ != nullptr, "lines need a clock");
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

ScipLidar::~ScipLidar() {
  thread_.request_stop();
  wake_.Raise();
}

std::string ScipLidar::Describe() const {
  const std::lock_guard lock(mutex_);
  if (identity_.parameters.model.empty()) return name_;
  return fmt::format("{} ({}{}{})", name_, identity_.parameters.model,
                     identity_.serial.empty() ? "" : " ", identity_.serial);
}

Status ScipLidar::Connect() {
  std::unique_lock lock(mutex_);
  if (connected_) return {};
  desired_.connection = true;
  desired_.give_up = SteadyClock::now() + DurationOf(options_.connect_timeout_s);
  gave_up_.reset();
  changed_.notify_all();
  changed_.wait(lock, [this] { return connected_ || gave_up_; });
  if (connected_) return {};
  return tl::unexpected(*gave_up_);
}

Status ScipLidar::Start() {
  std::unique_lock lock(mutex_);
  if (!desired_.connection) return Fail(ErrorCode::kState, "{}: is not connected", name_);
  desired_.stream = true;
  const std::int64_t number = ++desired_.number;
  lines_.clear();
  wake_.Raise();
  const bool started = changed_.wait_for(lock, DurationOf(options_.connect_timeout_s),
                                         [&] { return running_ == number; });
  last_scan_ = SteadyClock::now();
  if (started) return {};
  desired_.stream = false;
  ++desired_.number;
  wake_.Raise();
  return Fail(ErrorCode::kDevice, "{}: did not start to measure within {:.0f} ms{}{}", name_,
              1e3 * options_.connect_timeout_s,
              health_.last_error.empty() ? "" : "; last: ", health_.last_error);
}

void ScipLidar::Stop() {
  const std::lock_guard lock(mutex_);
  if (!desired_.stream) return;
  desired_.stream = false;
  ++desired_.number;
  lines_.clear();
  wake_.Raise();
}

Result<std::optional<LidarLine>> ScipLidar::WaitForLine(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  if (!desired_.stream) return Fail(ErrorCode::kState, "{}: is not measuring", name_);
  changed_.wait_for(lock, timeout, [this] { return !lines_.empty(); });
  if (!lines_.empty()) {
    LidarLine line = std::move(lines_.front());
    lines_.pop_front();
    return line;
  }
  const auto silence = SteadyClock::now() - last_scan_;
  if (silence < DurationOf(options_.lost_s)) return std::nullopt;
  if (const std::string trouble = troubles_.Describe(clock_->Now()); !trouble.empty())
    return Fail(ErrorCode::kDevice, "{}: {}", name_, trouble);
  const std::string why = connected_ || health_.last_error.empty() ? "" : "; " + health_.last_error;
  return Fail(ErrorCode::kDevice, "{}: no scan for {} ms{}", name_, Milliseconds(silence), why);
}

LidarHealth ScipLidar::Health() const {
  const std::lock_guard lock(mutex_);
  LidarHealth health = health_;
  const auto second_ago = SteadyClock::now() - std::chrono::seconds(1);
  health.line_rate_hz = static_cast<double>(
      std::count_if(recent_.begin(), recent_.end(), [&](auto time) { return time > second_ago; }));
  health.connected = connected_;
  health.trouble = troubles_.Describe(clock_->Now());
  health.streaming = desired_.stream && running_ == desired_.number && health.line_rate_hz > 0.0;
  return health;
}

}  // namespace foresight
