#include "hardware/head/capture_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/log.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr std::chrono::microseconds kPoll{5000};
constexpr double kStandstillTimeout_s = 10.0;
/// The last lines still arrive after the motor has come to rest.
constexpr double kLateLines_s = 0.3;

}  // namespace

CaptureSweep::CaptureSweep(HeadDevices& devices, const CaptureOptions& options, const Scan& header,
                           ScanSink& sink, Hooks hooks)
    : devices_(devices),
      options_(options),
      plan_(header.plan),
      header_(header),
      sink_(sink),
      hooks_(std::move(hooks)),
      sign_(plan_.to_rad > plan_.from_rad ? 1.0 : -1.0),
      image_angles_(plan_.image_angles_rad),
      gate_(header.rig.lidar, plan_.from_rad, plan_.to_rad),
      health_at_start_(ReadHealth(devices)) {
  std::sort(image_angles_.begin(), image_angles_.end(),
            [this](double a, double b) { return sign_ * a < sign_ * b; });
}

SweepEnd CaptureSweep::Run() {
  SweepEnd end;
  try {
    end = RunToTheEnd();
  } catch (const std::exception& error) {
    end = {ScanState::kInterrupted, error.what(), true, false};
  }
  devices_.motor->QuickStop();
  StopLidar();
  try {
    HeadHealth health = ReadHealth(devices_);
    health.lidar = *lidar_health_;
    sink_.OnDeviceHealth(health_at_start_, health);
    sink_.OnScanEnded(end.state, end.reason);
  } catch (const std::exception& error) {
    if (!end.fault) end = {ScanState::kInterrupted, error.what(), true, false};
  }
  return end;
}

SweepEnd CaptureSweep::RunToTheEnd() {
  sink_.OnScanStarted(header_);
  Step end = MoveToStart();
  if (!end) end = SweepThrough();
  Report(HeadState::kStopping);
  if (end) devices_.motor->QuickStop();
  const Step stop = WaitForStandstill(kStandstillTimeout_s);
  if (!end) end = stop;
  HandOnLines();
  StopLidar();
  if (!end || !end->shutting_down) {
    const Step frames = CollectFrames();
    if (!end) end = frames;
  }
  return end.value_or(SweepEnd{});
}

void CaptureSweep::StopLidar() {
  if (lidar_health_) return;
  lidar_health_ = devices_.lidar->Health();
  devices_.lidar->Stop();
}

SweepEnd CaptureSweep::DeviceFailed(const std::string& message) const {
  return {ScanState::kInterrupted, message, true, false};
}

CaptureSweep::Step CaptureSweep::MoveToStart() {
  if (Step end = hooks_.interruption()) return end;
  const Status configured = devices_.camera->Configure({plan_.exposure_s, plan_.gain_db});
  if (!configured) return DeviceFailed(configured.error().message);
  const double start = plan_.from_rad - sign_ * options_.RunUp(plan_.speed_rad_s);
  const Status moving = devices_.motor->StartMove(start, options_.travel_speed_rad_s);
  if (!moving) return DeviceFailed(moving.error().message);
  const double longest_way = ScanPlan::kMaxAngle_rad - ScanPlan::kMinAngle_rad;
  return WaitForStandstill(kStandstillTimeout_s + 2.0 * longest_way / options_.travel_speed_rad_s);
}

CaptureSweep::Step CaptureSweep::WaitForStandstill(double timeout_s) {
  const double deadline_s = Now() + timeout_s;
  const bool ending = progress_.state == HeadState::kStopping;
  for (;;) {
    // On its way to rest nothing can stop the motor any sooner.
    if (!ending)
      if (Step end = hooks_.interruption()) return end;
    if (const Step failed = CheckMotor()) return failed;
    const Result<bool> moving = devices_.motor->Moving();
    if (!moving) return DeviceFailed(moving.error().message);
    if (!*moving) return std::nullopt;
    if (Now() > deadline_s)
      return DeviceFailed(fmt::format("{}: did not come to rest within {:.0f} s",
                                      devices_.motor->Describe(), timeout_s));
    devices_.clock->Sleep(kPoll);
    if (ending) PumpTrack();
    Report(progress_.state);
  }
}

