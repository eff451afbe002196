#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>

#include "core/mission/plan_json.h"
#include "hardware/api/sensor_head.h"
#include "tests/core/mission/sample_scan.h"

namespace foresight {

/// A head that does at once what it is told and counts it. A scan's lines come from the test.
class FakeHead final : public SensorHead {
 public:
  std::string Describe() const override { return "fake head"; }
  HeadStatus Status() const override {
    const std::lock_guard lock(mutex_);
    return status_;
  }
  SensorRig Rig() const override {
    const std::lock_guard lock(mutex_);
    return rig_;
  }
  foresight::Status SetRig(const SensorRig& rig) override {
    const std::lock_guard lock(mutex_);
    rig_ = rig;
    return {};
  }
  foresight::Status Home() override {
    if (may_home.valid()) may_home.wait();
    if (on_home) on_home();
    ++homings;
    SetState(HeadState::kReady);
    return {};
  }
  foresight::Status StartScan(const ScanPlan& plan, std::shared_ptr<ScanSink> sink) override {
    if (Status().state != HeadState::kReady)
      return Fail(ErrorCode::kState, "fake head: cannot scan while {}", ToString(Status().state));
    ++scans;
    SetState(HeadState::kSweeping);
    const std::lock_guard lock(mutex_);
    plan_ = plan;
    sink_ = std::move(sink);
    return {};
  }
  foresight::Status StartStops(const StopPlan&, std::shared_ptr<StopSink> sink) override {
    const std::lock_guard lock(mutex_);
    stop_sink_ = std::move(sink);
    return {};
  }
  foresight::Status StartLiveView(const LiveViewOptions&,
                                  std::shared_ptr<LiveViewSink> sink) override {
    const std::lock_guard lock(mutex_);
    live_sink_ = std::move(sink);
    return {};
  }
  void StopLiveView() override {
    const std::lock_guard lock(mutex_);
    live_sink_.reset();
  }
  void EndScan(const std::string& reason) override {
    const std::lock_guard lock(mutex_);
    end_reason_ = reason;
  }
  void StopMotor() override { ++stops; }
  void OperatorSeen() override { ++signs; }

  void SetState(HeadState state) {
    const std::lock_guard lock(mutex_);
    status_.state = state;
    ++status_.frames;  // something that changes
  }
  void SetMessage(const std::string& message) {
    const std::lock_guard lock(mutex_);
    status_.message = message;
  }
  std::shared_ptr<ScanSink> Sink() const {
    const std::lock_guard lock(mutex_);
    return sink_;
  }
  std::shared_ptr<StopSink> Stops() const {
    const std::lock_guard lock(mutex_);
    return stop_sink_;
  }
  std::shared_ptr<LiveViewSink> LiveSink() const {
    const std::lock_guard lock(mutex_);
    return live_sink_;
  }
  /// As when its program dies.
  void Forget() {
    const std::lock_guard lock(mutex_);
    sink_.reset();
    stop_sink_.reset();
    live_sink_.reset();
  }
  std::string EndReason() const {
    const std::lock_guard lock(mutex_);
    return end_reason_;
  }
  /// Sends a whole scan to the sink of the running one.
  void Play(const Scan& scan) {
    const auto sink = Sink();
    Scan header = scan;
    header.lines.clear();
    header.frames.clear();
    header.track = {};
    header.state = ScanState::kRunning;
    sink->OnScanStarted(header);
    sink->OnMotorSamples(scan.track.samples());
    for (const LidarLine& line : scan.lines) sink->OnLine(line);
    for (const CameraFrame& frame : scan.frames) sink->OnFrame(frame);
    sink->OnScanEnded(scan.state, scan.reason);
    SetState(HeadState::kReady);
  }

  std::shared_future<void> may_home;  ///< where it is given, Home() waits for it
  std::function<void()> on_home;      ///< called in Home()
  std::atomic<int> homings{0};
  std::atomic<int> scans{0};
  std::atomic<int> stops{0};
  std::atomic<int> signs{0};

 private:
  mutable std::mutex mutex_;
  HeadStatus status_;
  SensorRig rig_ = DefaultSensorRig();
  ScanPlan plan_;
  std::string end_reason_;
  std::shared_ptr<ScanSink> sink_;
  std::shared_ptr<StopSink> stop_sink_;
  std::shared_ptr<LiveViewSink> live_sink_;
};

}  // namespace foresight
