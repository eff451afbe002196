#include "hardware/head/capture_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr std::chrono::microseconds kPoll{5000};
constexpr double kStandstillTimeout_s = 10.0;
/// The last lines still arrive after the motor has come to rest.
constexpr double kLateLines_s = 0.3;
/// A GigE camera that does not answer is given up after five tries of half a second, twice.
constexpr double kCameraAnswer_s = 6.0;

std::vector<double> InOrder(std::vector<double> angles_rad, double sign) {
  std::sort(angles_rad.begin(), angles_rad.end(),
            [sign](double a, double b) { return sign * a < sign * b; });
  return angles_rad;
}

}  // namespace

CaptureSweep::CaptureSweep(HeadDevices& devices, const CaptureOptions& options, const Scan& header,
                           ScanSink& sink, Hooks hooks)
    : devices_(devices),
      options_(options),
      plan_(header.plan),
      header_(header),
      sink_(sink),
      hooks_(std::move(hooks)),
      exposure_s_(ExposureOnHead(plan_, header.rig)),
      sign_(plan_.to_rad > plan_.from_rad ? 1.0 : -1.0),
      pictures_(*devices.camera, *devices.clock, InOrder(plan_.image_angles_rad, sign_)),
      gate_(header.rig.lidar, plan_.from_rad, plan_.to_rad),
      health_at_start_(ReadHealth(devices)) {}

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
  end = ComeToRest(end);
  HandOnLines();
  StopLidar();
  if (!end || !end->shutting_down) {
    const Step pictures = CollectPictures();
    if (!end) end = pictures;
  }
  if (!end) end = ShootMissing();
  HandOnPictures(true);
  Report(HeadState::kStopping);
  return end.value_or(JudgePictures());
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
  const Status configured = devices_.camera->Configure({exposure_s_, plan_.gain_db});
  if (!configured) return DeviceFailed(configured.error().message);
  const double start = plan_.from_rad - sign_ * options_.RunUp(plan_.speed_rad_s);
  const Status moving = devices_.motor->StartMove(start, options_.travel_speed_rad_s);
  if (!moving) return DeviceFailed(moving.error().message);
  return WaitForStandstill(TravelTimeout());
}

double CaptureSweep::TravelTimeout() const {
  const double longest_way = ScanPlan::kMaxAngle_rad - ScanPlan::kMinAngle_rad;
  return kStandstillTimeout_s + 2.0 * longest_way / options_.travel_speed_rad_s;
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
    if (lidar_health_ || ending) PumpTrack();
    Report(progress_.state);
  }
}

CaptureSweep::Step CaptureSweep::SweepThrough() {
  if (const Status started = devices_.lidar->Start(); !started)
    return DeviceFailed(started.error().message);
  last_line_s_ = Now();
  devices_.motor->TakeTrack();  // what led here is of no use to anyone
  if (plan_.picture_mode == ScanPlan::PictureMode::kStopAndShoot) next_picture_ = pictures_.size();
  for (int pass = 0; pass < plan_.passes; ++pass)
    if (Step over = SweepPass(pass)) return over;
  return std::nullopt;
}

CaptureSweep::Step CaptureSweep::SweepPass(int pass) {
  const bool back = pass % 2 == 1;
  if (back) {
    if (Step over = WaitForTurn()) return over;
    gate_ = LineGate(header_.rig.lidar, plan_.to_rad, plan_.from_rad);
  }
  const double run_out = sign_ * options_.RunUp(plan_.speed_rad_s);
  const double end = back ? plan_.from_rad - run_out : plan_.to_rad + run_out;
  if (const Status moving = devices_.motor->StartMove(end, plan_.speed_rad_s); !moving)
    return DeviceFailed(moving.error().message);
  stopped_since_s_.reset();
  while (!gate_.Passed() || next_picture_ < pictures_.size())
    if (Step over = SweepOnce()) return over;
  return std::nullopt;
}

/// Until the motor stands behind the scope. The lines of the turn belong to no pass.
CaptureSweep::Step CaptureSweep::WaitForTurn() {
  const double deadline_s = Now() + kStandstillTimeout_s;
  for (;;) {
    if (Step end = hooks_.interruption()) return end;
    if (Step failed = CheckMotor()) return failed;
    const Result<bool> moving = devices_.motor->Moving();
    if (!moving) return DeviceFailed(moving.error().message);
    if (!*moving) return std::nullopt;
    if (Now() > deadline_s)
      return DeviceFailed(fmt::format("{}: did not come to rest within {:.0f} s",
                                      devices_.motor->Describe(), kStandstillTimeout_s));
    if (Step end = ReceiveLine(std::chrono::duration<double>(kPoll).count())) return end;
    PumpTrack();
    HandOnLines();
    HandOnPictures(false);
    Report(HeadState::kSweeping);
  }
}

