#include "ui/viewmodels/timeline_axis.h"

#include <QDateTime>
#include <algorithm>
#include <array>
#include <cmath>

namespace foresight {
namespace {

constexpr std::int64_t kMs = 1'000'000, kSecond = 1000 * kMs, kMinute = 60 * kSecond,
                       kHour = 60 * kMinute, kDay = 24 * kHour;
constexpr std::array kSteps_ns = {5 * kMs,  10 * kMs,    50 * kMs,    100 * kMs,    500 * kMs,
                                  kSecond,  2 * kSecond, 5 * kSecond, 10 * kSecond, 30 * kSecond,
                                  kMinute,  2 * kMinute, 5 * kMinute, 10 * kMinute, 30 * kMinute,
                                  kHour,    2 * kHour,   6 * kHour,   12 * kHour,   kDay,
                                  7 * kDay, 30 * kDay,   365 * kDay};
/// Room beside what there is, as a fraction of it.
constexpr double kMargin = 0.02;

QString TextOf(std::int64_t utc_ns, std::int64_t step_ns) {
  const QDateTime time = QDateTime::fromMSecsSinceEpoch(utc_ns / kMs);
  if (step_ns >= kDay) return time.toString(QStringLiteral("yyyy-MM-dd"));
  if (step_ns >= kMinute) return time.toString(QStringLiteral("HH:mm"));
  if (step_ns >= kSecond) return time.toString(QStringLiteral("HH:mm:ss"));
  return time.toString(QStringLiteral("HH:mm:ss.zzz"));
}

}  // namespace

void TimelineAxis::SetLimits(std::int64_t begin_utc_ns, std::int64_t end_utc_ns) {
  const std::int64_t span = std::max(end_utc_ns - begin_utc_ns, kShortest_ns);
  const auto margin = static_cast<std::int64_t>(kMargin * static_cast<double>(span));
  first_utc_ns_ = begin_utc_ns - margin;
  last_utc_ns_ = begin_utc_ns + span + margin;
  ShowAll();
}

void TimelineAxis::Extend(std::int64_t begin_utc_ns, std::int64_t end_utc_ns) {
  const bool all = ShowsAll();
  const std::int64_t begin = begin_utc_ns_, span = end_utc_ns_ - begin_utc_ns_;
  SetLimits(begin_utc_ns, end_utc_ns);
  if (!all) MoveTo(begin, span);
}

void TimelineAxis::SetWidth(double width_px) {
  width_px_ = std::max(1.0, width_px);
}

bool TimelineAxis::ShowsAll() const {
  return begin_utc_ns_ == first_utc_ns_ && end_utc_ns_ == last_utc_ns_;
}

double TimelineAxis::XOf(std::int64_t utc_ns) const {
  return width_px_ * static_cast<double>(utc_ns - begin_utc_ns_) /
         static_cast<double>(end_utc_ns_ - begin_utc_ns_);
}

std::int64_t TimelineAxis::TimeAt(double x) const {
  return begin_utc_ns_ + static_cast<std::int64_t>(std::llround(
                             x / width_px_ * static_cast<double>(end_utc_ns_ - begin_utc_ns_)));
}

void TimelineAxis::MoveTo(std::int64_t begin_utc_ns, std::int64_t span_ns) {
  const std::int64_t span = std::clamp(span_ns, kShortest_ns, last_utc_ns_ - first_utc_ns_);
  begin_utc_ns_ = std::clamp(begin_utc_ns, first_utc_ns_, last_utc_ns_ - span);
  end_utc_ns_ = begin_utc_ns_ + span;
}

void TimelineAxis::ZoomAt(double x, double factor) {
  const auto span = static_cast<std::int64_t>(static_cast<double>(end_utc_ns_ - begin_utc_ns_) /
                                              std::max(factor, 1e-6));
  const std::int64_t kept = std::clamp(span, kShortest_ns, last_utc_ns_ - first_utc_ns_);
  const auto left = static_cast<std::int64_t>(x / width_px_ * static_cast<double>(kept));
  MoveTo(TimeAt(x) - left, kept);
}

void TimelineAxis::PanBy(double px) {
  MoveTo(TimeAt(px), end_utc_ns_ - begin_utc_ns_);
}

void TimelineAxis::ShowAll() {
  begin_utc_ns_ = first_utc_ns_;
  end_utc_ns_ = last_utc_ns_;
}

void TimelineAxis::ShowSpan(std::int64_t begin_utc_ns, std::int64_t end_utc_ns) {
  const std::int64_t span = std::max(end_utc_ns - begin_utc_ns, kShortest_ns);
  const std::int64_t margin = span / 10;
  MoveTo(begin_utc_ns - margin, span + 2 * margin);
}

void TimelineAxis::BringIntoSight(std::int64_t utc_ns) {
  const std::int64_t span = end_utc_ns_ - begin_utc_ns_;
  if (utc_ns < begin_utc_ns_)
    MoveTo(utc_ns - span / 10, span);
  else if (utc_ns > end_utc_ns_)
    MoveTo(utc_ns - span + span / 10, span);
}

std::vector<TimelineAxis::Tick> TimelineAxis::Ticks(double apart_px) const {
  const double least_ns = apart_px / width_px_ * static_cast<double>(end_utc_ns_ - begin_utc_ns_);
  std::int64_t step = kSteps_ns.back();
  for (const std::int64_t candidate : kSteps_ns)
    if (static_cast<double>(candidate) >= least_ns) {
      step = candidate;
      break;
    }
  while (static_cast<double>(step) < least_ns) step *= 2;
  // Round times of the local clock, not of UTC.
  const std::int64_t offset =
      kSecond * QDateTime::fromMSecsSinceEpoch(begin_utc_ns_ / kMs).offsetFromUtc();
  std::int64_t at = (begin_utc_ns_ + offset) / step * step - offset;
  while (at < begin_utc_ns_) at += step;
  std::vector<Tick> ticks;
  for (; at <= end_utc_ns_; at += step) ticks.push_back({XOf(at), TextOf(at, step)});
  return ticks;
}

}  // namespace foresight
