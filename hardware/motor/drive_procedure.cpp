#include "hardware/motor/drive_procedure.h"

#include <cstdlib>
#include <optional>
#include <utility>

namespace foresight {

using cia402::DriveState;
using cia402::RxImage;
using cia402::TxImage;
using cia402::WordOrder;

namespace {

using Stage = DriveProcedure::Stage;

/// What a drive answers within a few of its cycles.
constexpr double kAnswer_s = 1.0;
/// A power stage may take its time to switch on.
constexpr double kEnable_s = 3.0;
/// Slower than this is at rest: a few counts of an encoder that trembles.
constexpr std::int32_t kRestSpeed = 25;

void Control(DriveWrites& writes, unsigned word) {
  writes.push_back({RxImage::kControl, {static_cast<std::uint16_t>(word)}});
}

/// A part of the image, in one write.
void Part(DriveWrites& writes, const RxImage& image, WordOrder order, std::uint16_t first,
          std::uint16_t count) {
  const RxImage::Registers all = image.Encode(order);
  const auto begin = all.begin() + (first - RxImage::kFirst);
  writes.push_back({first, {begin, begin + count}});
}

Stage ClearFault() {
  // The reset acts on a rising edge, so the bit goes down and up until the fault is gone.
  const auto toggle = [up = true](const TxImage& drive, DriveWrites& writes) mutable {
    const bool fault =
        drive.state() == DriveState::kFault || drive.state() == DriveState::kFaultReaction;
    up = !up;
    if (fault)
      Control(writes, up ? cia402::control::kFaultReset : cia402::control::kDisableVoltage);
    return Result<bool>(!fault);
  };
  return {"clear its fault", kAnswer_s, false, nullptr, toggle};
}

Stage ChangeMode(cia402::Mode mode, const char* goal) {
  return {goal, kAnswer_s, false,
          [mode](DriveWrites& writes) {
            writes.push_back({RxImage::kMode, {static_cast<std::uint8_t>(mode)}});
          },
          // What bits 10, 12 and 13 mean depends on the mode that is in force.
          [mode](const TxImage& drive, DriveWrites&) { return Result<bool>(drive.mode == mode); }};
}

Stage Enable() {
  const auto walk = [sent = std::optional<std::uint16_t>()](const TxImage& drive,
                                                            DriveWrites& writes) mutable {
    const DriveState state = drive.state();
    const std::uint16_t word = cia402::TowardsOperation(state);
    if (word == cia402::control::kDisableVoltage && state != DriveState::kNotReady)
      return Result<bool>(Fail(ErrorCode::kDevice, "cannot be enabled: {}", ToString(state)));
    if (state == DriveState::kOperationEnabled) return Result<bool>(true);
    if (sent != word) Control(writes, word);
    sent = word;
    return Result<bool>(false);
  };
  return {"enable its operation", kEnable_s, false, nullptr, walk};
}

/// Writes a word and goes on with the next poll, several cycles of the drive later.
Stage Say(std::function<void(DriveWrites&)> begin) {
  return {"answer", kAnswer_s, true, std::move(begin),
          [](const TxImage&, DriveWrites&) { return Result<bool>(true); }};
}

Stage SayAndSee(unsigned word, std::uint16_t mask, std::uint16_t bits, const char* goal) {
  return {goal, kAnswer_s, true, [word](DriveWrites& writes) { Control(writes, word); },
          [mask, bits](const TxImage& drive, DriveWrites&) {
            return Result<bool>((drive.status & mask) == bits);
          }};
}

constexpr std::uint16_t kHomingBits =
    cia402::status::kHomingError | cia402::status::kHomingAttained | cia402::status::kTargetReached;

/// How far the shaft went with the switch off, from where it was first seen so. A switch that fails
/// for a while makes an edge where there is none: then the way is long.
class WayWithoutSwitch {
 public:
  void See(const TxImage& drive) {
    const bool on = (drive.inputs & cia402::kHomeSwitchInput) != 0;
    if (!on && (was_on_ || !from_)) from_ = drive.position;
    if (!on) last_off_ = drive.position;
    was_on_ = on;
  }
  /// 64 bits: a broken drive may show positions at both ends of its range.
  std::int64_t counts() const { return from_ ? std::abs(std::int64_t{last_off_} - *from_) : 0; }