CaptureSweep::Step CaptureSweep::SweepOnce() {
  if (Step end = hooks_.interruption()) return end;
  if (Step end = CheckMotor()) return end;
  double free_s = 0.0;
  if (Step end = TriggerWhenDue(&free_s)) return end;
  if (Step end = ReceiveLine(free_s)) return end;
  if (Step end = CheckArrival()) return end;
  PumpTrack();
  HandOnLines();
  if (pictures_.Waiting()) pictures_.Receive(std::chrono::milliseconds(0));
  HandOnPictures(false);
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
  while (next_picture_ < pictures_.size()) {
    const double target = pictures_.Angle(next_picture_);
    const double now_rad = progress_.position.angle_rad;
    // The middle of the exposure is to lie at the angle.
    const double due_s = sign_ * (target - now_rad) / plan_.speed_rad_s - 0.5 * exposure_s_;
    if (due_s > kTimerStep_s) {
      *free_s = due_s;
      return std::nullopt;
    }
    if (due_s > 0.0)
      devices_.clock->Sleep(std::chrono::microseconds(static_cast<int>(due_s * 1e6)));
    pictures_.Trigger(next_picture_++);
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
  return std::nullopt;
}

/// A motor that stands although lines of the scope are still to come has failed.
CaptureSweep::Step CaptureSweep::CheckArrival() {
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

/// Waits until the motor stands, which it is told to where the scan must end; `end` if it must.
CaptureSweep::Step CaptureSweep::ComeToRest(Step end) {
  Report(HeadState::kStopping);
  if (end) devices_.motor->QuickStop();
  const Step failed = WaitForStandstill(kStandstillTimeout_s);
  return end ? end : failed;
}

CaptureSweep::Step CaptureSweep::CollectPictures() {
  while (pictures_.Waiting() && Now() - pictures_.LastNews_s() <= options_.camera_timeout_s) {
    if (Step end = hooks_.interruption(); end && end->shutting_down) return end;
    pictures_.Receive(std::chrono::milliseconds(100));
    PumpTrack();
    HandOnPictures(false);
    Report(progress_.state);
  }
  pictures_.StopWaiting();
  PumpTrack();
  HandOnPictures(false);
  return std::nullopt;
}

/// What the sweep did not bring, or was not to bring; what fails at the first time here is tried
/// once more.
CaptureSweep::Step CaptureSweep::ShootMissing() {
  const bool planned = plan_.picture_mode == ScanPlan::PictureMode::kStopAndShoot;
  Step end;
  for (int tries = planned ? 2 : 1; tries > 0 && !end && !pictures_.Missing().empty(); --tries)
    end = ComeToRest(ShootAtRest(pictures_.Missing()));
  return end;
}

/// Goes to the angle of each picture, the nearest end first, and takes it while the head stands.
CaptureSweep::Step CaptureSweep::ShootAtRest(std::vector<std::size_t> pictures) {
  Report(HeadState::kSweeping);
  const double here = progress_.position.angle_rad;
  if (std::abs(pictures_.Angle(pictures.back()) - here) <
      std::abs(pictures_.Angle(pictures.front()) - here))
    std::reverse(pictures.begin(), pictures.end());
  for (const std::size_t picture : pictures) {
    bool taken = false;
    if (Step end = ShootAtRest(picture, &taken)) return end;
    if (!taken) break;  // nor would it take the next one
  }
  return CollectPictures();
}

/// Waits for a camera that does not take the trigger; `taken` tells whether it did in the end.
CaptureSweep::Step CaptureSweep::ShootAtRest(std::size_t picture, bool* taken) {
  const Status moving =
      devices_.motor->StartMove(pictures_.Angle(picture), options_.travel_speed_rad_s);
  if (!moving) return DeviceFailed(moving.error().message);
  if (Step end = WaitForStandstill(TravelTimeout())) return end;
  if (Step end = StandFor(options_.settle_s)) return end;
  const double deadline_s = Now() + options_.camera_timeout_s;
  while (!(*taken = pictures_.Trigger(picture)) && Now() < deadline_s)
    if (Step end = StandFor(0.1)) return end;
  return *taken ? StandFor(exposure_s_ + options_.settle_s) : std::nullopt;
}

CaptureSweep::Step CaptureSweep::StandFor(double seconds) {
  const double end_s = Now() + seconds;
  while (Now() < end_s) {
    if (Step end = hooks_.interruption()) return end;
    if (Step failed = CheckMotor()) return failed;
    devices_.clock->Sleep(kPoll);
    PumpTrack();
    Report(progress_.state);
  }
  return std::nullopt;
}

/// All lines are there; a picture that is not is worth a word, and a camera that is gone a fault.
SweepEnd CaptureSweep::JudgePictures() {
  SweepEnd end;
  end.reason = pictures_.DescribeMissing();
  if (end.reason.empty()) return end;
  // A camera that was only slow says so when it is asked; one that is gone takes this long to tell.
  const double deadline_s = Now() + kCameraAnswer_s;
  CameraHealth camera = devices_.camera->Health();
  while (camera.connected && camera.suspect && Now() < deadline_s) {
    if (StandFor(0.05)) break;
    camera = devices_.camera->Health();
  }
  end.fault = !camera.connected || camera.suspect;
  return end;
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

void CaptureSweep::HandOnPictures(bool all) {
  progress_.frames += pictures_.HandOn(track_, sink_, all);
}

void CaptureSweep::Report(HeadState state) {
  progress_.state = state;
  hooks_.report(progress_);
}

}  // namespace foresight
