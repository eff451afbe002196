// The thread of a ModbusMotor: the only one that talks to the drive.
#include <algorithm>
#include <cmath>

#include "core/base/log.h"
#include "hardware/motor/modbus_motor.h"

namespace foresight {

using cia402::DriveState;
using cia402::RxImage;
using cia402::TxImage;

namespace {

constexpr double kStopTimeout_s = 3.0;
constexpr std::chrono::milliseconds kFirstBackoff{50};
constexpr std::chrono::milliseconds kLongestBackoff{2000};
/// How often a motor is looked at that stands still and of which nothing is asked, and for how long
/// it must have stood.
constexpr double kIdlePollRate_hz = 20.0;
constexpr std::chrono::seconds kIdleAfter{1};
/// No head turns so far: a count like this is one with its words swapped.
constexpr int kMostTurns = 20;

}  // namespace

void ModbusMotor::Work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      if (!link_.IsOpen()) {
        KeepConnected(stop);
        continue;
      }
      TakeTask();
      Poll();
    } catch (const std::exception& error) {
      StopAfter(error.what());
    }
    next_poll_ = std::max(next_poll_ + std::chrono::duration_cast<WallClock::duration>(
                                           std::chrono::duration<double>(1.0 / PollRate_hz())),
                          WallClock::now());
    Rest(stop, next_poll_);
  }
  if (link_.IsOpen()) Write({{RxImage::kControl, {cia402::control::kQuickStop}}});
}

/// Sleeps until it is time, or until something is to be done at once.
void ModbusMotor::Rest(const std::stop_token& stop, WallClock::time_point until) {
  std::unique_lock lock(mutex_);
  wake_.wait_until(lock, stop, until, [this] {
    return connected_ ? stop_requested_ || (posted_ && !task_) : connect_now_;
  });
}

double ModbusMotor::PollRate_hz() const {
  const bool idle = WallClock::now() - last_active_ > kIdleAfter;
  return idle ? std::min(kIdlePollRate_hz, options_.poll_rate_hz) : options_.poll_rate_hz;
}

void ModbusMotor::KeepConnected(const std::stop_token& stop) {
  {
    const std::lock_guard lock(mutex_);
    connect_now_ = false;
  }
  const Status opened = OpenLink();
  if (!opened) {
    link_.Close();
    {
      const std::lock_guard lock(mutex_);
      ++attempts_;
      last_attempt_ = opened.error().message;
    }
    changed_.notify_all();
    backoff_ = std::clamp(2 * backoff_, kFirstBackoff, kLongestBackoff);
    return Rest(stop, WallClock::now() + backoff_);
  }
  backoff_ = std::chrono::milliseconds(0);
  next_poll_ = WallClock::now();
  if (++connections_ > 1) LogInfo("{}: connected again", name_);
  const std::lock_guard lock(mutex_);
  connected_ = true;
  health_.reconnects = connections_ - 1;
  changed_.notify_all();
}

/// Connects, looks whether that is our drive, and sees that it does not turn.
Status ModbusMotor::OpenLink() {
  FORESIGHT_CHECK(link_.Connect());
  TxImage::Registers registers{};
  const double sent_s = clock_->Now();
  FORESIGHT_CHECK(link_.Read(TxImage::kFirst, registers));
  const double answered_s = clock_->Now();
  const TxImage drive = TxImage::Decode(registers, options_.word_order);
  if (drive.state() == DriveState::kUnknown)
    return Fail(ErrorCode::kDevice, "register {} holds {:04X}h, no statusword of CiA 402",
                TxImage::kFirst, drive.status);
  if (std::abs(std::int64_t{drive.position}) > std::int64_t{kMostTurns} * options_.counts_per_turn)
    return Fail(ErrorCode::kDevice,
                "position of {} counts is beyond {} turns: check the mapping and the word order",
                drive.position, kMostTurns);
  constexpr std::uint16_t kStop = cia402::control::kQuickStop;
  FORESIGHT_CHECK(link_.Write(RxImage::kControl, {&kStop, 1}));
  const std::lock_guard lock(mutex_);
  track_.clear();
  round_trips_.Clear();
  last_ = Last{{0.5 * (sent_s + answered_s), (drive.position + 0.5) * count_rad_}, 0.0};
  return {};
}

void ModbusMotor::TakeTask() {
  const std::lock_guard lock(mutex_);
  if (stop_requested_) {
    stop_requested_ = false;
    if (task_ && task_->job == Job::kHoming) homed_ = false;
    task_ = Task{Job::kStop, StopProcedure(kStopTimeout_s)};
  } else if (posted_ && !(task_ && task_->job == Job::kStop)) {
    // A new target replaces the old one; what stops is not hurried.
    task_ = std::exchange(posted_, std::nullopt);
  }
}

