#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hardware/api/stop_capture.h"
#include "hardware/head/capture_sweep.h"

namespace foresight {

/// Goes from stop to stop and captures at each while the head stands. An image that does not come
/// costs that image, a motor or lidar that fails ends the captures; those that were made are with
/// the sink. Runs in the head's thread; the motor is at rest when Run returns, whatever happened.
class CaptureStops {
 public:
  /// `encoder` has seen all samples of the motor since its zero was found.
  CaptureStops(HeadDevices& devices, const CaptureOptions& options, const StopPlan& plan,
               EncoderWatch& encoder, StopSink& sink, CaptureSweep::Hooks hooks);

  /// Calls the sink to its OnStopsEnded. An exception of a device or of the sink ends the captures
  /// as interrupted.
  SweepEnd Run();

 private:
  using Step = MotorMoves::Step;

  Step RunThrough();
  Step GoTo(double angle_rad);
  Step Capture(double target_rad);
  Step ReceiveLine(StopCapture* capture);
  void ReceiveImage(StopCapture* capture);
  Step TellStop(StopCapture* capture);
  Step Look();
  Step PumpTrack();
  static SweepEnd DeviceFailed(const std::string& message) {
    return MotorMoves::DeviceFailed(message);
  }
  double Now() const { return devices_.clock->Now(); }

  HeadDevices& devices_;
  const CaptureOptions& options_;
  const StopPlan plan_;
  MotorMoves moves_;
  StopSink& sink_;
  CaptureSweep::Hooks hooks_;

  std::vector<MotorSample> standing_;  ///< since the head stands at this stop
  double stands_since_s_ = 0.0;
  double last_line_s_ = 0.0;
  std::optional<std::int64_t> image_seq_;  ///< triggered, and not come yet
  double image_asked_s_ = 0.0;
  std::string missing_images_;  ///< "5.00, 12.50", in degrees
  std::string camera_trouble_;
  SweepProgress progress_;
};

}  // namespace foresight
