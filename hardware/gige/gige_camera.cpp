// What callers of a GigeCamera see: nothing here asks the camera.
#include "hardware/gige/gige_camera.h"

#include <algorithm>
#include <limits>

#include "core/base/contract.h"

namespace foresight {
namespace {

std::chrono::microseconds Microseconds(double seconds) {
  return std::chrono::microseconds(static_cast<std::int64_t>(1e6 * seconds));
}

}  // namespace

GigeCamera::GigeCamera(const GigeCameraOptions& options, std::shared_ptr<const SensorClock> clock)
    : options_(options), clock_(std::move(clock)), name_("camera " + options.address) {
  FORESIGHT_EXPECTS(clock_ != nullptr, "images have a time");
  FORESIGHT_EXPECTS(options_.Check().has_value(), options_.Check().error().message);
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

GigeCamera::~GigeCamera() = default;

tl::unexpected<Error> GigeCamera::FailWith(const std::string& message) const {
  return Fail(ErrorCode::kDevice, "{}: {}", name_, message);
}

Status GigeCamera::Connect() {
  std::unique_lock lock(mutex_);
  wanted_ = true;
  frames_.clear();
  expected_.clear();
  triggers_.clear();
  health_.last_error.clear();
  changed_.notify_all();
  if (changed_.wait_for(lock, Microseconds(options_.connect_timeout_s),
                        [this] { return connected_ && !suspect_; }))
    return {};
  return FailWith(health_.last_error.empty() ? "does not answer" : health_.last_error);
}

Status GigeCamera::CheckLimits(const CameraSettings& settings) const {
  if (!(settings.exposure_s >= limits_.shortest_s && settings.exposure_s <= limits_.longest_s))
    return Fail(ErrorCode::kInvalidOptions,
                "{}: an exposure of {:.3f} ms is not within its {:.3f} to {:.3f} ms", name_,
                1e3 * settings.exposure_s, 1e3 * limits_.shortest_s, 1e3 * limits_.longest_s);
  if (!(settings.gain_db >= limits_.lowest_db && settings.gain_db <= limits_.highest_db))
    return Fail(ErrorCode::kInvalidOptions,
                "{}: a gain of {:.1f} dB is not within its {:.1f} to {:.1f} dB", name_,
                settings.gain_db, limits_.lowest_db, limits_.highest_db);
  return {};
}

Status GigeCamera::Configure(const CameraSettings& settings) {
  std::unique_lock lock(mutex_);
  if (!connected_) return FailWith("is not connected");
  FORESIGHT_CHECK(CheckLimits(settings));
  desired_.settings = settings;
  const std::int64_t number = ++desired_.number;
  changed_.notify_all();
  if (!changed_.wait_for(lock, Microseconds(options_.configure_timeout_s),
                         [&] { return applied_ >= number; })) {
    suspect_ = probe_due_ = true;  // Connect waits until it is known what the camera is up to
    return FailWith(fmt::format("did not take its settings within {:.0f} ms",
                                1e3 * options_.configure_timeout_s));
  }
  return applied_status_;
}

Result<std::int64_t> GigeCamera::Trigger() {
  const std::lock_guard lock(mutex_);
  MarkOverdue();
  if (!connected_) return FailWith("is not connected");
  if (suspect_) return FailWith("does not answer");
  expected_.push_back({next_seq_, clock_->Now(), std::nullopt, desired_.settings, false});
  triggers_.push_back(next_seq_);
  changed_.notify_all();
  return next_seq_++;
}

Result<std::optional<CameraFrame>> GigeCamera::WaitForFrame(std::chrono::milliseconds timeout) {
  const auto deadline = SteadyClock::now() + timeout;
  std::unique_lock lock(mutex_);
  for (;;) {
    if (!frames_.empty()) {
      CameraFrame frame = std::move(frames_.front());
      frames_.pop_front();
      return frame;
    }
    if (MarkOverdue()) {
      const auto late = std::find_if(expected_.begin(), expected_.end(),
                                     [](const Expected& expected) { return expected.overdue; });
      const std::int64_t seq = late->seq;
      expected_.erase(late);
      ++health_.lost;
      health_.last_error = fmt::format("image {} did not come within {:.0f} ms", seq,
                                       1e3 * options_.frame_timeout_s);
      return FailWith(health_.last_error);
    }
    const auto due = SteadyClock::now() + Microseconds(std::min(NextDue() - clock_->Now(), 60.0));
    if (SteadyClock::now() >= deadline) return std::nullopt;
    changed_.wait_until(lock, std::min(deadline, due));
  }
}

CameraHealth GigeCamera::Health() const {
  const std::lock_guard lock(mutex_);
  MarkOverdue();
  CameraHealth health = health_;
  health.connected = connected_;
  health.suspect = suspect_;
  return health;
}

double GigeCamera::DueAt(const Expected& expected) const {
  return expected.called_s + expected.settings.exposure_s + options_.frame_timeout_s;
}

/// When the next image becomes overdue.
double GigeCamera::NextDue() const {
  double due_s = std::numeric_limits<double>::infinity();
  for (const Expected& expected : expected_)
    if (!expected.overdue) due_s = std::min(due_s, DueAt(expected));
  return due_s;
}

/// Whoever looks first notices, and sets the thread to find out; true while one is overdue.
bool GigeCamera::MarkOverdue() const {
  const double now_s = clock_->Now();
  bool any = false;
  for (Expected& expected : expected_) {
    if (!expected.overdue && now_s >= DueAt(expected)) {
      expected.overdue = true;
      suspect_ = true;
      probe_due_ = true;
      changed_.notify_all();
    }
    any = any || expected.overdue;
  }
  return any;
}

}  // namespace foresight
