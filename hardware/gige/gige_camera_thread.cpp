// The thread of a GigeCamera: the only one that asks the camera.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/log.h"
#include "hardware/gige/gige_camera.h"

namespace foresight {
namespace {

/// A trigger that waited longer would take its image at another angle.
constexpr double kStaleTrigger_s = 0.1;
/// An image begins after its trigger was sent, but for the drift of the clocks since the last
/// reading.
constexpr double kStampError_s = 0.001;
/// A camera begins an image within so much of its trigger: triggers nearer to each other than this
/// cannot be told apart by time.
constexpr double kStartDelay_s = 0.02;
constexpr std::chrono::milliseconds kIdlePeriod{200};

}  // namespace

void GigeCamera::Work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      session_ ? Attend(stop) : OpenSession(stop);
    } catch (const std::exception& error) {
      DropSession(error.what());
    }
  }
  session_.reset();
}

/// Called from threads of Aravis.
void GigeCamera::Wake() {
  const std::lock_guard lock(mutex_);
  images_waiting_ = true;
  changed_.notify_all();
}

void GigeCamera::OpenSession(const std::stop_token& stop) {
  {
    std::unique_lock lock(mutex_);
    if (!changed_.wait(lock, stop, [this] { return wanted_; })) return;
  }
  Result<std::unique_ptr<GigeSession>> opened = GigeSession::Open(options_, [this] { Wake(); });
  const Status begun = opened ? BeginSession(**opened) : Status(tl::unexpected(opened.error()));
  if (begun) {
    session_ = std::move(*opened);
    return;
  }
  opened = tl::unexpected(begun.error());  // gives control back before the next attempt
  backoff_s_ = std::clamp(2.0 * backoff_s_, options_.first_backoff_s, options_.last_backoff_s);
  std::string before;
  {
    const std::lock_guard lock(mutex_);
    before = std::exchange(health_.last_error, begun.error().message);
  }
  if (before != begun.error().message) LogWarning("{}: {}", name_, begun.error().message);
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, stop, std::chrono::duration<double>(backoff_s_), [] { return false; });
}

Status GigeCamera::BeginSession(GigeSession& session) {
  FORESIGHT_CHECK(ReadClock(session));
  DesiredSettings desired;
  {
    const std::lock_guard lock(mutex_);
    desired = desired_;
  }
  const GigeSession::Limits& limits = session.limits();
  desired.settings.exposure_s =
      std::clamp(desired.settings.exposure_s, limits.shortest_s, limits.longest_s);
  desired.settings.gain_db =
      std::clamp(desired.settings.gain_db, limits.lowest_db, limits.highest_db);
  FORESIGHT_TRY(settings_, session.Apply(desired.settings));
  const double temperature_c = session.ReadTemperature_c();
  backoff_s_ = 0.0;
  const GigeSession::Identity identity = session.identity();
  LogInfo("{}: {} {}, serial number {}", name_, identity.vendor, identity.model, identity.serial);
  const std::lock_guard lock(mutex_);
  health_.reconnects = sessions_++;
  health_.temperature_c = temperature_c;
  health_.last_error.clear();
  limits_ = limits;
  connected_ = true;
  suspect_ = probe_due_ = false;
  triggers_.clear();
  changed_.notify_all();
  return {};
}

void GigeCamera::DropSession(const std::string& why) {
  LogError("{}: {}; connecting again", name_, why);
  {
    const std::lock_guard lock(mutex_);
    if (session_) CountSession();
    earlier_ = {health_.underruns, health_.resent_packets, health_.missing_packets};
    connected_ = false;
    health_.last_error = why;
    triggers_.clear();
    applied_ = desired_.number;
    applied_status_ = FailWith(why);
    changed_.notify_all();
  }
  session_.reset();  // takes up to 10 s; nobody waits for it
}

void GigeCamera::Attend(const std::stop_token& stop) {
  WaitForWork(stop);
  if (stop.stop_requested()) return;
  ApplyDesiredSettings();
  SendTriggers();
  TakeImages();
  // Every further question to a camera that is silent would take seconds.
  if (session_->answering()) ProbeIfSuspect();
  if (session_->answering()) KeepHouse();
  if (!session_->answering()) DropSession("does not answer");
}

void GigeCamera::WaitForWork(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  MarkOverdue();
  const double due_s = std::clamp(NextDue() - clock_->Now(), 0.0, 1.0);
  const auto longest =
      std::min<std::chrono::duration<double>>(kIdlePeriod, std::chrono::duration<double>(due_s));
  changed_.wait_for(lock, stop, longest, [this] {
    return images_waiting_ || probe_due_ || !triggers_.empty() || applied_ < desired_.number;
  });
  MarkOverdue();
}

void GigeCamera::ApplyDesiredSettings() {
  DesiredSettings desired;
  {
    const std::lock_guard lock(mutex_);
    if (applied_ >= desired_.number) return;
    desired = desired_;
  }
  const Result<CameraSettings> taken = session_->Apply(desired.settings);
  if (taken) settings_ = *taken;
  const std::lock_guard lock(mutex_);
  applied_ = desired.number;
  applied_status_ = taken ? Status() : Status(FailWith(taken.error().message));
  changed_.notify_all();
}

