#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hardware/api/sensor_head.h"
#include "hardware/head/capture_options.h"
#include "hardware/head/encoder_watch.h"
#include "hardware/head/head_devices.h"
#include "hardware/head/line_gate.h"
#include "hardware/head/motor_moves.h"
#include "hardware/head/sweep_images.h"

namespace foresight {

/// What a running sweep tells its head.
struct SweepProgress {
  HeadState state = HeadState::kSweeping;
  MotorSample position;
  double speed_rad_s = 0.0;
  int lines = 0;
  int frames = 0;
  int lost_lines = 0;
};

/// One scan, from the way to its start to the last frame: one pass or two, images in the first
/// one or after the last one, standing still. An image that does not come is tried
/// once more after the sweep, standing still; without it the scan is complete all the same, with a
/// reason. Without the lines that were planned it is not: below CaptureOptions::line_floor it ends
/// as interrupted, with the counts. An encoder that says what the motor cannot have done is a
/// fault. Runs in the head's thread; the motor is at rest when Run returns, whatever happened.
class CaptureSweep {
 public:
  struct Hooks {
    /// Why the sweep must end now, if it must. Asked several times a line.
    std::function<std::optional<SweepEnd>()> interruption;
    std::function<void(const SweepProgress&)> report;
  };

  /// `encoder` has seen all samples of the motor since its zero was found.
  CaptureSweep(HeadDevices& devices, const CaptureOptions& options, const Scan& header,
               EncoderWatch& encoder, ScanSink& sink, Hooks hooks);

  /// Calls the sink from OnScanStarted to OnScanEnded. An exception of a device or of the sink ends
  /// the scan as interrupted.
  SweepEnd Run();

 private:
  using Step = MotorMoves::Step;

  SweepEnd RunToTheEnd();
  Step MoveToStart();
  Step WaitForStandstill(double timeout_s);
  Step SweepThrough();
  Step SweepPass(int pass);
  Step SweepOnce();
  Step WaitForTurn();
  Step TriggerWhenDue(double* free_s);
  Step ReceiveLine(double longest_wait_s);
  Step CheckStamp(const LidarLine& line);
  Step CheckArrival();
  Step CheckInterruption();
  void DrainLines();
  Step ComeToRest(Step end);
  Step CollectImages();
  Step ShootAtRest(std::vector<std::size_t> images);
  Step ShootMissing();
  Step ShootAtRest(std::size_t image, bool* taken);
  Step StandFor(double seconds);
  SweepEnd JudgeImages();
  Step JudgeLines();
  Step CheckMotor();
  void StopLidar();
  Step PumpTrack();
  void KeepTrack(const std::vector<MotorSample>& samples);
  void NoteLidarTrouble();
  void HandOnLines();
  void HandOnImages(bool all);
  void Report(HeadState state);
  double Now() const { return devices_.clock->Now(); }
  static SweepEnd DeviceFailed(const std::string& message) {
    return MotorMoves::DeviceFailed(message);
  }

  HeadDevices& devices_;
  const CaptureOptions& options_;
  const ScanPlan plan_;
  const Scan& header_;
  EncoderWatch& encoder_;
  MotorMoves moves_;
  ScanSink& sink_;
  Hooks hooks_;

  const double exposure_s_;
  const double sign_;   ///< of the first pass
  SweepImages images_;  ///< in the order of the sweep
  std::size_t next_image_ = 0;
  MotorTrack track_;
  LineGate gate_;
  std::optional<std::int64_t> last_seq_;
  int unplaced_of_gate_ = 0;  ///< in this pass
  int unplaced_lines_ = 0;    ///< in all passes, counted among the lost lines
  double longest_hole_s_ = 0.0;
  double last_line_s_ = 0.0;
  std::optional<double> last_stamp_s_;
  std::string lidar_trouble_;  ///< what it last said is wrong with its lines
  bool recording_ = false;     ///< the lidar measures: the track belongs to the scan
  double pass_end_rad_ = 0.0;  ///< where the motor goes in the running pass
  std::optional<double> stopped_since_s_;
  SweepProgress progress_;
  const HeadHealth health_at_start_;
  std::optional<LidarHealth> lidar_health_;  ///< while it still measured
};

}  // namespace foresight