void ModbusMotor::Poll() {
  TxImage::Registers registers{};
  const double sent_s = clock_->Now();
  const Status read = link_.Read(TxImage::kFirst, registers);
  const double answered_s = clock_->Now();
  if (!read)
    return link_.IsOpen() ? StopAfter(read.error().message) : LoseLink(read.error().message);
  const TxImage drive = TxImage::Decode(registers, options_.word_order);
  if (task_ || drive.velocity != 0) last_active_ = WallClock::now();
  Keep(drive, sent_s, answered_s);
  WatchForFault(drive);
  Continue(drive);
}

/// The drive answered somewhere between the two times: the middle is never wrong by more than half
/// the round trip.
void ModbusMotor::Keep(const TxImage& drive, double sent_s, double answered_s) {
  const std::lock_guard lock(mutex_);
  const MotorSample sample{0.5 * (sent_s + answered_s), (drive.position + 0.5) * count_rad_};
  ++health_.polls;
  const double longest_s = std::max(options_.slow_round_trip_s, 3.0 * round_trips_.Median_s());
  round_trips_.Add(sent_s, answered_s);
  if (drive.error_code != 0) health_.last_error = drive.error_code;
  last_ = Last{sample, drive.velocity * count_rad_};
  if (answered_s - sent_s > longest_s) {
    ++health_.slow_polls;
    return;
  }
  track_.push_back(sample);
  const auto most = static_cast<std::size_t>(options_.remembered_s * options_.poll_rate_hz);
  while (track_.size() > most) track_.pop_front();
}

void ModbusMotor::WatchForFault(const TxImage& drive) {
  const bool faulty =
      drive.state() == DriveState::kFault || drive.state() == DriveState::kFaultReaction;
  // Homing begins by clearing the fault; should it come back, homing fails by itself.
  if (!faulty || (task_ && task_->job == Job::kHoming)) return;
  {
    const std::lock_guard lock(mutex_);
    if (fault_ || (posted_ && posted_->job == Job::kHoming)) return;
  }
  StopAfter(fmt::format("{} (603F = {:04X}h); clear the obstacle and home again",
                        cia402::ErrorText(drive.error_code), drive.error_code));
}

void ModbusMotor::Continue(const TxImage& drive) {
  if (!task_) return;
  DriveWrites writes;
  const Result<bool> done = task_->procedure.Step(clock_->Now(), drive, writes);
  if (!done) {
    const bool faulty = drive.state() == DriveState::kFault && drive.error_code != 0;
    return StopAfter(faulty ? fmt::format("{} (603F = {:04X}h); clear the obstacle and home again",
                                          cia402::ErrorText(drive.error_code), drive.error_code)
                            : done.error().message);
  }
  if (!Write(writes)) return;
  if (*done) FinishTask();
}

/// False when it failed and that has been dealt with.
bool ModbusMotor::Write(const DriveWrites& writes) {
  for (const DriveWrite& write : writes) {
    const Status written = link_.Write(write.first, write.values);
    if (written) continue;
    link_.IsOpen() ? StopAfter(written.error().message) : LoseLink(written.error().message);
    return false;
  }
  return true;
}

void ModbusMotor::FinishTask() {
  const std::lock_guard lock(mutex_);
  if (task_->job == Job::kHoming) {
    homed_ = true;
    track_.clear();  // it counted from another zero
  }
  task_.reset();
  busy_ = posted_.has_value() || stop_requested_;
}

/// The motor stops and the operator has to come.
void ModbusMotor::StopAfter(const std::string& message) {
  {
    const std::lock_guard lock(mutex_);
    // What goes wrong with every poll stands in the log once.
    if (!fault_ || fault_->message != message) LogError("{}: {}", name_, message);
    fault_ = Fault{message, false};
    homed_ = false;
    posted_.reset();
    task_.reset();
    stop_requested_ = false;
    busy_ = false;
  }
  // Directly, not as a task: this may be all that still works.
  constexpr std::uint16_t kStop = cia402::control::kQuickStop;
  if (!link_.IsOpen()) return;
  const Status stopped = link_.Write(RxImage::kControl, {&kStop, 1});
  if (!stopped && !link_.IsOpen()) LoseLink(message);
}

void ModbusMotor::LoseLink(const std::string& message) {
  LogError("{}: {}", name_, message);
  link_.Close();
  const std::lock_guard lock(mutex_);
  connected_ = false;
  fault_ = Fault{message, true};
  homed_ = false;
  task_.reset();
  posted_.reset();
  stop_requested_ = false;
  busy_ = false;
}

}  // namespace foresight