CaptureSweep::Step CaptureSweep::SweepThrough() {
  if (const Status started = devices_.lidar->Start(); !started)
    return DeviceFailed(started.error().message);
  last_line_s_ = Now();
  devices_.motor->TakeTrack();  // what led here is of no use to anyone
  const double end = plan_.to_rad + sign_ * options_.RunUp(plan_.speed_rad_s);
  if (const Status moving = devices_.motor->StartMove(end, plan_.speed_rad_s); !moving)
    return DeviceFailed(moving.error().message);
  while (!gate_.Passed() || next_image_ < image_angles_.size())
    if (Step over = SweepOnce()) return over;
  return std::nullopt;
}

CaptureSweep::Step CaptureSweep::SweepOnce() {
  if (Step end = hooks_.interruption()) return end;
  if (Step end = CheckMotor()) return end;
  double free_s = 0.0;
  if (Step end = TriggerWhenDue(&free_s)) return end;
  if (Step end = ReceiveLine(free_s)) return end;
  PumpTrack();
  HandOnLines();
  if (!triggered_.empty())
    if (Step end = ReceiveFrame(std::chrono::milliseconds(0))) return end;
  HandOnFrames(false);
  Report(HeadState::kSweeping);
  return std::nullopt;
}

CaptureSweep::Step CaptureSweep::CheckMotor() {
  const Result<MotorSample> position = devices_.motor->Position();
  if (!position) return DeviceFailed(position.error().message);
  progress_.position = *position;
  return std::nullopt;
}

/// Takes the pictures whose angle the motor is passing; `free_s` is the time until the next one.
CaptureSweep::Step CaptureSweep::TriggerWhenDue(double* free_s) {
  constexpr double kTimerStep_s = 0.001;  // a device's time-out is in whole milliseconds
  *free_s = std::numeric_limits<double>::infinity();
  while (next_image_ < image_angles_.size()) {
    const double target = image_angles_[next_image_];
    const double now_rad = progress_.position.angle_rad;
    // The middle of the exposure is to lie at the angle.
    const double due_s = sign_ * (target - now_rad) / plan_.speed_rad_s - 0.5 * plan_.exposure_s;
    if (due_s > kTimerStep_s) {
      *free_s = due_s;
      return std::nullopt;
    }
    if (due_s > 0.0)
      devices_.clock->Sleep(std::chrono::microseconds(static_cast<int>(due_s * 1e6)));
    if (const auto triggered = devices_.camera->Trigger(); !triggered)
      return DeviceFailed(triggered.error().message);
    triggered_.push_back(target);
    ++next_image_;
    if (Step end = CheckMotor()) return end;
  }
  return std::nullopt;
}

CaptureSweep::Step CaptureSweep::ReceiveLine(double longest_wait_s) {
  const auto timeout =
      std::chrono::milliseconds(static_cast<int>(1e3 * std::min(0.1, longest_wait_s)));
  Result<std::optional<LidarLine>> line = devices_.lidar->WaitForLine(timeout);
  if (!line) return DeviceFailed(line.error().message);
  if (*line) {
    if (last_seq_ && (*line)->seq > *last_seq_ + 1)
      progress_.lost_lines += static_cast<int>((*line)->seq - *last_seq_ - 1);
    last_seq_ = (*line)->seq;
    last_line_s_ = Now();
    gate_.Push(std::move(**line));
  } else if (Now() - last_line_s_ > options_.lidar_timeout_s) {
    return DeviceFailed(fmt::format("{}: no line for {:.0f} ms", devices_.lidar->Describe(),
                                    1e3 * (Now() - last_line_s_)));
  }
  const Result<bool> moving = devices_.motor->Moving();
  if (!moving) return DeviceFailed(moving.error().message);
  // Behind a silent lidar the motor may well have arrived: the lines to come will tell, or its
  // own time-out.
  const bool lidar_silent = Now() - last_line_s_ > kLateLines_s;
  if (*moving || lidar_silent) {
    stopped_since_s_.reset();
  } else if (!stopped_since_s_) {
    stopped_since_s_ = Now();
  } else if (Now() - *stopped_since_s_ > kLateLines_s) {
    return DeviceFailed(fmt::format("{}: stopped at {:.2f} deg, before the end of the scope",
                                    devices_.motor->Describe(),
                                    DegreesFromRadians(progress_.position.angle_rad)));
  }
  return std::nullopt;
}

