#pragma once

#include <atomic>
#include <functional>
#include <mutex>

#include "hardware/api/sensor_head.h"

namespace foresight {

/// A head that does what a test tells it, at once and on the caller's thread.
class FakeHead : public SensorHead {
 public:
  explicit FakeHead(SensorRig rig) : rig_(std::move(rig)) { status_.state = HeadState::kReady; }

  std::string Describe() const override { return "fake"; }
  HeadStatus Status() const override { return status_; }
  SensorRig Rig() const override {
    const std::lock_guard lock(rig_mutex_);
    return rig_;
  }
  foresight::Status SetRig(const SensorRig& rig) override {
    FORESIGHT_CHECK(rig.Check());
    if (status_.state != HeadState::kReady && status_.state != HeadState::kDisconnected)
      return Fail(ErrorCode::kState, "fake head: it is {}", ToString(status_.state));
    if (on_rig) on_rig();
    const std::lock_guard lock(rig_mutex_);
    rig_ = rig;
    return {};
  }

  foresight::Status Home() override {
    status_.state = HeadState::kReady;
    return {};
  }
  foresight::Status StartScan(const ScanPlan& plan, std::shared_ptr<ScanSink> sink) override {
    if (status_.state != HeadState::kReady)
      return Fail(ErrorCode::kState, "fake head: it is {}", ToString(status_.state));
    FORESIGHT_CHECK(plan.Check());
    plan_ = plan;
    sink_ = std::move(sink);
    delivered_ = false;
    status_.state = HeadState::kSweeping;
    return {};
  }
  foresight::Status StartStops(const StopPlan& plan, std::shared_ptr<StopSink> sink) override {
    if (status_.state != HeadState::kReady)
      return Fail(ErrorCode::kState, "fake head: it is {}", ToString(status_.state));
    FORESIGHT_CHECK(plan.Check());
    stop_plan = plan;
    stop_sink_ = std::move(sink);
    status_.state = HeadState::kSweeping;
    return {};
  }
  foresight::Status StartLiveView(const LiveViewOptions& options,
                                  std::shared_ptr<LiveViewSink> sink) override {
    FORESIGHT_CHECK(options.Check());
    live_view = std::move(sink);
    return {};
  }
  void StopLiveView() override { live_view.reset(); }
  void EndScan(const std::string& reason) override {
    if (sink_ && delivered_) sink_->OnScanEnded(ScanState::kAborted, reason);
    sink_.reset();
    status_.state = HeadState::kReady;
  }
  void StopMotor() override { stopped_ = true; }
  /// Plays a capture at each stop that was asked for, and the end.
  void DeliverStops(const std::function<StopCapture(double angle_rad)>& capture_at,
                    ScanState end = ScanState::kComplete, const std::string& reason = "") {
    for (const double angle : stop_plan.angles_rad) stop_sink_->OnStop(capture_at(angle));
    stop_sink_->OnStopsEnded(end, reason);
    stop_sink_.reset();
    status_.state = HeadState::kReady;
  }
  bool WaitsForStops() const { return stop_sink_ != nullptr; }
  bool WaitsForScan() const { return sink_ != nullptr; }
  void OperatorSeen() override { ++operator_seen_; }

  /// Plays a finished scan into the sink, up to its `lines`-th line.
  void Deliver(const Scan& scan, std::size_t lines) {
    Begin(scan);
    sink_->OnMotorSamples(scan.track.samples());
    for (std::size_t i = 0; i < lines; ++i) DeliverLine(scan.lines[i]);
    status_.expected_lines = static_cast<int>(scan.lines.size());
  }
  /// The start of a scan that comes piece by piece.
  void Begin(const Scan& scan) {
    Scan header = scan;
    header.lines.clear();
    header.frames.clear();
    header.track = {};
    header.state = ScanState::kRunning;
    sink_->OnScanStarted(header);
    delivered_ = true;
    status_.lines = status_.frames = 0;
  }
  void DeliverLine(const LidarLine& line) {
    sink_->OnLine(line);
    ++status_.lines;
  }
  void DeliverMotor(const MotorSample& sample) { sink_->OnMotorSamples({&sample, 1}); }
  void Finish(const Scan& scan, ScanState state) {
    for (const CameraFrame& frame : scan.frames) sink_->OnFrame(frame);
    sink_->OnScanEnded(state, "");
    sink_.reset();
    status_.state = HeadState::kReady;
  }

  void DeliverFrame(const CameraFrame& frame) {
    sink_->OnFrame(frame);
    ++status_.frames;
  }
  /// Ends the scan; the function that is returned still sends one line of it.
  std::function<void(std::size_t)> FinishButStillSend(const Scan& scan, ScanState state) {
    const auto sink = sink_;
    Finish(scan, state);
    return [sink, scan](std::size_t line) { sink->OnLine(scan.lines[line]); };
  }

  std::shared_ptr<LiveViewSink> live_view;  ///< of whoever looks
  StopPlan stop_plan;                       ///< the last that was accepted

  void SetState(HeadState state) { status_.state = state; }
  void SetFault(const std::string& message) {
    status_.state = HeadState::kFault;
    status_.message = message;
  }
  void SetHealth(const HeadHealth& health) { status_.health = health; }
  const ScanPlan& LastPlan() const { return plan_; }
  bool Stopped() const { return stopped_; }
  int TimesOperatorSeen() const { return operator_seen_; }

  std::function<void()> on_rig;  ///< before another rig is taken

 private:
  mutable std::mutex rig_mutex_;
  SensorRig rig_;  ///< guarded by rig_mutex_: a window gives it from a task
  HeadStatus status_;
  ScanPlan plan_;
  std::shared_ptr<ScanSink> sink_;
  std::shared_ptr<StopSink> stop_sink_;
  bool stopped_ = false;
  int operator_seen_ = 0;
  bool delivered_ = false;  ///< the sink was told that the scan started
};

}  // namespace foresight
