#include "hardware/head/capture_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr std::chrono::microseconds kSweepPoll{5000};
/// The last lines still arrive after the motor has come to rest.
constexpr double kLateLines_s = 0.3;
/// A GigE camera that does not answer is given up after five tries of half a second, twice.
constexpr double kCameraAnswer_s = 6.0;
/// As near to its target a motor counts as arrived.
constexpr double kArrived_rad = RadiansFromDegrees(0.5);

std::vector<double> InOrder(std::vector<double> angles_rad, double sign) {
  std::sort(angles_rad.begin(), angles_rad.end(),
            [sign](double a, double b) { return sign * a < sign * b; });
  return angles_rad;
}

}  // namespace

CaptureSweep::CaptureSweep(HeadDevices& devices, const CaptureOptions& options, const Scan& header,
                           EncoderWatch& encoder, ScanSink& sink, Hooks hooks)
    : devices_(devices),
      options_(options),
      plan_(header.plan),
      header_(header),
      encoder_(encoder),
      moves_(devices, options, encoder),
      sink_(sink),
      hooks_(std::move(hooks)),
      exposure_s_(ExposureOnHead(plan_, header.rig)),
      sign_(plan_.to_rad > plan_.from_rad ? 1.0 : -1.0),
      images_(*devices.camera, *devices.clock, InOrder(plan_.image_angles_rad, sign_)),
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
  if (end && !end->shutting_down) DrainLines();
  end = ComeToRest(end);
  HandOnLines();
  StopLidar();
  if (!end || !end->shutting_down) {
    const Step images = CollectImages();
    if (!end) end = images;
  }
  if (!end) end = ShootMissing();
  HandOnImages(true);
  Report(HeadState::kStopping);
  if (!end) end = JudgeLines();
  return end ? *end : JudgeImages();
}

/// Why the sweep must end now, if it must: the operator, the program, or nowhere to put the scan.
CaptureSweep::Step CaptureSweep::CheckInterruption() {
  if (Step end = hooks_.interruption()) return end;
  if (const auto failure = sink_.Failure())
    return SweepEnd{ScanState::kInterrupted, *failure, false, false};
  return std::nullopt;
}

void CaptureSweep::StopLidar() {
  if (lidar_health_) return;
  lidar_health_ = devices_.lidar->Health();
  devices_.lidar->Stop();
}

CaptureSweep::Step CaptureSweep::MoveToStart() {
  if (Step end = CheckInterruption()) return end;
  const Status configured = devices_.camera->Configure({exposure_s_, plan_.gain_db});
  if (!configured) return DeviceFailed(configured.error().message);
  const double start = plan_.from_rad - sign_ * options_.RunUp(plan_.speed_rad_s);
  if (Step failed = moves_.Start(start, options_.travel_speed_rad_s)) return failed;
  return WaitForStandstill(moves_.TravelTimeout());
}

CaptureSweep::Step CaptureSweep::WaitForStandstill(double timeout_s) {
  const bool ending = progress_.state == HeadState::kStopping;
  return moves_.WaitForStandstill(timeout_s, [&]() -> Step {
    // On its way to rest nothing can stop the motor any sooner.
    if (!ending)
      if (Step end = CheckInterruption()) return end;
    if (const Step failed = CheckMotor()) return failed;
    if (const Step failed = PumpTrack(); failed && !ending) return failed;
    Report(progress_.state);
    return std::nullopt;
  });
}

CaptureSweep::Step CaptureSweep::SweepThrough() {
  if (const Status started = devices_.lidar->Start(); !started)
    return DeviceFailed(started.error().message);
  last_line_s_ = Now();
  if (Step failed = PumpTrack()) return failed;  // what led here is of no use to anyone
  recording_ = true;
  if (plan_.image_mode == ScanPlan::ImageMode::kStopAndShoot) next_image_ = images_.size();
  for (int pass = 0; pass < plan_.passes; ++pass)
    if (Step over = SweepPass(pass)) return over;
  return std::nullopt;
}

