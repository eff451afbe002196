#include "hardware/emulator/scip_device.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hardware/scip/scip_status.h"

namespace foresight {
namespace {

constexpr double kRebootWindow_s = 1.0;
constexpr std::string_view kRebootOnceMore = "01";
constexpr std::string_view kNotInTimeMode = "03";
constexpr std::string_view kEndOutOfRange = "04";

ScipParameters ParametersOf(const LidarModel& lidar, const std::string& model) {
  ScipParameters parameters;
  parameters.model = model;
  parameters.min_range_mm = LidarLine::kFirstValidRange_mm;
  parameters.steps_per_turn =
      static_cast<int>(std::lround((2.0 * std::numbers::pi) / lidar.angle_step_rad));
  parameters.last_step = lidar.beams - 1;
  parameters.front_step =
      static_cast<int>(std::lround(-lidar.first_angle_rad / lidar.angle_step_rad));
  parameters.turns_per_min = 60.0 / lidar.period_s;
  return parameters;
}

/// The nearest range of a group of steps stands for it.
ScipEcho EchoOfGroup(const LidarLine& line, int first, int last) {
  ScipEcho nearest;
  for (int step = first; step <= last; ++step) {
    const auto i = static_cast<std::size_t>(step);
    if (step == first || line.range_mm[i] < nearest.range_mm)
      nearest = {line.range_mm[i], line.intensity[i]};
  }
  return nearest;
}

}  // namespace

ScipDevice::ScipDevice(const LidarModel& lidar, const Identity& identity, const LidarFaults& faults,
                       double now_s)
    : parameters_(ParametersOf(lidar, identity.model)),
      identity_(identity),
      faults_(faults),
      power_on_s_(now_s),
      clock_start_ms_(faults.clock_start_ms),
      abnormal_(faults.abnormal) {}

std::uint32_t ScipDevice::ClockAt(double time_s) const {
  double age_s = time_s - power_on_s_;
  double shift_s = clock_shift_s_;
  if (faults_.clock_jump_s != 0.0 && age_s >= faults_.clock_jump_after_s)
    shift_s += faults_.clock_jump_s;
  if (clock_stopped_s_) age_s = std::min(age_s, *clock_stopped_s_ - power_on_s_);
  if (faults_.clock_stop_after_s > 0.0) age_s = std::min(age_s, faults_.clock_stop_after_s);
  const double ms = 1e3 * (age_s * (1.0 + 1e-6 * faults_.clock_ppm) + shift_s);
  return static_cast<std::uint32_t>(std::llround(std::floor(ms)) + clock_start_ms_) & 0xFFFFFF;
}

std::uint32_t ScipDevice::HealthyClockAt(double time_s) const {
  return static_cast<std::uint32_t>(std::llround(std::floor(1e3 * (time_s - power_on_s_)))) &
         0xFFFFFF;
}

void ScipDevice::BeginConnection() {
  mode_ = Mode::kIdle;
  quits_ = 0;
  reboot_asked_s_.reset();
}

bool ScipDevice::TakeReboot() {
  return std::exchange(rebooted_, false);
}

std::optional<std::string_view> ScipDevice::Hindrance(double now_s) const {
  if (abnormal_) return scip_status::kAbnormal;
  if (now_s < power_on_s_ + faults_.boot_delay_s) return scip_status::kRefused;
  return std::nullopt;
}

std::string ScipDevice::Answer(std::string_view text, double now_s,
                               const std::function<LidarLine()>& newest_line) {
  const auto request = ParseScipRequest(text);
  if (!request) return EncodeScipReply(text, request.error());
  const std::string echo(text);
  switch (request->command) {
    case ScipCommand::kVersion:
      return AnswerVersion(echo);
    case ScipCommand::kParameters:
      return EncodeScipInfo(echo, ToFields(parameters_));
    case ScipCommand::kState:
      return AnswerState(echo, now_s);
    case ScipCommand::kQuit:
      if (faults_.ignores_first_quit && quits_++ == 0) return "";
      mode_ = Mode::kIdle;
      return EncodeScipReply(echo, scip_status::kOk);
    case ScipCommand::kReset:
      mode_ = Mode::kIdle;
      power_on_s_ = now_s - faults_.boot_delay_s;
      clock_start_ms_ = 0;
      return EncodeScipReply(echo, scip_status::kOk);
    case ScipCommand::kReboot:
      return AnswerReboot(echo, now_s);
    case ScipCommand::kEnterTime:
    case ScipCommand::kReadTime:
    case ScipCommand::kLeaveTime:
      return AnswerTime(*request, now_s);
    default:
      return AnswerScan(*request, now_s, newest_line);
  }
}

std::string ScipDevice::AnswerVersion(const std::string& echo) const {
  const std::pair<std::string, std::string> fields[] = {
      {"VEND", "Hokuyo Automatic Co., Ltd."},
      {"PROD", "SOKUIKI Sensor " + identity_.model},
      {"FIRM", "1.1.0(emulated)"},
      {"PROT", "SCIP 2.2"},
      {"SERI", identity_.serial},
  };
  return EncodeScipInfo(echo, fields);
}

std::string ScipDevice::AnswerState(const std::string& echo, double now_s) const {
  const bool measuring = mode_ == Mode::kStreaming || mode_ == Mode::kLaserOn;
  const std::pair<std::string, std::string> fields[] = {
      {"MODL", identity_.model},
      {"LASR", measuring ? "ON" : "OFF"},
      {"SCSP", std::to_string(std::lround(parameters_.turns_per_min))},
      {"MESM", mode_ == Mode::kStreaming ? "004 Multi_scan" : "000 Idle"},
      {"SBPS", "Ethernet 100 [Mbps]"},
      {"TIME", fmt::format("{:06X}", ClockAt(now_s))},
      {"STAT", abnormal_ ? "500 Abnormal" : "000 no error."},
  };
  return EncodeScipInfo(echo, fields);
}

std::string ScipDevice::AnswerReboot(const std::string& echo, double now_s) {
  if (!reboot_asked_s_ || now_s > *reboot_asked_s_ + kRebootWindow_s) {
    reboot_asked_s_ = now_s;
    return EncodeScipReply(echo, kRebootOnceMore);
  }
  BeginConnection();
  power_on_s_ = now_s;
  clock_start_ms_ = 0;
  abnormal_ = false;
  rebooted_ = true;
  return EncodeScipReply(echo, scip_status::kOk);
}

std::string ScipDevice::AnswerTime(const ScipRequest& request, double now_s) {
  const std::string echo = EncodeScipRequest(request);
  if (const auto hindrance = Hindrance(now_s)) return EncodeScipReply(echo, *hindrance);
  if (mode_ == Mode::kStreaming || mode_ == Mode::kLaserOn)
    return EncodeScipReply(echo, scip_status::kRefused);
  if (request.command == ScipCommand::kEnterTime) {
    const bool already = std::exchange(mode_, Mode::kTime) == Mode::kTime;
    return EncodeScipReply(echo, already ? scip_status::kAlready : scip_status::kOk);
  }
  if (mode_ != Mode::kTime) return EncodeScipReply(echo, kNotInTimeMode);
  if (request.command == ScipCommand::kReadTime) return EncodeScipTime(echo, ClockAt(now_s));
  mode_ = Mode::kIdle;
  return EncodeScipReply(echo, scip_status::kOk);
}

std::string ScipDevice::AnswerScan(const ScipRequest& request, double now_s,
                                   const std::function<LidarLine()>& newest_line) {
  const std::string echo = EncodeScipRequest(request);
  if (const auto hindrance = Hindrance(now_s)) return EncodeScipReply(echo, *hindrance);
  if (mode_ == Mode::kStreaming || mode_ == Mode::kTime)
    return EncodeScipReply(echo, scip_status::kRefused);
  if (request.command == ScipCommand::kLaserOn) {
    const bool already = std::exchange(mode_, Mode::kLaserOn) == Mode::kLaserOn;
    return EncodeScipReply(echo, already ? scip_status::kAlready : scip_status::kOk);
  }
  if (request.last_step > parameters_.last_step) return EncodeScipReply(echo, kEndOutOfRange);
  if (IsStream(request.command)) {
    mode_ = Mode::kStreaming;
    stream_ = request;
    return EncodeScipReply(echo, scip_status::kOk);
  }
  if (mode_ != Mode::kLaserOn) return EncodeScipReply(echo, scip_status::kRefused);
  return Encode(request, newest_line());
}

std::string ScipDevice::StreamScan(const LidarLine& line) {
  if (stream_.count == 0) return Encode(stream_, line);
  --stream_.count;
  if (stream_.count == 0) mode_ = Mode::kIdle;
  return Encode(stream_, line);
}

std::string ScipDevice::Encode(const ScipRequest& request, const LidarLine& line) const {
  ScipScan scan;
  scan.request = request;
  scan.stamp_ms = ClockAt(line.time_s);
  const int group = std::max(1, request.group);
  const int last_step = request.last_step - faults_.missing_beams;
  for (int first = request.first_step; first <= last_step; first += group) {
    const int last = std::min(first + group - 1, last_step);
    scan.steps.push_back({{EchoOfGroup(line, first, last)}, 1});
  }
  return EncodeScipScan(scan);
}

}  // namespace foresight
