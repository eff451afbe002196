#include "core/sensor/motor_track.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace foresight {

Result<MotorTrack> MotorTrack::FromSamples(std::vector<MotorSample> samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!std::isfinite(samples[i].time_s) || !std::isfinite(samples[i].angle_rad))
      return Fail(ErrorCode::kBadData, "motor track: sample {} is not finite", i);
    if (i > 0 && !(samples[i].time_s > samples[i - 1].time_s))
      return Fail(ErrorCode::kBadData, "motor track: time does not increase at sample {}", i);
  }
  MotorTrack track;
  track.samples_ = SharedArray<MotorSample>(std::span<const MotorSample>(samples));
  return track;
}

void MotorTrack::Add(const MotorSample& sample) {
  if (samples_.empty() || sample.time_s > samples_.back().time_s) samples_.push_back(sample);
}

double MotorTrack::AngleAt(double time_s) const {
  const auto by_time = [](const MotorSample& sample, double t) { return sample.time_s < t; };
  const auto at = std::lower_bound(samples_.begin(), samples_.end(), time_s, by_time);
  const bool has_before = at != samples_.begin() && time_s - (at - 1)->time_s <= kMaxGap_s;
  const bool has_after = at != samples_.end() && at->time_s - time_s <= kMaxGap_s;
  if (at != samples_.end() && at->time_s == time_s && samples_.size() == 1) return at->angle_rad;
  if (!has_before && !(has_after && at->time_s == time_s))
    return std::numeric_limits<double>::quiet_NaN();
  if (!has_after) return std::numeric_limits<double>::quiet_NaN();

  auto first = at;
  while (first != samples_.begin() && time_s - (first - 1)->time_s <= kWindow_s) --first;
  auto last = at;
  while (last != samples_.end() && last->time_s - time_s <= kWindow_s) ++last;
  // A sparse track: fall back on the neighbours.
  if (last - first < 3) {
    if (at->time_s == time_s) return at->angle_rad;
    const MotorSample& a = *(at - 1);
    const double part = (time_s - a.time_s) / (at->time_s - a.time_s);
    return a.angle_rad + part * (at->angle_rad - a.angle_rad);
  }
  double sum_t = 0.0, sum_a = 0.0, sum_tt = 0.0, sum_ta = 0.0;
  const double n = static_cast<double>(last - first);
  for (auto it = first; it != last; ++it) {
    const double t = it->time_s - time_s;
    sum_t += t;
    sum_a += it->angle_rad;
    sum_tt += t * t;
    sum_ta += t * it->angle_rad;
  }
  const double determinant = n * sum_tt - sum_t * sum_t;
  if (determinant < 1e-15) return sum_a / n;
  return (sum_tt * sum_a - sum_t * sum_ta) / determinant;
}

Result<AngleCorrection> AngleCorrection::FromKnots(std::vector<Knot> knots) {
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i].motor_rad) || !std::isfinite(knots[i].plate_rad))
      return Fail(ErrorCode::kInvalidOptions, "angle correction: knot {} is not finite", i);
    if (i > 0 && !(knots[i].motor_rad > knots[i - 1].motor_rad))
      return Fail(ErrorCode::kInvalidOptions, "angle correction: knot {} does not increase", i);
  }
  AngleCorrection correction;
  correction.knots_ = std::move(knots);
  const auto& k = correction.knots_;
  const std::size_t n = k.size();
  correction.curvature_.assign(n, 0.0);
  if (n < 3) return correction;
  // Thomas algorithm for the natural spline through the differences.
  const auto value = [&](std::size_t i) { return k[i].plate_rad - k[i].motor_rad; };
  std::vector<double> upper(n, 0.0);
  std::vector<double> right(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = k[i].motor_rad - k[i - 1].motor_rad;
    const double h1 = k[i + 1].motor_rad - k[i].motor_rad;
    const double slope = 6.0 * ((value(i + 1) - value(i)) / h1 - (value(i) - value(i - 1)) / h0);
    const double diagonal = 2.0 * (h0 + h1) - h0 * upper[i - 1];
    upper[i] = h1 / diagonal;
    right[i] = (slope - h0 * right[i - 1]) / diagonal;
  }
  for (std::size_t i = n - 2; i >= 1; --i)
    correction.curvature_[i] = right[i] - upper[i] * correction.curvature_[i + 1];
  return correction;
}

double AngleCorrection::PlateAngle(double motor_rad) const {
  if (knots_.empty()) return motor_rad;
  const auto difference = [&](std::size_t i) { return knots_[i].plate_rad - knots_[i].motor_rad; };
  if (motor_rad <= knots_.front().motor_rad) return motor_rad + difference(0);
  if (motor_rad >= knots_.back().motor_rad) return motor_rad + difference(knots_.size() - 1);
  const auto above =
      std::upper_bound(knots_.begin(), knots_.end(), motor_rad,
                       [](double x, const Knot& knot) { return x < knot.motor_rad; });
  const auto i = static_cast<std::size_t>(above - knots_.begin()) - 1;
  const double h = knots_[i + 1].motor_rad - knots_[i].motor_rad;
  const double b = (motor_rad - knots_[i].motor_rad) / h;
  const double a = 1.0 - b;
  return motor_rad + a * difference(i) + b * difference(i + 1) +
         ((a * a * a - a) * curvature_[i] + (b * b * b - b) * curvature_[i + 1]) * h * h / 6.0;
}

}  // namespace foresight