CaptureSweep::Step CaptureSweep::SweepPass(int pass) {
  const bool back = pass % 2 == 1;
  if (back) {
    if (Step over = WaitForTurn()) return over;
    gate_ = LineGate(header_.rig.lidar, plan_.to_rad, plan_.from_rad);
    unplaced_of_gate_ = 0;
  }
  const double run_out = sign_ * options_.RunUp(plan_.speed_rad_s);
  const double end = back ? plan_.from_rad - run_out : plan_.to_rad + run_out;
  if (Step failed = moves_.Start(end, plan_.speed_rad_s)) return failed;
  encoder_.ExpectMotion(back ? -sign_ : sign_, plan_.speed_rad_s);
  pass_end_rad_ = end;
  stopped_since_s_.reset();
  while (!gate_.Passed() || next_image_ < images_.size())
    if (Step over = SweepOnce()) return over;
  return std::nullopt;
}

/// Until the motor stands behind the scope. The lines of the turn belong to no pass.
CaptureSweep::Step CaptureSweep::WaitForTurn() {
  const double deadline_s = Now() + MotorMoves::kStandstillTimeout_s;
  for (;;) {
    if (Step end = CheckInterruption()) return end;
    if (Step failed = CheckMotor()) return failed;
    const Result<bool> moving = devices_.motor->Moving();
    if (!moving) return DeviceFailed(moving.error().message);
    if (!*moving) return std::nullopt;
    if (Now() > deadline_s)
      return DeviceFailed(fmt::format("{}: did not come to rest within {:.0f} s",
                                      devices_.motor->Describe(),
                                      MotorMoves::kStandstillTimeout_s));
    if (Step end = ReceiveLine(std::chrono::duration<double>(kSweepPoll).count())) return end;
    if (Step failed = PumpTrack()) return failed;
    HandOnLines();
    HandOnImages(false);
    Report(HeadState::kSweeping);
  }
}

CaptureSweep::Step CaptureSweep::SweepOnce() {
  if (Step end = CheckInterruption()) return end;
  if (Step end = CheckMotor()) return end;
  if (Step end = PumpTrack()) return end;  // before an image is taken where the motor is not
  double free_s = 0.0;
  if (Step end = TriggerWhenDue(&free_s)) return end;
  if (Step end = ReceiveLine(free_s)) return end;
  if (Step end = CheckArrival()) return end;
  if (Step end = PumpTrack()) return end;
  HandOnLines();
  if (images_.Waiting()) images_.Receive(std::chrono::milliseconds(0));
  HandOnImages(false);
  Report(HeadState::kSweeping);
  return std::nullopt;
}

CaptureSweep::Step CaptureSweep::CheckMotor() {
  return moves_.ReadPosition(&progress_.position);
}

/// Takes the images whose angle the motor is passing; `free_s` is the time until the next one.
CaptureSweep::Step CaptureSweep::TriggerWhenDue(double* free_s) {
  constexpr double kTimerStep_s = 0.001;  // a device's time-out is in whole milliseconds
  *free_s = std::numeric_limits<double>::infinity();
  while (next_image_ < images_.size()) {
    const double target = images_.Angle(next_image_);
    const double now_rad = progress_.position.angle_rad;
    // The middle of the exposure is to lie at the angle.
    const double due_s = sign_ * (target - now_rad) / plan_.speed_rad_s - 0.5 * exposure_s_;
    if (due_s > kTimerStep_s) {
      *free_s = due_s;
      return std::nullopt;
    }
    if (due_s > 0.0)
      devices_.clock->Sleep(std::chrono::microseconds(static_cast<int>(due_s * 1e6)));
    images_.Trigger(next_image_++);
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
    if (Step failed = CheckStamp(**line)) return failed;
    if (last_seq_ && (*line)->seq > *last_seq_ + 1) {
      progress_.lost_lines += static_cast<int>((*line)->seq - *last_seq_ - 1);
      NoteLidarTrouble();
    }
    last_seq_ = (*line)->seq;
    last_line_s_ = Now();
    gate_.Push(std::move(**line));
  } else if (Now() - last_line_s_ > options_.lidar_timeout_s) {
    NoteLidarTrouble();
    return DeviceFailed(fmt::format(
        "{}: {}", devices_.lidar->Describe(),
        lidar_trouble_.empty() ? fmt::format("no line for {:.0f} ms", 1e3 * (Now() - last_line_s_))
                               : lidar_trouble_));
  }
  return std::nullopt;
}

void CaptureSweep::NoteLidarTrouble() {
  std::string trouble = devices_.lidar->Health().trouble;
  if (!trouble.empty()) lidar_trouble_ = std::move(trouble);
}

