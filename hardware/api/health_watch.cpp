#include "hardware/api/health_watch.h"

#include <fmt/format.h>

#include <algorithm>

namespace foresight {
namespace {

/// Two seconds of polls while the motor turns.
constexpr std::int64_t kFewPolls = 500;

/// Collects what is wrong with one device.
class Findings {
 public:
  void Add(const std::string& problem) { text_ += (text_.empty() ? "" : ", ") + problem; }
  /// `what` has a place for the number, which is told where it is above zero.
  void AddCount(std::int64_t count, fmt::format_string<std::int64_t&> what) {
    if (count > 0) Add(fmt::format(what, count));
  }
  DeviceDiagnosis Diagnosis() const {
    return {text_.empty() ? DeviceCondition::kWell : DeviceCondition::kDegraded, text_};
  }

 private:
  std::string text_;
};

DeviceDiagnosis Missing(const std::string& last_error) {
  return {DeviceCondition::kMissing,
          last_error.empty() ? "not connected" : "not connected: " + last_error};
}

DeviceDiagnosis DiagnoseLidar(const LidarHealth& now, const LidarHealth& before,
                              const HealthLimits& limits) {
  if (!now.connected) return Missing(now.last_error);
  Findings findings;
  findings.AddCount(now.lost_lines - before.lost_lines, "lines lost: {}");
  findings.AddCount(now.damaged - before.damaged, "damaged replies: {}");
  findings.AddCount(now.stalls - before.stalls, "fell silent: {} times");
  findings.AddCount(now.reconnects - before.reconnects, "connected again: {} times");
  findings.AddCount(now.reboots - before.reboots, "rebooted: {} times");
  if (now.sync_round_trip_s > limits.lidar_sync_round_trip_s)
    findings.Add(
        fmt::format("its clock is known to {:.0f} ms only", 500.0 * now.sync_round_trip_s));
  return findings.Diagnosis();
}

DeviceDiagnosis DiagnoseCamera(const CameraHealth& now, const CameraHealth& before,
                               const HealthLimits& limits) {
  if (!now.connected) return Missing(now.last_error);
  Findings findings;
  if (now.suspect) findings.Add("an image is overdue and the camera does not answer");
  findings.AddCount(now.lost - before.lost, "images that did not come: {}");
  findings.AddCount(now.incomplete - before.incomplete, "incomplete images: {}");
  findings.AddCount(now.underruns - before.underruns, "images without a free buffer: {}");
  findings.AddCount(now.reconnects - before.reconnects, "connected again: {} times");
  if (now.temperature_c > limits.camera_temperature_c)
    findings.Add(fmt::format("hot: {:.1f} °C", now.temperature_c));
  return findings.Diagnosis();
}

DeviceDiagnosis DiagnoseMotor(const MotorHealth& now, const MotorHealth& before,
                              const HealthLimits& limits) {
  if (!now.connected) return Missing("");
  Findings findings;
  if (now.last_error != before.last_error && now.last_error != 0)
    findings.Add(fmt::format("the drive reported error {:04X}h", now.last_error));
  findings.AddCount(now.reconnects - before.reconnects, "connected again: {} times");
  if (now.round_trip_median_s > limits.motor_round_trip_s)
    findings.Add(fmt::format("answers slowly: {:.0f} ms", 1e3 * now.round_trip_median_s));
  const std::int64_t slow = now.slow_polls - before.slow_polls;
  // Of the few polls of a motor at rest some may be slow: nothing is measured with them.
  const std::int64_t polls = std::max<std::int64_t>(now.polls - before.polls, kFewPolls);
  if (static_cast<double>(slow) > limits.slow_polls * static_cast<double>(polls))
    findings.AddCount(slow, "slow polls: {}");
  return findings.Diagnosis();
}

}  // namespace

const char* ToString(DeviceCondition condition) {
  switch (condition) {
    case DeviceCondition::kWell:
      return "well";
    case DeviceCondition::kDegraded:
      return "degraded";
    case DeviceCondition::kMissing:
      return "missing";
  }
  return "unknown";
}

DeviceCondition HeadDiagnosis::Worst() const {
  return std::max({lidar.condition, camera.condition, motor.condition});
}

HeadDiagnosis Diagnose(const HeadHealth& now, const HeadHealth& before,
                       const HealthLimits& limits) {
  return {DiagnoseLidar(now.lidar, before.lidar, limits),
          DiagnoseCamera(now.camera, before.camera, limits),
          DiagnoseMotor(now.motor, before.motor, limits)};
}

HeadDiagnosis HealthWatch::Update(double time_s, const HeadHealth& health) {
  while (!recent_.empty() && recent_.front().time_s < time_s - kMemory_s) {
    before_ = std::move(recent_.front().health);
    recent_.pop_front();
  }
  recent_.push_back({time_s, health});
  return Diagnose(health, before_);
}

}  // namespace foresight
