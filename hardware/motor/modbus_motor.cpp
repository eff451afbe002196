#include "hardware/motor/modbus_motor.h"

#include <algorithm>
#include <cmath>

#include "core/base/contract.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

/// Two attempts with their timeouts for connecting and for the first answer.
constexpr int kAttemptTimeouts = 6;
/// A move may take twice its time, and this.
constexpr double kSlack_s = 2.0;
/// A position is carried on by its speed for no longer than a few polls.
constexpr double kLongestCarry_s = 0.02;

}  // namespace

ModbusMotor::ModbusMotor(const ModbusMotorOptions& options, std::shared_ptr<SensorClock> clock)
    : options_(options),
      clock_(std::move(clock)),
      name_(fmt::format("motor {}:{}", options.host, options.port)),
      count_rad_(RadiansFromDegrees(360.0) / options.counts_per_turn),
      link_(options.host, options.port, options.response_timeout) {
  FORESIGHT_EXPECTS(options_.Check().has_value(), options_.Check().error().message);
  FORESIGHT_EXPECTS(clock_ != nullptr, "samples need a clock");
}

ModbusMotor::~ModbusMotor() {
  thread_.request_stop();  // on its way out the thread stops the motor
}

Status ModbusMotor::Connect() {
  std::unique_lock lock(mutex_);
  if (!thread_.joinable())
    thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
  if (!connected_) {
    connect_now_ = true;
    wake_.notify_all();
    // The attempt that may be under way began before the operator asked.
    const int enough = attempts_ + 2;
    const auto ended = [&] { return connected_ || attempts_ >= enough; };
    changed_.wait_for(lock, kAttemptTimeouts * options_.response_timeout, ended);
    if (!connected_) {
      const bool tried = !last_attempt_.empty();
      return Fail(ErrorCode::kDevice, "{}", With(tried ? last_attempt_ : "cannot connect"));
    }
  }
  if (fault_ && fault_->of_link) fault_.reset();
  return {};
}

Status ModbusMotor::StartHoming() {
  const std::lock_guard lock(mutex_);
  if (!connected_) return Fail(ErrorCode::kState, "{}", With("is not connected"));
  fault_.reset();
  homed_ = false;
  HomingProfile profile;
  profile.search_speed = Counts(options_.homing_search_rad_s);
  profile.edge_speed = std::max(1, Counts(options_.homing_edge_rad_s));
  profile.acceleration = Counts(options_.acceleration_rad_s2);
  // Twice the ramp from the search, and 2 deg for the switch's hysteresis and the polls.
  constexpr double kSwitch_rad = RadiansFromDegrees(2.0);
  profile.edge_window = Counts(options_.homing_search_rad_s * options_.homing_search_rad_s /
                                   options_.acceleration_rad_s2 +
                               kSwitch_rad);
  profile.timeout_s = options_.homing_timeout_s;
  Post(Job::kHoming, HomingProcedure(profile, options_.word_order));
  return {};
}

bool ModbusMotor::Homed() const {
  const std::lock_guard lock(mutex_);
  return homed_;
}

Status ModbusMotor::StartMove(double angle_rad, double speed_rad_s) {
  const std::lock_guard lock(mutex_);
  FORESIGHT_CHECK(CheckReady());
  if (!homed_) return Fail(ErrorCode::kState, "{}", With("has no zero reference: home it first"));
  if (!(angle_rad >= options_.min_angle_rad && angle_rad <= options_.max_angle_rad))
    return Fail(ErrorCode::kDevice,
                "{}: refused a move to {:.2f} deg, its limits are {:.2f} and {:.2f} deg", name_,
                DegreesFromRadians(angle_rad), DegreesFromRadians(options_.min_angle_rad),
                DegreesFromRadians(options_.max_angle_rad));
  if (!(speed_rad_s > 0.0 && speed_rad_s <= options_.max_speed_rad_s))
    return Fail(ErrorCode::kDevice,
                "{}: refused a speed of {:.2f} deg/s, its limit is {:.2f} deg/s", name_,
                DegreesFromRadians(speed_rad_s), DegreesFromRadians(options_.max_speed_rad_s));
  MoveProfile profile;
  profile.target = Counts(angle_rad);
  profile.speed = std::max(1, Counts(speed_rad_s));
  profile.acceleration = Counts(options_.acceleration_rad_s2);
  profile.window = 2;  // of the count it shows and the count it holds
  const double way_s = std::abs(angle_rad - last_->sample.angle_rad) / speed_rad_s;
  const double ramp_s = speed_rad_s / options_.acceleration_rad_s2;
  profile.timeout_s = 2.0 * (way_s + ramp_s) + kSlack_s;
  Post(Job::kMove, MoveProcedure(profile, options_.word_order));
  return {};
}

Result<bool> ModbusMotor::Moving() {
  const std::lock_guard lock(mutex_);
  FORESIGHT_CHECK(CheckReady());
  return busy_;
}

Result<MotorSample> ModbusMotor::Position() {
  const std::lock_guard lock(mutex_);
  FORESIGHT_CHECK(CheckReady());
  const double now_s = clock_->Now();
  const double age_s = std::clamp(now_s - last_->sample.time_s, 0.0, kLongestCarry_s);
  return MotorSample{now_s, last_->sample.angle_rad + age_s * last_->speed_rad_s};
}

std::vector<MotorSample> ModbusMotor::TakeTrack() {
  const std::lock_guard lock(mutex_);
  std::vector<MotorSample> samples(track_.begin(), track_.end());
  track_.clear();
  return samples;
}

void ModbusMotor::QuickStop() {
  const std::lock_guard lock(mutex_);
  if (!connected_) return;  // the drive's watchdog has stopped it
  posted_.reset();
  stop_requested_ = true;
  busy_ = true;
  wake_.notify_all();
}

MotorHealth ModbusMotor::Health() const {
  const std::lock_guard lock(mutex_);
  MotorHealth health = health_;
  health.connected = connected_;
  round_trips_.Describe(health);
  return health;
}

Status ModbusMotor::CheckReady() const {
  if (fault_) return Fail(ErrorCode::kDevice, "{}", With(fault_->message));
  if (!connected_ || !last_) return Fail(ErrorCode::kDevice, "{}", With("is not connected"));
  return {};
}

void ModbusMotor::Post(Job job, DriveProcedure procedure) {
  posted_ = Task{job, std::move(procedure)};
  busy_ = true;
  wake_.notify_all();
}

std::string ModbusMotor::With(const std::string& message) const {
  return fmt::format("{}: {}", name_, message);
}

std::int32_t ModbusMotor::Counts(double angle_rad) const {
  return static_cast<std::int32_t>(std::lround(angle_rad / count_rad_));
}

}  // namespace foresight