/// A line whose stamp cannot be true would wait for ever for the motor to come by, and the motor
/// would be blamed.
CaptureSweep::Step CaptureSweep::CheckStamp(const LidarLine& line) {
  constexpr double kFuture_s = 0.1;  // by which two clocks may differ
  const double ahead_s = line.time_s - Now();
  const double since_s = last_stamp_s_ ? line.time_s - *last_stamp_s_ : 1.0;
  last_stamp_s_ = line.time_s;
  std::string what;
  if (!std::isfinite(line.time_s))
    what = "are no numbers";
  else if (since_s == 0.0)
    what = fmt::format("stand still at {:.3f} s", line.time_s);
  else if (since_s < 0.0)
    what = fmt::format("ran backwards by {:.3f} s", -since_s);
  else if (ahead_s > kFuture_s)
    what = fmt::format("jumped ahead by {:.3f} s", ahead_s);
  if (what.empty()) return std::nullopt;
  return DeviceFailed(fmt::format("{}: time stamps {}; switch the lidar off and on",
                                  devices_.lidar->Describe(), what));
}

/// A motor that stands although lines of the scope are still to come has failed; where it stands at
/// the end of its way, the lines are late.
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
  } else if (std::abs(progress_.position.angle_rad - pass_end_rad_) <= kArrived_rad) {
    if (Now() - *stopped_since_s_ <= options_.lidar_timeout_s) return std::nullopt;
    NoteLidarTrouble();
    return DeviceFailed(fmt::format(
        "{}: the motor reached the end of the scope {:.1f} s ago, and the lines up to there have "
        "not come: {}",
        devices_.lidar->Describe(), Now() - *stopped_since_s_,
        lidar_trouble_.empty()
            ? fmt::format("time stamps are {:.1f} s late", Now() - last_stamp_s_.value_or(0.0))
            : lidar_trouble_));
  } else if (Now() - *stopped_since_s_ > kLateLines_s) {
    return DeviceFailed(fmt::format("{}: stopped at {:.2f} deg, before the end of the scope",
                                    devices_.motor->Describe(),
                                    DegreesFromRadians(progress_.position.angle_rad)));
  }
  return std::nullopt;
}

/// Lines that were measured before the scan had to end may still be on their way.
void CaptureSweep::DrainLines() {
  if (!recording_) return;
  const double end_s = Now();
  devices_.motor->QuickStop();
  const LidarModel& lidar = header_.rig.lidar;
  const auto all_came = [&] { return last_stamp_s_ && *last_stamp_s_ + lidar.period_s > end_s; };
  while (!all_came() && Now() - end_s < kLateLines_s)
    if (ReceiveLine(lidar.period_s)) break;
  gate_.DropAfter(end_s);
  // The track must reach beyond the last beam before a line can be placed.
  const double track_end_s = end_s + lidar.BeamTime(lidar.beams) + 2.0 * MotorTrack::kWindow_s;
  while (Now() < track_end_s) devices_.clock->Sleep(kSweepPoll);
  PumpTrack();
  HandOnLines();
}

/// Waits until the motor stands, which it is told to where the scan must end; `end` if it must.
CaptureSweep::Step CaptureSweep::ComeToRest(Step end) {
  Report(HeadState::kStopping);
  if (end) devices_.motor->QuickStop();
  const Step failed = WaitForStandstill(MotorMoves::kStandstillTimeout_s);
  return end ? end : failed;
}

CaptureSweep::Step CaptureSweep::CollectImages() {
  while (images_.Waiting() && Now() - images_.LastNews_s() <= options_.camera_timeout_s) {
    if (Step end = hooks_.interruption(); end && end->shutting_down) return end;
    images_.Receive(std::chrono::milliseconds(100));
    PumpTrack();
    HandOnImages(false);
    Report(progress_.state);
  }
  images_.StopWaiting();
  PumpTrack();
  HandOnImages(false);
  return std::nullopt;
}

/// What the sweep did not bring, or was not to bring; what fails at the first time here is tried
/// once more.
CaptureSweep::Step CaptureSweep::ShootMissing() {
  const bool planned = plan_.image_mode == ScanPlan::ImageMode::kStopAndShoot;
  Step end;
  for (int tries = planned ? 2 : 1; tries > 0 && !end && !images_.Missing().empty(); --tries)
    end = ComeToRest(ShootAtRest(images_.Missing()));
  return end;
}

