#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "hardware/api/sensor_head.h"
#include "hardware/head/capture_options.h"
#include "hardware/head/capture_stops.h"
#include "hardware/head/capture_sweep.h"
#include "hardware/head/encoder_watch.h"
#include "hardware/head/head_devices.h"
#include "hardware/head/live_view.h"

namespace foresight {

/// A head on devices of this process. One thread owns the devices and the state machine
/// Disconnected -> Homing -> Ready -> Sweeping -> Stopping -> Ready, and Fault from everywhere;
/// only Motor::QuickStop is also called from the threads of the callers. Every error and the
/// destructor stop the motor. A scan's clock is the head's clock.
class CaptureHead final : public SensorHead {
 public:
  /// `rig` is the calibration in force. Throws ContractViolation when a device is missing or the
  /// options or the rig do not pass their Check().
  CaptureHead(HeadDevices devices, SensorRig rig, CaptureOptions options);
  /// Stops the motor, ends a running scan as interrupted, and waits for the thread.
  ~CaptureHead() override;

  std::string Describe() const override;
  HeadStatus Status() const override;
  SensorRig Rig() const override;
  foresight::Status SetRig(const SensorRig& rig) override;
  HeadMotion Motion() const override { return options_.Motion(); }
  foresight::Status Home() override;
  foresight::Status StartScan(const ScanPlan& plan, std::shared_ptr<ScanSink> sink) override;
  foresight::Status StartStops(const StopPlan& plan, std::shared_ptr<StopSink> sink) override;
  foresight::Status StartLiveView(const LiveViewOptions& options,
                                  std::shared_ptr<LiveViewSink> sink) override;
  void StopLiveView() override;
  void EndScan(const std::string& reason) override;
  void StopMotor() override;
  void OperatorSeen() override;

 private:
  struct HomeRequest {
    int stops_before;  ///< stop_count_ when it was asked for: a later stop ends it
  };
  struct ScanRequest {
    int stops_before;
    Scan header;
    std::shared_ptr<ScanSink> sink;
  };
  struct StopsRequest {
    int stops_before;
    StopPlan plan;
    std::shared_ptr<StopSink> sink;
  };
  using Request = std::variant<std::monostate, HomeRequest, ScanRequest, StopsRequest>;

  void Work(const std::stop_token& stop);
  void RunHoming(const HomeRequest& request, const std::stop_token& stop);
  foresight::Status ConnectAndHome(const HomeRequest& request, const std::stop_token& stop);
  void RunScan(ScanRequest& request, const std::stop_token& stop);
  void RunStops(StopsRequest& request, const std::stop_token& stop);
  foresight::Status CheckReady(const char* what) const;
  CaptureSweep::Hooks HooksOf(int stops_before, const std::stop_token& stop);
  void ShowEnd(const SweepEnd& end);
  std::optional<SweepEnd> Interruption(int stops_before, const std::stop_token& stop) const;
  std::optional<std::string> OperatorLost() const;
  void LookAtMotor();
  void LookAtLiveView(bool camera_was_used);
  void EnterFault(const std::string& what);
  void EndUnbegun(Request& request, const std::string& reason);
  void StopMotorNow() noexcept;
  void Update(const std::function<void(HeadStatus&)>& change);

  HeadDevices devices_;
  const CaptureOptions options_;

  mutable std::mutex mutex_;  ///< guards rig_, status_, request_, live_view_ and end_reason_
  SensorRig rig_;
  HeadStatus status_;
  Request request_;
  std::shared_ptr<LiveView> live_view_;  ///< null = nobody looks
  std::condition_variable_any wake_;
  std::atomic<int> stop_count_{0};
  std::optional<std::string> end_reason_;  ///< why the running scan is to end
  std::atomic<double> operator_seen_s_;    ///< infinite until the first time
  EncoderWatch encoder_;                   ///< of the thread alone
  std::jthread thread_;                    ///< last: starts when everything else is there
};

}  // namespace foresight
