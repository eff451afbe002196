#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/sensor/scan.h"
#include "hardware/head/capture_options.h"
#include "hardware/head/encoder_watch.h"
#include "hardware/head/head_devices.h"

namespace foresight {

/// How a sweep, or captures at stops, came to their end.
struct SweepEnd {
  ScanState state = ScanState::kComplete;
  std::string reason;
  bool fault = false;          ///< a device failed: the head needs the operator
  bool shutting_down = false;  ///< nothing may be waited for
};

/// What the head's motor does while something is captured. A step that gives an end could not be
/// made, or was ended by who looks on.
class MotorMoves {
 public:
  /// nullopt: go on.
  using Step = std::optional<SweepEnd>;
  /// Asked again and again while the motor is waited for.
  using Look = std::function<Step()>;

  /// `encoder` has seen all samples of the motor since its zero was found.
  MotorMoves(HeadDevices& devices, const CaptureOptions& options, EncoderWatch& encoder)
      : devices_(devices), options_(options), encoder_(encoder) {}

  Step Start(double angle_rad, double speed_rad_s);
  Step WaitForStandstill(double timeout_s, const Look& look);
  Step StandFor(double seconds, const Look& look);
  /// Until even the longest way at travel speed is over.
  double TravelTimeout() const;
  Step ReadPosition(MotorSample* position);
  /// What the encoder said since it was asked last, up to what the motor cannot have done.
  Step TakeTrack(const std::function<void(const std::vector<MotorSample>&)>& keep);

  static SweepEnd DeviceFailed(const std::string& message) {
    return {ScanState::kInterrupted, message, true, false};
  }
  static constexpr double kStandstillTimeout_s = 10.0;

 private:
  HeadDevices& devices_;
  const CaptureOptions& options_;
  EncoderWatch& encoder_;
};

}  // namespace foresight
