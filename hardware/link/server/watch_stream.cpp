#include "hardware/link/server/watch_stream.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

namespace foresight {
namespace {

constexpr double kLook_s = 0.02;         ///< how soon a change is noticed
constexpr double kSilence_s = 1.0;       ///< a station hears something once a second
constexpr double kShortest_s = 0.05;     ///< between events, whatever the rate
constexpr double kScansEvery_s = 0.5;    ///< counts of a scan that runs
constexpr double kScansOfThin_s = 5.0;   ///< where nobody asks for a high rate
constexpr double kHealthEvery_s = 30.0;  ///< where nobody asks for a high rate
/// A station that wants at least so many events has the path for the devices' health.
constexpr double kFastRate_hz = 5.0;
constexpr double kHealthOfFast_s = 1.0;
constexpr std::size_t kMostScansAtFirst = 20;

}  // namespace

link::ScanOnHead ToMessage(const ShelvedScan& scan) {
  link::ScanOnHead message;
  message.set_scan_id(scan.uuid);
  message.set_state(ToString(scan.state));
  message.set_reason(scan.reason);
  message.set_begin_utc_ns(scan.begin_utc_ns);
  message.set_lines(scan.lines);
  message.set_expected_lines(scan.expected_lines);
  message.set_frames(scan.frames);
  message.set_bytes(scan.file_bytes);
  message.set_confirmed(scan.confirmed);
  return message;
}

void WatchStream::Read() {
  link::SignOfLife sign;
  while (stream_.Read(&sign) && still_good_()) {
    const bool has_control =
        !sign.control_token().empty() && desk_.SignOfLife(sign.control_token());
    const std::lock_guard lock(mutex_);
    sign_ = sign;
    if (!has_control) sign_.clear_control_token();
  }
  gone_ = true;
}

link::SignOfLife WatchStream::LastSign() {
  const std::lock_guard lock(mutex_);
  return sign_;
}

link::Event WatchStream::Compose(const link::SignOfLife& sign) const {
  const bool fast = sign.status_rate_hz() >= kFastRate_hz;
  const double now_s = desk_.Time();
  link::Event event;
  *event.mutable_status() = desk_.Now(false);
  const link::State state = event.status().state();
  const bool at_rest_again = state != sent_.status().state() &&
                             (state == link::READY || state == link::FAULT);  // devices may differ
  if (at_rest_again || now_s - health_s_ >= (fast ? kHealthOfFast_s : kHealthEvery_s))
    *event.mutable_status() = desk_.Now(true);
  event.set_answers(sign.number());
  event.set_operator_name(desk_.Holder());
  event.set_you_have_control(desk_.HasControl(sign.control_token()));
  event.set_desk_time_s(now_s);
  return event;
}

/// Whether what changed is worth sending now.
bool WatchStream::Due(const link::Event& event, double rate_hz) const {
  const double waited_s = event.desk_time_s() - sent_s_;
  if (waited_s >= kSilence_s) return true;
  if (waited_s < kShortest_s) return false;
  if (event.status().state() != sent_.status().state() ||
      event.status().message() != sent_.status().message() ||
      event.operator_name() != sent_.operator_name() || event.answers() != sent_.answers() ||
      event.you_have_control() != sent_.you_have_control())
    return true;
  return std::isfinite(rate_hz) && rate_hz > 0.0 && waited_s >= 1.0 / rate_hz;
}

/// With the scans that changed since the station heard of them.
bool WatchStream::Send(link::Event event, bool fast) {
  const std::int64_t news = desk_.shelf().News();
  const bool another = event.status().scan_id() != sent_.status().scan_id() ||
                       event.status().state() != sent_.status().state();
  const double every_s = fast || another ? kScansEvery_s : kScansOfThin_s;
  if (news != news_ && event.desk_time_s() - scans_s_ >= every_s) {
    std::vector<ShelvedScan> scans = desk_.shelf().List();
    if (news_ < 0) {
      // All scans of a long mission take minutes on a thin path: ListScans has them.
      std::erase_if(scans, [](const ShelvedScan& scan) { return scan.confirmed; });
      if (scans.size() > kMostScansAtFirst)
        scans.erase(scans.begin(), scans.end() - kMostScansAtFirst);
    }
    for (const ShelvedScan& scan : scans)
      if (scan.news > news_) *event.add_scans() = ToMessage(scan);
    news_ = news;
    scans_s_ = event.desk_time_s();
  }
  if (!stream_.Write(event)) return false;
  sent_s_ = event.desk_time_s();
  if (!event.status().health_json().empty()) health_s_ = sent_s_;
  sent_ = std::move(event);
  return true;
}

void WatchStream::Run(const std::atomic<bool>& closing) {
  const std::jthread reader([this] { Read(); });
  while (!closing && !gone_) {
    const link::SignOfLife sign = LastSign();
    link::Event event = Compose(sign);
    const bool fast = sign.status_rate_hz() >= kFastRate_hz;
    if (Due(event, sign.status_rate_hz()) && !Send(std::move(event), fast)) break;
    std::this_thread::sleep_for(std::chrono::duration<double>(kLook_s));
  }
  if (!gone_ || !still_good_()) {
    context_.TryCancel();  // or the reader would wait for a station that says nothing more
    return;
  }
  // A station that says nothing more has its last sign answered, which may be its only one.
  const link::SignOfLife sign = LastSign();
  if (sign.number() != sent_.answers() || sent_s_ < 0.0) Send(Compose(sign), false);
}

}  // namespace foresight