/// Goes to the angle of each image, the nearest end first, and takes it while the head stands.
CaptureSweep::Step CaptureSweep::ShootAtRest(std::vector<std::size_t> images) {
  Report(HeadState::kSweeping);
  const double here = progress_.position.angle_rad;
  if (std::abs(images_.Angle(images.back()) - here) <
      std::abs(images_.Angle(images.front()) - here))
    std::reverse(images.begin(), images.end());
  for (const std::size_t image : images) {
    bool taken = false;
    if (Step end = ShootAtRest(image, &taken)) return end;
    if (!taken) break;  // nor would it take the next one
  }
  return CollectImages();
}

/// Waits for a camera that does not take the trigger; `taken` tells whether it did in the end.
CaptureSweep::Step CaptureSweep::ShootAtRest(std::size_t image, bool* taken) {
  if (Step failed = moves_.Start(images_.Angle(image), options_.travel_speed_rad_s)) return failed;
  if (Step end = WaitForStandstill(moves_.TravelTimeout())) return end;
  if (Step end = StandFor(options_.settle_s)) return end;
  const double deadline_s = Now() + options_.camera_timeout_s;
  while (!(*taken = images_.Trigger(image)) && Now() < deadline_s)
    if (Step end = StandFor(0.1)) return end;
  return *taken ? StandFor(exposure_s_ + options_.settle_s) : std::nullopt;
}

CaptureSweep::Step CaptureSweep::StandFor(double seconds) {
  return moves_.StandFor(seconds, [&]() -> Step {
    if (Step end = CheckInterruption()) return end;
    if (Step failed = CheckMotor()) return failed;
    if (Step failed = PumpTrack()) return failed;
    Report(progress_.state);
    return std::nullopt;
  });
}

/// Most of the lines that were planned must have come.
CaptureSweep::Step CaptureSweep::JudgeLines() {
  const Result<ScanPrediction> planned = PredictScan(plan_, header_.rig);
  if (!planned) return std::nullopt;
  // The ends of the scope cut a line each or not, in each pass.
  const int rounding = 2 * plan_.passes;
  const int least = static_cast<int>(std::ceil(options_.line_floor * (planned->lines - rounding)));
  if (progress_.lines >= least) return std::nullopt;
  // A computer that stood still read no motor, and the lines of that time have no place.
  if (progress_.lines + unplaced_lines_ >= least)
    return SweepEnd{
        ScanState::kInterrupted,
        fmt::format("{} of {} planned lines have a place in the cloud: the angle of the "
                    "motor was not read for up to {:.2f} s, when {} lines were "
                    "measured; scan again",
                    progress_.lines, planned->lines, longest_hole_s_, unplaced_lines_),
        false, false};
  NoteLidarTrouble();
  return SweepEnd{ScanState::kInterrupted,
                  fmt::format("{} of {} planned lines came from the lidar{}{}", progress_.lines,
                              planned->lines, lidar_trouble_.empty() ? "" : ": ", lidar_trouble_),
                  false, false};
}

/// All lines are there; an image that is not is worth a word, and a camera that is gone a fault.
SweepEnd CaptureSweep::JudgeImages() {
  SweepEnd end;
  end.reason = images_.DescribeMissing();
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

CaptureSweep::Step CaptureSweep::PumpTrack() {
  return moves_.TakeTrack([this](const std::vector<MotorSample>& samples) {
    if (recording_) KeepTrack(samples);
  });
}

void CaptureSweep::KeepTrack(const std::vector<MotorSample>& samples) {
  for (const MotorSample& sample : samples) {
    if (!track_.empty())
      longest_hole_s_ = std::max(longest_hole_s_, sample.time_s - track_.samples().back().time_s);
    track_.Add(sample);
  }
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
  const int unplaced = gate_.Unplaced() - std::exchange(unplaced_of_gate_, gate_.Unplaced());
  unplaced_lines_ += unplaced;
  progress_.lost_lines += unplaced;
}

void CaptureSweep::HandOnImages(bool all) {
  progress_.frames += images_.HandOn(track_, sink_, all);
}

void CaptureSweep::Report(HeadState state) {
  progress_.state = state;
  hooks_.report(progress_);
}

}  // namespace foresight
