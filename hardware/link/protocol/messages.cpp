#include "hardware/link/protocol/messages.h"

#include <array>
#include <cmath>
#include <utility>

namespace foresight {
namespace {

constexpr std::array kStates = {
    std::pair{HeadState::kDisconnected, link::DISCONNECTED},
    std::pair{HeadState::kHoming, link::HOMING},
    std::pair{HeadState::kReady, link::READY},
    std::pair{HeadState::kSweeping, link::SWEEPING},
    std::pair{HeadState::kStopping, link::STOPPING},
    std::pair{HeadState::kFault, link::FAULT},
};

constexpr std::array kErrors = {
    std::pair{ErrorCode::kInvalidOptions, link::INVALID_OPTIONS},
    std::pair{ErrorCode::kInvalidInput, link::INVALID_INPUT},
    std::pair{ErrorCode::kBadData, link::BAD_DATA},
    std::pair{ErrorCode::kIo, link::IO},
    std::pair{ErrorCode::kDevice, link::DEVICE_FAILED},
    std::pair{ErrorCode::kState, link::WRONG_STATE},
    std::pair{ErrorCode::kTooFewPoints, link::TOO_FEW_POINTS},
    std::pair{ErrorCode::kNoConvergence, link::NO_CONVERGENCE},
    std::pair{ErrorCode::kCancelled, link::CANCELLED},
};

/// The first value that is not finite is the one that an error names.
class Finite {
 public:
  explicit Finite(const char* message) : message_(message) {}
  Finite& And(const char* member, double value) {
    if (fault_.empty() && !std::isfinite(value))
      fault_ = fmt::format("{}: {} is {}", message_, member, value);
    return *this;
  }
  Status Check() const {
    return fault_.empty() ? Status() : Fail(ErrorCode::kBadData, "{}", fault_);
  }

 private:
  const char* message_;
  std::string fault_;
};

}  // namespace

link::State ToMessage(HeadState state) {
  for (const auto& [ours, theirs] : kStates)
    if (ours == state) return theirs;
  return link::STATE_UNKNOWN;
}

std::optional<HeadState> FromMessage(link::State state) {
  for (const auto& [ours, theirs] : kStates)
    if (theirs == state) return ours;
  return std::nullopt;
}

link::Status ToMessage(const HeadStatus& status, bool with_health) {
  link::Status message;
  message.set_state(ToMessage(status.state));
  message.set_time_s(status.time_s);
  message.set_angle_rad(status.angle_rad);
  message.set_speed_rad_s(status.speed_rad_s);
  message.set_commanded_speed_rad_s(status.commanded_speed_rad_s);
  message.set_lines(status.lines);
  message.set_expected_lines(status.expected_lines);
  message.set_frames(status.frames);
  message.set_lost_lines(status.lost_lines);
  message.set_message(status.message);
  if (with_health) message.set_health_json(ToJson(status.health));
  return message;
}

Result<HeadStatus> FromMessage(const link::Status& message, const HeadHealth& before) {
  FORESIGHT_CHECK(Finite("the head's status")
                      .And("time_s", message.time_s())
                      .And("angle_rad", message.angle_rad())
                      .And("speed_rad_s", message.speed_rad_s())
                      .And("commanded_speed_rad_s", message.commanded_speed_rad_s())
                      .Check());
  const auto state = FromMessage(message.state());
  if (!state)
    return Fail(ErrorCode::kBadData, "the head's status: state {} is not known",
                static_cast<int>(message.state()));
  HeadStatus status;
  status.state = *state;
  status.time_s = message.time_s();
  status.angle_rad = message.angle_rad();
  status.speed_rad_s = message.speed_rad_s();
  status.commanded_speed_rad_s = message.commanded_speed_rad_s();
  status.lines = message.lines();
  status.expected_lines = message.expected_lines();
  status.frames = message.frames();
  status.lost_lines = message.lost_lines();
  status.message = message.message();
  status.health = before;
  if (!message.health_json().empty()) {
    FORESIGHT_TRY(status.health, HeadHealthFromJson(message.health_json()));
  }
  return status;
}

link::Outcome ToMessage(const Status& status) {
  link::Outcome outcome;
  if (status) return outcome;
  outcome.set_message(status.error().message);
  for (const auto& [ours, theirs] : kErrors)
    if (ours == status.error().code) outcome.set_error(theirs);
  return outcome;
}

Status FromMessage(const link::Outcome& outcome) {
  if (outcome.error() == link::NONE) return {};
  for (const auto& [ours, theirs] : kErrors)
    if (theirs == outcome.error()) return Fail(ours, "{}", outcome.message());
  return Fail(ErrorCode::kDevice, "{}", outcome.message());
}

link::HeadMotion ToMessage(const HeadMotion& motion) {
  link::HeadMotion message;
  message.set_acceleration_rad_s2(motion.acceleration_rad_s2);
  message.set_settle_s(motion.settle_s);
  message.set_travel_speed_rad_s(motion.travel_speed_rad_s);
  return message;
}

Result<HeadMotion> FromMessage(const link::HeadMotion& message) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (!positive(message.acceleration_rad_s2()) || !positive(message.travel_speed_rad_s()) ||
      !(message.settle_s() >= 0.0) || !std::isfinite(message.settle_s()))
    return Fail(ErrorCode::kBadData,
                "the head's motion: {} rad/s^2, {} s, {} rad/s: no head moves like that",
                message.acceleration_rad_s2(), message.settle_s(), message.travel_speed_rad_s());
  return HeadMotion{message.acceleration_rad_s2(), message.settle_s(),
                    message.travel_speed_rad_s()};
}

link::LiveViewRequest ToMessage(const LiveViewOptions& options) {
  link::LiveViewRequest message;
  message.set_rate_hz(options.rate_hz);
  message.set_largest_side_px(options.largest_side_px);
  message.set_exposure_s(options.exposure_s);
  message.set_gain_db(options.gain_db);
  if (options.part) {
    message.set_has_part(true);
    message.set_left(options.part->left);
    message.set_top(options.part->top);
    message.set_width(options.part->width);
    message.set_height(options.part->height);
  }
  return message;
}

Result<LiveViewOptions> FromMessage(const link::LiveViewRequest& message) {
  LiveViewOptions options;
  options.rate_hz = message.rate_hz();
  options.largest_side_px = message.largest_side_px();
  options.exposure_s = message.exposure_s();
  options.gain_db = message.gain_db();
  if (message.has_part())
    options.part = PixelRegion{message.left(), message.top(), message.width(), message.height()};
  FORESIGHT_CHECK(options.Check());
  return options;
}

link::StartStops ToMessage(const StopPlan& plan) {
  link::StartStops message;
  message.mutable_angles_rad()->Assign(plan.angles_rad.begin(), plan.angles_rad.end());
  message.set_lines(plan.lines);
  message.set_image(plan.image);
  message.set_exposure_s(plan.exposure_s);
  message.set_gain_db(plan.gain_db);
  return message;
}

Result<StopPlan> FromMessage(const link::StartStops& message) {
  StopPlan plan;
  plan.angles_rad.assign(message.angles_rad().begin(), message.angles_rad().end());
  plan.lines = message.lines();
  plan.image = message.image();
  plan.exposure_s = message.exposure_s();
  plan.gain_db = message.gain_db();
  FORESIGHT_CHECK(plan.Check());
  return plan;
}

bool Moves(const link::Command& command) {
  switch (command.what_case()) {
    case link::Command::kHome:
    case link::Command::kStartScan:
    case link::Command::kStartStops:
    case link::Command::kMoveStand:
      return true;
    default:
      return false;
  }
}

}  // namespace foresight
