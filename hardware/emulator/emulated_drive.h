#pragma once

#include <memory>

#include "core/geometry/angles.h"
#include "core/simulation/world.h"
#include "hardware/emulator/emulated_axis.h"
#include "hardware/emulator/home_switch.h"
#include "hardware/motor/cia402.h"

namespace foresight {

struct EmulatedDriveOptions {
  cia402::WordOrder word_order = cia402::WordOrder::kHighFirst;
  double end_stop_rad = RadiansFromDegrees(120.0);        ///< either way
  double quick_stop_rad_s2 = RadiansFromDegrees(1200.0);  ///< 6085h
  double following_window_rad = RadiansFromDegrees(1.0);  ///< 6065h
  double watchdog_s = 0.5;  ///< without a request of its host for so long it stops by itself
  HomeSwitchOptions home_switch;
};

/// A CiA 402 drive in cycles of 1 ms: state machine, profile position, homing by method 20 (also 35
/// and 37), following error, watchdog. It shows the habits of real drives that trap clients: bits
/// 10, 12 and 13 of the statusword are a cycle old, and a written controlword acts in the next
/// cycle. Pure: it lives in the time that it is told, which never decreases. One thread at a time.
class EmulatedDrive {
 public:
  static constexpr double kCycle_s = 0.001;

  EmulatedDrive(std::shared_ptr<const World> world, std::shared_ptr<SimulatedShaft> shaft,
                const EmulatedDriveOptions& options, double time_s);

  /// Lets the cycles up to `time_s` pass.
  void Run(double time_s);

  /// What the host wrote; acts in the next cycle. Feeds the watchdog.
  void Write(double time_s, const cia402::RxImage& image);
  const cia402::RxImage& written() const { return rx_; }
  /// The host that commands is there.
  void FeedWatchdog(double time_s) { last_exchange_s_ = time_s; }
  /// What the host reads: feeds the watchdog.
  cia402::TxImage Read(double time_s);
  /// What anybody else reads. Position and velocity are those of `time_s`, the rest that of the
  /// last cycle.
  cia402::TxImage Image(double time_s) const;

  /// The shaft's true angle where the drive counts 0.
  double zero_rad() const { return zero_rad_; }

  // Faults.
  EmulatedAxis& axis() { return axis_; }
  HomeSwitch& home_switch() { return switch_; }
  /// The encoder says so much more than the shaft has turned; the drive itself does not notice.
  void SetEncoderOffset(double offset_rad) { encoder_offset_rad_ = offset_rad; }
  /// Bits 10, 12 and 13 stay as they are until then.
  void HoldStatusUntil(double time_s) { stale_until_s_ = time_s; }
  /// They are held and should be others.
  bool StatusIsStale() const { return time_s_ < stale_until_s_ && mode_bits_ != ModeBits(time_s_); }

 private:
  enum class HomingPhase { kIdle, kToSwitch, kOffSwitch, kOntoEdge, kBraking, kDone, kFailed };

  void Cycle(double time_s);
  void FollowControlword(double time_s);
  void LeaveOperation(double time_s, cia402::DriveState next);
  void CheckAxis(double time_s);
  void Operate(double time_s);
  void FollowSetPoints(double time_s);
  void BeginMove(double time_s);
  void BeginHoming(double time_s);
  void ContinueHoming(double time_s);
  void TakeZero(double home_rad);
  void PublishStatus(double time_s);
  std::uint16_t ModeBits(double time_s) const;

  double FromCounts(std::int32_t counts) const { return counts * step_rad_; }
  std::int32_t Count(double time_s) const;

  std::shared_ptr<const World> world_;
  EmulatedDriveOptions options_;
  double step_rad_;
  EmulatedAxis axis_;
  HomeSwitch switch_;
  double time_s_;
  double last_exchange_s_;
  double zero_rad_;
  double encoder_offset_rad_ = 0.0;

  cia402::RxImage rx_;
  std::uint16_t last_control_ = 0;
  cia402::DriveState state_ = cia402::DriveState::kSwitchOnDisabled;
  cia402::Mode mode_ = cia402::Mode::kNone;
  std::uint16_t error_code_ = 0;
  bool acknowledged_ = false;
  bool buffered_ = false;  ///< a set-point waits for the end of the running one
  double target_rad_ = 0.0;
  HomingPhase homing_ = HomingPhase::kIdle;
  double home_edge_rad_ = 0.0;

  std::uint16_t mode_bits_ = 0;  ///< of the last cycle
  std::uint16_t status_ = 0;
  double stale_until_s_ = 0.0;
};

}  // namespace foresight
