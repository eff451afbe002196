#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hardware/api/sensor_head.h"
#include "hardware/head/capture_options.h"
#include "hardware/head/head_devices.h"
#include "hardware/head/line_gate.h"
#include "hardware/head/sweep_pictures.h"

namespace foresight {

/// How a sweep came to its end.
struct SweepEnd {
  ScanState state = ScanState::kComplete;
  std::string reason;
  bool fault = false;          ///< a device failed: the head needs the operator
  bool shutting_down = false;  ///< nothing may be waited for
};

/// What a running sweep tells its head.
struct SweepProgress {
  HeadState state = HeadState::kSweeping;
  MotorSample position;
  double speed_rad_s = 0.0;
  int lines = 0;
  int frames = 0;
  int lost_lines = 0;
};

/// One scan, from the way to its start to the last frame: one pass or two, pictures in the first
/// one or after the last one, standing still. A picture that does not come is tried
/// once more after the sweep, standing still; without it the scan is complete all the same, with a
/// reason. Runs in the head's thread; the motor is at rest when Run returns, whatever happened.
class CaptureSweep {
 public:
  struct Hooks {
    /// Why the sweep must end now, if it must. Asked several times a line.
    std::function<std::optional<SweepEnd>()> interruption;
    std::function<void(const SweepProgress&)> report;
  };

  CaptureSweep(HeadDevices& devices, const CaptureOptions& options, const Scan& header,
               ScanSink& sink, Hooks hooks);

  /// Calls the sink from OnScanStarted to OnScanEnded. An exception of a device or of the sink ends
  /// the scan as interrupted.
  SweepEnd Run();

 private:
  /// nullopt: go on.
  using Step = std::optional<SweepEnd>;

  SweepEnd RunToTheEnd();
  Step MoveToStart();
  Step WaitForStandstill(double timeout_s);
  double TravelTimeout() const;
  Step SweepThrough();
  Step SweepPass(int pass);
  Step SweepOnce();
  Step WaitForTurn();
  Step TriggerWhenDue(double* free_s);
  Step ReceiveLine(double longest_wait_s);
  Step CheckArrival();
  Step ComeToRest(Step end);
  Step CollectPictures();
  Step ShootAtRest(std::vector<std::size_t> pictures);
  Step ShootMissing();
  Step ShootAtRest(std::size_t picture, bool* taken);
  Step StandFor(double seconds);
  SweepEnd JudgePictures();
  Step CheckMotor();
  void StopLidar();
  void PumpTrack();
  void HandOnLines();
  void HandOnPictures(bool all);
  void Report(HeadState state);
  double Now() const { return devices_.clock->Now(); }
  SweepEnd DeviceFailed(const std::string& message) const;

  HeadDevices& devices_;
  const CaptureOptions& options_;
  const ScanPlan plan_;
  const Scan& header_;
  ScanSink& sink_;
  Hooks hooks_;

  const double exposure_s_;
  const double sign_;       ///< of the first pass
  SweepPictures pictures_;  ///< in the order of the sweep
  std::size_t next_picture_ = 0;
  MotorTrack track_;
  LineGate gate_;
  std::optional<std::int64_t> last_seq_;
  double last_line_s_ = 0.0;
  std::optional<double> stopped_since_s_;
  SweepProgress progress_;
  const HeadHealth health_at_start_;
  std::optional<LidarHealth> lidar_health_;  ///< while it still measured
};

}  // namespace foresight