 private:
  bool was_on_ = false;
  std::optional<std::int32_t> from_;
  std::int32_t last_off_ = 0;
};

Stage FindZero(double timeout_s, std::int32_t edge_window) {
  return {"find its zero reference", timeout_s, true, nullptr,
          [edge_window, way = WayWithoutSwitch()](const TxImage& drive,
                                                  DriveWrites&) mutable -> Result<bool> {
            if ((drive.status & cia402::status::kHomingError) != 0)
              return Fail(ErrorCode::kDevice,
                          "found no edge of its home switch (homing error, 6041h = {:04X}h); check "
                          "the switch and home again",
                          drive.status);
            constexpr auto kDone = cia402::status::kHomingAttained | cia402::status::kTargetReached;
            if ((drive.status & kHomingBits) != kDone) {
              way.See(drive);  // behind the end the counts are others
              return false;
            }
            if (way.counts() > edge_window)
              return Fail(ErrorCode::kDevice,
                          "found its home switch {} counts from where it had gone off, more than "
                          "{}; check the switch and home again",
                          way.counts(), edge_window);
            return true;
          }};
}

/// Where homing ended the zero is: a drive that counts far from it has lost counts on the way.
Stage ShowZero(std::int32_t window) {
  return {"end its homing", kAnswer_s, true,
          [](DriveWrites& writes) { Control(writes, cia402::control::kEnableOperation); },
          [window](const TxImage& drive, DriveWrites&) -> Result<bool> {
            if (std::abs(std::int64_t{drive.position}) <= window) return true;
            return Fail(ErrorCode::kDevice,
                        "its encoder says {} counts where it has just found its zero, more than "
                        "{}; check the encoder and home again",
                        drive.position, window);
          }};
}

Stage Arrive(const MoveProfile& profile) {
  return {"reach its target", profile.timeout_s, true, nullptr,
          // The bit may still be that of the last move: the position has the last word.
          [profile](const TxImage& drive, DriveWrites&) {
            const bool reached = (drive.status & cia402::status::kTargetReached) != 0;
            const bool there =
                std::abs(std::int64_t{drive.position} - profile.target) <= profile.window;
            return Result<bool>(reached && there);
          }};
}

}  // namespace

DriveProcedure::DriveProcedure(std::vector<Stage> stages) : stages_(std::move(stages)) {}

Result<bool> DriveProcedure::Step(double time_s, const TxImage& drive, DriveWrites& writes) {
  while (at_ < stages_.size()) {
    const Stage& stage = stages_[at_];
    if (stage.needs_power && drive.state() != DriveState::kOperationEnabled)
      return Fail(ErrorCode::kDevice, "left operation enabled (6041h = {:04X}h, {})", drive.status,
                  ToString(drive.state()));
    if (!begun_) {
      begun_ = true;
      deadline_s_ = time_s + stage.timeout_s;
      if (stage.begin) {
        stage.begin(writes);
        return false;
      }
    }
    FORESIGHT_TRY(const bool reached, stage.reached(drive, writes));
    if (!reached) {
      if (time_s <= deadline_s_) return false;
      return Fail(ErrorCode::kDevice, "did not {} within {:.0f} ms (6041h = {:04X}h, {})",
                  stage.goal, 1e3 * stage.timeout_s, drive.status, ToString(drive.state()));
    }
    ++at_;
    begun_ = false;
  }
  return true;
}

DriveProcedure HomingProcedure(const HomingProfile& profile, WordOrder order) {
  RxImage image;
  image.homing_method = static_cast<std::int8_t>(profile.method);
  image.homing_search_speed = profile.search_speed;
  image.homing_edge_speed = profile.edge_speed;
  image.homing_acceleration = profile.acceleration;
  const auto parameters = [image, order](DriveWrites& writes) {
    Part(writes, image, order, RxImage::kHoming, RxImage::kHomingCount);
    Control(writes, cia402::control::kEnableOperation);
  };
  // Bits that say "done" may be those of the last homing: they are seen low first.
  return DriveProcedure(
      {ClearFault(), ChangeMode(cia402::Mode::kHoming, "change to homing mode"), Enable(),
       Say(parameters),
       SayAndSee(cia402::control::kEnableOperation | cia402::control::kStartHoming, kHomingBits, 0,
                 "begin to home"),
       FindZero(profile.timeout_s, profile.edge_window), ShowZero(profile.edge_window)});
}

DriveProcedure MoveProcedure(const MoveProfile& profile, WordOrder order) {
  RxImage image;
  image.target = profile.target;
  image.speed = profile.speed;
  image.acceleration = image.deceleration = profile.acceleration;
  const auto parameters = [image, order](DriveWrites& writes) {
    Part(writes, image, order, RxImage::kProfile, RxImage::kProfileCount);
  };
  constexpr auto kAcknowledged = cia402::status::kSetPointAcknowledged;
  constexpr unsigned kEnabled = cia402::control::kEnableOperation;
  constexpr unsigned kGo =
      kEnabled | cia402::control::kNewSetPoint | cia402::control::kChangeAtOnce;
  return DriveProcedure(
      {ChangeMode(cia402::Mode::kProfilePosition, "change to profile position mode"), Enable(),
       Say(parameters), SayAndSee(kEnabled, kAcknowledged, 0, "take back its acknowledgement"),
       SayAndSee(kGo, kAcknowledged, kAcknowledged, "acknowledge the target"),
       SayAndSee(kEnabled, kAcknowledged, 0, "take back its acknowledgement"), Arrive(profile)});
}

DriveProcedure StopProcedure(double timeout_s) {
  // Slow once may be the end of the ramp; slow in the next poll, too, is rest.
  const auto rests = [slow_before = false](const TxImage& drive, DriveWrites&) mutable {
    const bool slow = drive.state() != DriveState::kOperationEnabled &&
                      std::abs(std::int64_t{drive.velocity}) <= kRestSpeed;
    return Result<bool>(slow && std::exchange(slow_before, slow));
  };
  return DriveProcedure(
      {{"come to rest", timeout_s, false,
        [](DriveWrites& writes) { Control(writes, cia402::control::kQuickStop); }, rests}});
}

}  // namespace foresight
