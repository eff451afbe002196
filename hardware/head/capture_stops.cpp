#include "hardware/head/capture_stops.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kStopPoll{5};
/// A plate that moves by more between two captures at one stop is held by nothing.
constexpr double kStands_rad = RadiansFromDegrees(0.2);

}  // namespace

CaptureStops::CaptureStops(HeadDevices& devices, const CaptureOptions& options,
                           const StopPlan& plan, EncoderWatch& encoder, StopSink& sink,
                           CaptureSweep::Hooks hooks)
    : devices_(devices),
      options_(options),
      plan_(plan),
      moves_(devices, options, encoder),
      sink_(sink),
      hooks_(std::move(hooks)) {}

SweepEnd CaptureStops::Run() {
  SweepEnd end;
  try {
    if (const Step early = RunThrough()) end = *early;
  } catch (const std::exception& error) {
    end = {ScanState::kInterrupted, error.what(), true, false};
  }
  devices_.motor->QuickStop();
  devices_.lidar->Stop();
  if (end.reason.empty() && !missing_images_.empty())
    end.reason = fmt::format("no image came at {} deg{}{}", missing_images_,
                             camera_trouble_.empty() ? "" : ": ", camera_trouble_);
  try {
    sink_.OnStopsEnded(end.state, end.reason);
  } catch (const std::exception& error) {
    if (!end.fault) end = {ScanState::kInterrupted, error.what(), true, false};
  }
  return end;
}

CaptureStops::Step CaptureStops::RunThrough() {
  if (plan_.image) {
    const Status configured = devices_.camera->Configure({plan_.exposure_s, plan_.gain_db});
    if (!configured) return DeviceFailed(configured.error().message);
  }
  for (const double angle_rad : plan_.angles_rad) {
    if (Step end = GoTo(angle_rad)) return end;
    if (Step end = Capture(angle_rad)) return end;
  }
  return std::nullopt;
}

/// And stands there until nothing swings any more.
CaptureStops::Step CaptureStops::GoTo(double angle_rad) {
  const auto look = [this] { return Look(); };
  if (Step failed = moves_.Start(angle_rad, options_.travel_speed_rad_s)) return failed;
  if (Step end = moves_.WaitForStandstill(moves_.TravelTimeout(), look)) return end;
  return moves_.StandFor(options_.settle_s, look);
}

CaptureStops::Step CaptureStops::Capture(double target_rad) {
  StopCapture capture;
  capture.target_rad = target_rad;
  standing_.clear();
  stands_since_s_ = last_line_s_ = image_asked_s_ = Now();
  if (plan_.lines > 0) {
    if (const Status started = devices_.lidar->Start(); !started)
      return DeviceFailed(started.error().message);
  }
  image_seq_.reset();
  if (plan_.image) {
    if (const auto seq = devices_.camera->Trigger())
      image_seq_ = *seq;
    else
      camera_trouble_ = seq.error().message;
  }
  const auto wants_lines = [&] { return static_cast<int>(capture.lines.size()) < plan_.lines; };
  while (wants_lines() || image_seq_) {
    if (Step end = Look()) return end;
    if (wants_lines()) {
      if (Step end = ReceiveLine(&capture)) return end;
    } else {
      devices_.lidar->Stop();
      devices_.clock->Sleep(kStopPoll);
    }
    if (image_seq_) ReceiveImage(&capture);
  }
  devices_.lidar->Stop();
  return TellStop(&capture);
}

/// A line counts whose first beam was fired after the head had come to rest.
CaptureStops::Step CaptureStops::ReceiveLine(StopCapture* capture) {
  Result<std::optional<LidarLine>> line =
      devices_.lidar->WaitForLine(std::chrono::milliseconds(50));
  if (!line) return DeviceFailed(line.error().message);
  if (*line) {
    last_line_s_ = Now();
    if ((*line)->time_s < stands_since_s_) return std::nullopt;
    capture->lines.push_back(std::move(**line));
    ++progress_.lines;
  } else if (Now() - last_line_s_ > options_.lidar_timeout_s) {
    const std::string trouble = devices_.lidar->Health().trouble;
    return DeviceFailed(fmt::format(
        "{}: {}", devices_.lidar->Describe(),
        trouble.empty() ? fmt::format("no line for {:.0f} ms", 1e3 * (Now() - last_line_s_))
                        : trouble));
  }
  return std::nullopt;
}

void CaptureStops::ReceiveImage(StopCapture* capture) {
  Result<std::optional<CameraFrame>> frame =
      devices_.camera->WaitForFrame(std::chrono::milliseconds(0));
  if (!frame) {
    camera_trouble_ = frame.error().message;
  } else if (*frame && (*frame)->seq == *image_seq_) {
    capture->image = std::move(**frame);
    image_seq_.reset();
    ++progress_.frames;
    return;
  }
  if (Now() - image_asked_s_ > options_.camera_timeout_s) image_seq_.reset();
}

CaptureStops::Step CaptureStops::TellStop(StopCapture* capture) {
  if (Step end = PumpTrack()) return end;
  if (standing_.empty()) standing_.push_back(progress_.position);
  const auto [low, high] =
      std::minmax_element(standing_.begin(), standing_.end(),
                          [](const auto& a, const auto& b) { return a.angle_rad < b.angle_rad; });
  if (high->angle_rad - low->angle_rad > kStands_rad)
    return DeviceFailed(fmt::format("{}: the plate turned by {:.2f} deg while it should stand",
                                    devices_.motor->Describe(),
                                    DegreesFromRadians(high->angle_rad - low->angle_rad)));
  capture->position = {0.0, 0.0};
  for (const MotorSample& sample : standing_) {
    capture->position.time_s += sample.time_s;
    capture->position.angle_rad += sample.angle_rad;
  }
  capture->position.time_s /= static_cast<double>(standing_.size());
  capture->position.angle_rad /= static_cast<double>(standing_.size());
  if (capture->image) {
    capture->image->motor_angle_rad = capture->position.angle_rad;
    capture->image->target_angle_rad = capture->target_rad;
  } else if (plan_.image) {
    missing_images_ += fmt::format("{}{:.2f}", missing_images_.empty() ? "" : ", ",
                                   DegreesFromRadians(capture->target_rad));
  }
  sink_.OnStop(*capture);
  return std::nullopt;
}

/// What is looked at all the time: whether to go on, and how the motor does.
CaptureStops::Step CaptureStops::Look() {
  if (Step end = hooks_.interruption()) return end;
  if (Step failed = moves_.ReadPosition(&progress_.position)) return failed;
  if (Step end = PumpTrack()) return end;
  progress_.state = HeadState::kSweeping;
  hooks_.report(progress_);
  return std::nullopt;
}

CaptureStops::Step CaptureStops::PumpTrack() {
  return moves_.TakeTrack([this](const std::vector<MotorSample>& samples) {
    for (const MotorSample& sample : samples)
      if (sample.time_s >= stands_since_s_) standing_.push_back(sample);
  });
}

}  // namespace foresight
