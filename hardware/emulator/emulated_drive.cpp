#include "hardware/emulator/emulated_drive.h"

#include <cmath>

namespace foresight {

using cia402::DriveState;
using cia402::Mode;

namespace {

/// A search ends at the switch or at a mechanical stop, whichever comes first.
constexpr double kFarAway_rad = 100.0;
constexpr std::uint16_t kHostLost = 0x8130;

std::uint16_t StateBits(DriveState state) {
  switch (state) {
    case DriveState::kSwitchOnDisabled:
      return 0x40;
    case DriveState::kReadyToSwitchOn:
      return 0x21;
    case DriveState::kSwitchedOn:
      return 0x23;
    case DriveState::kOperationEnabled:
      return 0x27;
    case DriveState::kQuickStopActive:
      return 0x07;
    case DriveState::kFault:
      return 0x08;
    default:
      return 0x00;
  }
}

/// Where a controlword leads; the state itself where it asks for nothing. Fault and quick stop
/// that need an action are the caller's.
DriveState Next(DriveState state, std::uint16_t control) {
  const bool voltage = (control & 0x02U) != 0;
  const bool no_quick_stop = (control & 0x04U) != 0;
  const std::uint16_t command = control & 0x0FU;
  if (state == DriveState::kFault) return state;
  if (!voltage) return DriveState::kSwitchOnDisabled;
  if (!no_quick_stop) {
    const bool powered =
        state == DriveState::kOperationEnabled || state == DriveState::kQuickStopActive;
    return powered ? DriveState::kQuickStopActive : DriveState::kSwitchOnDisabled;
  }
  switch (state) {
    case DriveState::kSwitchOnDisabled:
      return (command & 0x07U) == 0x06 ? DriveState::kReadyToSwitchOn : state;
    case DriveState::kReadyToSwitchOn:
      return (command & 0x07U) == 0x07 ? DriveState::kSwitchedOn : state;
    case DriveState::kSwitchedOn:
    case DriveState::kOperationEnabled:
      if ((command & 0x07U) == 0x06) return DriveState::kReadyToSwitchOn;
      return command == 0x0F ? DriveState::kOperationEnabled : DriveState::kSwitchedOn;
    case DriveState::kQuickStopActive:
      return command == 0x0F ? DriveState::kOperationEnabled : state;
    default:
      return state;
  }
}

}  // namespace

EmulatedDrive::EmulatedDrive(std::shared_ptr<const World> world,
                             std::shared_ptr<SimulatedShaft> shaft,
                             const EmulatedDriveOptions& options, double time_s)
    : world_(std::move(world)),
      options_(options),
      step_rad_(world_->options().motor.encoder_step_rad),
      axis_(std::move(shaft), options.end_stop_rad, time_s),
      switch_(options.home_switch, world_->options().seed, axis_.AngleAt(time_s)),
      time_s_(time_s),
      last_exchange_s_(time_s),
      zero_rad_(axis_.AngleAt(time_s)) {
  PublishStatus(time_s);
}

void EmulatedDrive::Run(double time_s) {
  while (time_s_ + kCycle_s <= time_s) {
    time_s_ += kCycle_s;
    switch_.Update(axis_.AngleAt(time_s_));
    Cycle(time_s_);
  }
}

void EmulatedDrive::Write(double time_s, const cia402::RxImage& image) {
  rx_ = image;
  last_exchange_s_ = time_s;
}

cia402::TxImage EmulatedDrive::Read(double time_s) {
  last_exchange_s_ = time_s;
  return Image(time_s);
}

cia402::TxImage EmulatedDrive::Image(double time_s) const {
  cia402::TxImage image;
  image.status = status_;
  image.mode = mode_;
  image.position = Count(time_s);
  image.velocity = static_cast<std::int32_t>(std::lround(axis_.SpeedAt(time_s) / step_rad_));
  image.error_code = error_code_;
  image.inputs = switch_.on() ? cia402::kHomeSwitchInput : 0;
  return image;
}

/// The number of the encoder's step, of which the world tells the middle.
std::int32_t EmulatedDrive::Count(double time_s) const {
  const double middle_rad =
      world_->EncoderAngle(axis_.AngleAt(time_s) - zero_rad_) + encoder_offset_rad_;
  return static_cast<std::int32_t>(std::lround(middle_rad / step_rad_ - 0.5));
}

void EmulatedDrive::Cycle(double time_s) {
  axis_.Update(time_s);
  FollowControlword(time_s);
  CheckAxis(time_s);
  if (state_ == DriveState::kOperationEnabled) Operate(time_s);
  last_control_ = rx_.control;
  PublishStatus(time_s);
  mode_ = rx_.mode;
}

void EmulatedDrive::FollowControlword(double time_s) {
  const bool reset = (rx_.control & ~last_control_ & cia402::control::kFaultReset) != 0;
  if (state_ == DriveState::kFault && reset) {
    state_ = DriveState::kSwitchOnDisabled;
    error_code_ = 0;
    axis_.AcceptPosition(time_s);
    return;
  }
  const DriveState next = Next(state_, rx_.control);
  if (next == state_) return;
  if (state_ == DriveState::kOperationEnabled) LeaveOperation(time_s, next);
  // Whoever lost its host waits for a new command, not for the old one.
  if (state_ == DriveState::kQuickStopActive && error_code_ == kHostLost) {
    if (rx_.control == last_control_) return;
    error_code_ = 0;
  }
  // What moved the shaft while the drive was not holding it is not the drive's error.
  if (next == DriveState::kOperationEnabled && !axis_.Demanding(time_s))
    axis_.AcceptPosition(time_s);
  state_ = next;
}

void EmulatedDrive::LeaveOperation(double time_s, DriveState next) {
  axis_.Stop(time_s, options_.quick_stop_rad_s2);
  acknowledged_ = buffered_ = false;
  homing_ = HomingPhase::kIdle;
  state_ = next;
}

void EmulatedDrive::CheckAxis(double time_s) {
  if (state_ != DriveState::kOperationEnabled) return;
  if (axis_.FollowingError(time_s) > options_.following_window_rad) {
    if (mode_ == Mode::kHoming && homing_ != HomingPhase::kIdle) {
      axis_.AcceptPosition(time_s);
      homing_ = HomingPhase::kFailed;
      return;
    }
    LeaveOperation(time_s, DriveState::kFault);
    error_code_ = cia402::kFollowingError;
  } else if (time_s - last_exchange_s_ > options_.watchdog_s) {
    LeaveOperation(time_s, DriveState::kQuickStopActive);
    error_code_ = kHostLost;
  }
}

void EmulatedDrive::Operate(double time_s) {
  if ((rx_.control & ~last_control_ & cia402::control::kHalt) != 0)
    axis_.Stop(time_s, options_.quick_stop_rad_s2);
  if (mode_ == Mode::kProfilePosition) FollowSetPoints(time_s);
  if (mode_ == Mode::kHoming) {
    const bool start = (rx_.control & cia402::control::kStartHoming) != 0;
    const bool started = (last_control_ & cia402::control::kStartHoming) != 0;
    if (start && !started) BeginHoming(time_s);
    const bool running = homing_ != HomingPhase::kIdle && homing_ != HomingPhase::kDone &&
                         homing_ != HomingPhase::kFailed;
    if (running && !start) {
      axis_.Stop(time_s, options_.quick_stop_rad_s2);
      homing_ = HomingPhase::kIdle;
    } else if (running) {
      ContinueHoming(time_s);
    }
  }
}

void EmulatedDrive::FollowSetPoints(double time_s) {
  const bool bit = (rx_.control & cia402::control::kNewSetPoint) != 0;
  const bool before = (last_control_ & cia402::control::kNewSetPoint) != 0;
  if (!bit) acknowledged_ = false;
  if (bit && !before && !buffered_) {
    acknowledged_ = true;
    target_rad_ = zero_rad_ + FromCounts(rx_.target);
    buffered_ = true;
  }
  const bool at_once = (rx_.control & cia402::control::kChangeAtOnce) != 0;
  if (buffered_ && (at_once || !axis_.Demanding(time_s))) BeginMove(time_s);
}

void EmulatedDrive::BeginMove(double time_s) {
  buffered_ = false;
  // A drive with one of these at 0 does not move.
  if (rx_.speed > 0 && rx_.acceleration > 0)
    axis_.Move(time_s, target_rad_, FromCounts(rx_.speed), FromCounts(rx_.acceleration));
}

void EmulatedDrive::BeginHoming(double time_s) {
  const double search = FromCounts(rx_.homing_search_speed);
  const double acceleration = FromCounts(rx_.homing_acceleration);
  if (rx_.homing_method == 35 || rx_.homing_method == 37) {
    TakeZero(axis_.AngleAt(time_s));
    homing_ = HomingPhase::kBraking;
  } else if (rx_.homing_method != 20 || search <= 0.0 || rx_.homing_edge_speed <= 0 ||
             acceleration <= 0.0) {
    homing_ = HomingPhase::kFailed;
  } else {
    homing_ = switch_.on() ? HomingPhase::kOffSwitch : HomingPhase::kToSwitch;
    axis_.Move(time_s, switch_.on() ? -kFarAway_rad : kFarAway_rad, search, acceleration);
  }
}

/// Method 20: the edge is always taken upwards and slowly, wherever the search began.
void EmulatedDrive::ContinueHoming(double time_s) {
  const double search = FromCounts(rx_.homing_search_speed);
  const double edge = FromCounts(rx_.homing_edge_speed);
  const double acceleration = FromCounts(rx_.homing_acceleration);
  switch (homing_) {
    case HomingPhase::kToSwitch:
      if (!switch_.on()) return;
      homing_ = HomingPhase::kOffSwitch;
      return axis_.Move(time_s, -kFarAway_rad, search, acceleration);
    case HomingPhase::kOffSwitch:
      if (switch_.on()) return;
      homing_ = HomingPhase::kOntoEdge;
      return axis_.Move(time_s, kFarAway_rad, edge, acceleration);
    case HomingPhase::kOntoEdge:
      if (!switch_.on()) return;
      home_edge_rad_ = axis_.AngleAt(time_s);
      homing_ = HomingPhase::kBraking;
      return axis_.Stop(time_s, acceleration);
    case HomingPhase::kBraking:
      if (axis_.Demanding(time_s)) return;
      if (rx_.homing_method == 20) TakeZero(home_edge_rad_);
      homing_ = HomingPhase::kDone;
      return;
    default:
      return;
  }
}

void EmulatedDrive::TakeZero(double home_rad) {
  zero_rad_ = home_rad + FromCounts(rx_.home_offset);
}

/// Bits 10, 12 and 13 as they are now.
std::uint16_t EmulatedDrive::ModeBits(double time_s) const {
  namespace bits = cia402::status;
  if (mode_ == Mode::kHoming && homing_ != HomingPhase::kIdle) {
    if (homing_ == HomingPhase::kDone) return bits::kHomingAttained | bits::kTargetReached;
    if (homing_ == HomingPhase::kFailed) return bits::kHomingError | bits::kTargetReached;
    return 0;
  }
  std::uint16_t word = axis_.Demanding(time_s) || buffered_ ? 0 : bits::kTargetReached;
  if (mode_ == Mode::kProfilePosition && acknowledged_) word |= bits::kSetPointAcknowledged;
  return word;
}

void EmulatedDrive::PublishStatus(double time_s) {
  const std::uint16_t old = mode_bits_;
  if (time_s >= stale_until_s_) mode_bits_ = ModeBits(time_s);
  status_ = static_cast<std::uint16_t>(StateBits(state_) | cia402::status::kVoltage |
                                       cia402::status::kRemote | old);
}

}  // namespace foresight