void GigeCamera::SendTriggers() {
  for (;;) {
    {
      const std::lock_guard lock(mutex_);
      if (triggers_.empty()) return;
      const std::int64_t seq = triggers_.front();
      triggers_.pop_front();
      const auto expected = std::find_if(expected_.begin(), expected_.end(),
                                         [&](const Expected& one) { return one.seq == seq; });
      const double now_s = clock_->Now();
      if (expected == expected_.end() || now_s - expected->called_s > kStaleTrigger_s) continue;
      expected->sent_s = now_s;
      expected->settings = settings_;
    }
    if (const Status sent = session_->Trigger(); !sent) {
      LogWarning("{}: {}", name_, sent.error().message);
      const std::lock_guard lock(mutex_);
      health_.last_error = sent.error().message;
      return;
    }
  }
}

void GigeCamera::TakeImages() {
  {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(images_waiting_, false)) return;
  }
  while (std::optional<GigeSession::ReceivedImage> received = session_->TakeImage())
    HandOn(std::move(*received));
  const std::lock_guard lock(mutex_);
  CountSession();
}

void GigeCamera::HandOn(GigeSession::ReceivedImage received) {
  const std::lock_guard lock(mutex_);
  if (!received.complete) {
    ++health_.incomplete;
    return;
  }
  suspect_ = false;
  const double start_s = camera_clock_.ToHead(received.device_s + options_.stamp_offset_s);
  const bool stamped = session_->HasClock();
  const std::optional<Expected> expected = stamped ? TakeExpected(start_s) : TakeOldestExpected();
  if (!expected) return;  // of a trigger that has been given up
  CameraFrame frame;
  frame.seq = expected->seq;
  frame.exposure_s = expected->settings.exposure_s;
  frame.gain_db = expected->settings.gain_db;
  // Without a clock in the camera the trigger's own time has to do.
  frame.time_s = (stamped ? start_s : *expected->sent_s) + 0.5 * frame.exposure_s;
  frame.image = std::move(received.image);
  frames_.push_back(std::move(frame));
  ++health_.frames;
  changed_.notify_all();
}

/// The trigger that an image begun at `start_s` belongs to: of those sent before, the nearest;
/// where the clocks cannot tell several apart, the oldest of them, for images come in the order of
/// their triggers. An image of a trigger that has been given up finds none, or its stamp would have
/// to be wrong.
std::optional<GigeCamera::Expected> GigeCamera::TakeExpected(double start_s) {
  const double error_s = kStampError_s + camera_clock_.uncertainty_s();
  const auto possible = [&](const Expected& one) {
    return one.sent_s && *one.sent_s <= start_s + error_s;
  };
  const auto distance_s = [&](const Expected& one) { return std::abs(start_s - *one.sent_s); };
  double nearest_s = std::numeric_limits<double>::infinity();
  for (const Expected& one : expected_)
    if (possible(one)) nearest_s = std::min(nearest_s, distance_s(one));
  const auto found = std::find_if(expected_.begin(), expected_.end(), [&](const Expected& one) {
    return possible(one) && distance_s(one) <= nearest_s + kStartDelay_s;
  });
  if (found == expected_.end()) return std::nullopt;
  Expected taken = *found;
  expected_.erase(found);
  return taken;
}

/// Without a clock in the camera: the oldest one.
std::optional<GigeCamera::Expected> GigeCamera::TakeOldestExpected() {
  if (expected_.empty() || !expected_.front().sent_s) return std::nullopt;
  Expected taken = expected_.front();
  expected_.pop_front();
  return taken;
}

void GigeCamera::ProbeIfSuspect() {
  {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(probe_due_, false)) return;
  }
  const Status answered = session_->Probe();
  if (!answered || !session_->answering()) return;
  LogWarning("{}: answers, but an image did not come", name_);
  const std::lock_guard lock(mutex_);
  suspect_ = false;
  changed_.notify_all();
}

/// Reads the clock now and then, but not while an image is on its way.
void GigeCamera::KeepHouse() {
  if (std::chrono::duration<double>(SteadyClock::now() - last_reading_).count() < options_.resync_s)
    return;
  {
    const std::lock_guard lock(mutex_);
    if (!expected_.empty()) return;
  }
  if (const Status read = ReadClock(*session_); !read)
    LogWarning("{}: {}", name_, read.error().message);
  const double temperature_c = session_->ReadTemperature_c();
  const std::lock_guard lock(mutex_);
  health_.temperature_c = temperature_c;
}

Status GigeCamera::ReadClock(GigeSession& session) {
  last_reading_ = SteadyClock::now();
  if (!session.HasClock()) return {};
  std::vector<CameraClock::Reading> readings;
  for (int i = 0; i < options_.clock_readings; ++i) {
    FORESIGHT_TRY(const CameraClock::Reading reading, session.ReadClock(*clock_));
    readings.push_back(reading);
  }
  camera_clock_ = CameraClock(readings);
  const std::lock_guard lock(mutex_);
  health_.clock_offset_s = camera_clock_.offset_s();
  health_.clock_uncertainty_s = camera_clock_.uncertainty_s();
  return {};
}

void GigeCamera::CountSession() {
  const GigeSession::Counts counts = session_->counts();
  health_.underruns = earlier_.underruns + counts.underruns;
  health_.resent_packets = earlier_.resent_packets + counts.resent_packets;
  health_.missing_packets = earlier_.missing_packets + counts.missing_packets;
}

}  // namespace foresight
