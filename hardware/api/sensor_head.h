#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/sensor/scan.h"
#include "hardware/api/head_health.h"
#include "hardware/api/live_view.h"
#include "hardware/api/stop_capture.h"

namespace foresight {

class HeadLink;

enum class HeadState { kDisconnected, kHoming, kReady, kSweeping, kStopping, kFault };
/// "disconnected", "homing", "ready", "sweeping", "stopping", "fault".
const char* ToString(HeadState state);

/// What the head says of itself.
struct HeadStatus {
  HeadState state = HeadState::kDisconnected;
  double time_s = 0.0;       ///< head's clock
  double angle_rad = 0.0;    ///< reported by the motor
  double speed_rad_s = 0.0;  ///< reported
  double commanded_speed_rad_s = 0.0;
  int lines = 0;  ///< of the running or last scan
  int expected_lines = 0;
  int frames = 0;
  int lost_lines = 0;
  std::string message;  ///< what happened and what to do, one sentence; empty when all is well
  HeadHealth health;    ///< of the devices, now
};

/// How a scan arrives, piece by piece. Called from a thread of the head, in order, never
/// concurrently; return quickly.
class ScanSink {
 public:
  virtual ~ScanSink() = default;
  /// Everything but lines, track and frames is filled in.
  virtual void OnScanStarted(const Scan& header) = 0;
  virtual void OnLine(const LidarLine& line) = 0;
  virtual void OnMotorSamples(std::span<const MotorSample> samples) = 0;
  virtual void OnFrame(const CameraFrame& frame) = 0;
  /// Why nothing more of the running scan can be kept, e.g. a full disk; nullopt while all is well.
  /// The head asks several times a line and ends the scan as interrupted for it: a sweep that
  /// nobody records is of no use.
  virtual std::optional<std::string> Failure() const { return std::nullopt; }
  /// Once, before the end: how the devices did when the scan started and when it ended.
  virtual void OnDeviceHealth(const HeadHealth& /*at_start*/, const HeadHealth& /*at_end*/) {}
  virtual void OnScanEnded(ScanState state, const std::string& reason) = 0;
  /// Waits until everything that was heard is where it is to stay, e.g. on the disk; fails where it
  /// cannot be kept. A link holds its own copy of a scan, and lets the head delete the scan, only
  /// after that.
  virtual foresight::Status WaitUntilKept() { return {}; }
};

/// A head as the operator's side sees it: in this process, or at the far end of a link. All calls
/// are safe from any thread and return at once; what they cause shows in Status() and in the sink.
class SensorHead {
 public:
  virtual ~SensorHead() = default;

  virtual std::string Describe() const = 0;
  virtual HeadStatus Status() const = 0;
  /// The calibration in force on the head; a running scan has the one of its start.
  virtual SensorRig Rig() const = 0;
  /// Puts another calibration in force, from the next scan on. Fails with kState unless ready or
  /// disconnected, as SensorRig::Check() where the rig is unusable, and with kInvalidInput where it
  /// is of a head with another number of beams or pixels; the old one stays then.
  virtual foresight::Status SetRig(const SensorRig& rig) = 0;
  /// The connection to it, which it owns; nullptr where the head is in this process.
  virtual HeadLink* Link() { return nullptr; }
  /// How it moves, for PredictScan.
  virtual HeadMotion Motion() const { return {}; }

  /// Connects to the devices and searches the zero reference. Fails with kState while sweeping.
  virtual foresight::Status Home() = 0;
  /// Fails with kState unless ready, kInvalidOptions for a bad plan. Once it is accepted, the sink
  /// hears OnScanStarted and OnScanEnded whatever happens. `sink` lives until OnScanEnded.
  virtual foresight::Status StartScan(const ScanPlan& plan, std::shared_ptr<ScanSink> sink) = 0;
  /// Goes to each of the plan's angles and captures while it stands. Fails as StartScan does. Once
  /// it is accepted, the sink hears OnStopsEnded whatever happens, and lives until then. It is
  /// ended by EndScan, StopMotor and a lost operator, as a scan is.
  virtual foresight::Status StartStops(const StopPlan& plan, std::shared_ptr<StopSink> sink) = 0;
  /// Shows what the camera sees while the head is ready; during a scan, captures or homing the view
  /// pauses. Replaces a running view. Fails with kInvalidOptions.
  virtual foresight::Status StartLiveView(const LiveViewOptions& options,
                                          std::shared_ptr<LiveViewSink> sink) = 0;
  /// The sink may hear one last image meanwhile.
  virtual void StopLiveView() = 0;
  /// Ends the running scan as aborted for `reason` and keeps what it has; the motor stops.
  virtual void EndScan(const std::string& reason) = 0;
  void AbortScan() { EndScan("the operator ended the scan"); }
  /// Stops the motor at once, in every state.
  virtual void StopMotor() = 0;
  /// Somebody is there and could act. From the first call on a head expects it again and again, and
  /// stops what turns when it stays out; what it stopped does not start again by itself.
  virtual void OperatorSeen() = 0;
};

}  // namespace foresight