CaptureSweep::Step CaptureSweep::ReceiveFrame(std::chrono::milliseconds timeout) {
  Result<std::optional<CameraFrame>> frame = devices_.camera->WaitForFrame(timeout);
  if (!frame) return DeviceFailed(frame.error().message);
  if (!*frame) return std::nullopt;
  (*frame)->target_angle_rad = triggered_.front();
  triggered_.pop_front();
  frames_.push_back(std::move(**frame));
  return std::nullopt;
}

CaptureSweep::Step CaptureSweep::CollectFrames() {
  double last_frame_s = Now();
  while (!triggered_.empty()) {
    if (Step end = hooks_.interruption(); end && end->shutting_down) return end;
    const std::size_t before = triggered_.size();
    if (Step failed = ReceiveFrame(std::chrono::milliseconds(100))) return failed;
    if (triggered_.size() < before) last_frame_s = Now();
    if (Now() - last_frame_s > options_.camera_timeout_s)
      return DeviceFailed(fmt::format("{}: {} pictures did not arrive within {:.0f} s",
                                      devices_.camera->Describe(), triggered_.size(),
                                      options_.camera_timeout_s));
    PumpTrack();
    HandOnFrames(false);
    Report(HeadState::kStopping);
  }
  PumpTrack();
  HandOnFrames(true);
  Report(HeadState::kStopping);
  return std::nullopt;
}

void CaptureSweep::PumpTrack() {
  const std::vector<MotorSample> samples = devices_.motor->TakeTrack();
  if (samples.empty()) return;
  for (const MotorSample& sample : samples) track_.Add(sample);
  sink_.OnMotorSamples(samples);
  const auto all = track_.samples();
  const MotorSample& last = all.back();
  const MotorSample& earlier = all[all.size() - std::min<std::size_t>(all.size(), 13)];
  if (last.time_s > earlier.time_s)
    progress_.speed_rad_s = (last.angle_rad - earlier.angle_rad) / (last.time_s - earlier.time_s);
}

void CaptureSweep::HandOnLines() {
  for (const LidarLine& line : gate_.Take(track_)) {
    sink_.OnLine(line);
    ++progress_.lines;
  }
}

/// Hands on the frames around whose exposure the track is known; `all`: no more samples will come.
void CaptureSweep::HandOnFrames(bool all) {
  while (!frames_.empty()) {
    CameraFrame& frame = frames_.front();
    const bool covered =
        !track_.empty() && track_.samples().back().time_s >= frame.time_s + MotorTrack::kWindow_s;
    if (!covered && !all) return;
    frame.motor_angle_rad = track_.AngleAt(frame.time_s);
    if (std::isfinite(frame.motor_angle_rad)) {
      sink_.OnFrame(frame);
      ++progress_.frames;
    } else {
      LogWarning("{}: dropped a picture taken while the motor's angle was not known",
                 devices_.camera->Describe());
    }
    frames_.erase(frames_.begin());
  }
}

void CaptureSweep::Report(HeadState state) {
  progress_.state = state;
  hooks_.report(progress_);
}

}  // namespace foresight
