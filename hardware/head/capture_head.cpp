#include "hardware/head/capture_head.h"

#include <chrono>
#include <limits>

#include "core/base/contract.h"
#include "core/base/log.h"
#include "core/base/utc_text.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kIdlePeriod{100};
constexpr std::chrono::milliseconds kLiveViewPeriod{10};
constexpr std::chrono::microseconds kHomingPoll{5000};

}  // namespace

CaptureHead::CaptureHead(HeadDevices devices, SensorRig rig, CaptureOptions options)
    : devices_(std::move(devices)),
      options_(std::move(options)),
      rig_(std::move(rig)),
      operator_seen_s_(std::numeric_limits<double>::infinity()) {
  FORESIGHT_EXPECTS(devices_.lidar && devices_.camera && devices_.motor && devices_.clock,
                    "a head has all of its devices");
  FORESIGHT_EXPECTS(options_.Check().has_value(), options_.Check().error().message);
  FORESIGHT_EXPECTS(rig_.Check().has_value(), rig_.Check().error().message);
  status_.message = "not connected: home the head";
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

CaptureHead::~CaptureHead() {
  thread_.request_stop();
  ++stop_count_;
  StopMotorNow();
  thread_.join();
  StopMotorNow();
}

std::string CaptureHead::Describe() const {
  return options_.description;
}

HeadStatus CaptureHead::Status() const {
  HeadStatus status;
  {
    const std::lock_guard lock(mutex_);
    status = status_;
  }
  status.health = ReadHealth(devices_);
  return status;
}

SensorRig CaptureHead::Rig() const {
  const std::lock_guard lock(mutex_);
  return rig_;
}

Status CaptureHead::SetRig(const SensorRig& rig) {
  FORESIGHT_CHECK(rig.Check());
  const std::lock_guard lock(mutex_);
  if (status_.state != HeadState::kReady && status_.state != HeadState::kDisconnected)
    return Fail(ErrorCode::kState, "{}: cannot take another calibration while {}: end that first",
                options_.description, ToString(status_.state));
  if (rig.lidar.beams != rig_.lidar.beams || rig.camera.width != rig_.camera.width ||
      rig.camera.height != rig_.camera.height)
    return Fail(ErrorCode::kInvalidInput,
                "{}: the calibration is of another head: {} beams and {} x {} px, this head has {} "
                "and {} x {} px",
                options_.description, rig.lidar.beams, rig.camera.width, rig.camera.height,
                rig_.lidar.beams, rig_.camera.width, rig_.camera.height);
  rig_ = rig;
  return {};
}

Status CaptureHead::Home() {
  const std::lock_guard lock(mutex_);
  if (status_.state != HeadState::kDisconnected && status_.state != HeadState::kReady &&
      status_.state != HeadState::kFault)
    return Fail(ErrorCode::kState, "{}: cannot be homed while {}", options_.description,
                ToString(status_.state));
  status_.state = HeadState::kHoming;
  status_.message = "searching the zero reference";
  request_ = HomeRequest{stop_count_};
  wake_.notify_all();
  return {};
}

Status CaptureHead::StartScan(const ScanPlan& plan, std::shared_ptr<ScanSink> sink) {
  FORESIGHT_EXPECTS(sink != nullptr, "a scan needs somewhere to go");
  const std::lock_guard lock(mutex_);
  FORESIGHT_TRY(const ScanPrediction prediction, PredictScan(plan, rig_, Motion()));
  FORESIGHT_CHECK(CheckReady("scan"));
  ScanRequest request{stop_count_, Scan(), std::move(sink)};
  request.header.uuid = NewUuid();
  request.header.start_utc_ns =
      NowUtc_ns() - static_cast<std::int64_t>(devices_.clock->Now() * 1e9);
  request.header.source = options_.description;
  request.header.simulated = options_.simulated;
  request.header.plan = plan;
  request.header.rig = rig_;
  end_reason_.reset();
  status_.state = HeadState::kSweeping;
  status_.commanded_speed_rad_s = plan.speed_rad_s;
  status_.lines = status_.frames = status_.lost_lines = 0;
  status_.expected_lines = prediction.lines;
  status_.message.clear();
  request_ = std::move(request);
  wake_.notify_all();
  return {};
}

Status CaptureHead::StartStops(const StopPlan& plan, std::shared_ptr<StopSink> sink) {
  FORESIGHT_EXPECTS(sink != nullptr, "captures need somewhere to go");
  const std::lock_guard lock(mutex_);
  FORESIGHT_CHECK(plan.Check());
  FORESIGHT_CHECK(CheckReady("capture"));
  end_reason_.reset();
  status_.state = HeadState::kSweeping;
  status_.commanded_speed_rad_s = options_.travel_speed_rad_s;
  status_.lines = status_.frames = status_.lost_lines = 0;
  status_.expected_lines = plan.lines * static_cast<int>(plan.angles_rad.size());
  status_.message.clear();
  request_ = StopsRequest{stop_count_, plan, std::move(sink)};
  wake_.notify_all();
  return {};
}

Status CaptureHead::StartLiveView(const LiveViewOptions& options,
                                  std::shared_ptr<LiveViewSink> sink) {
  FORESIGHT_EXPECTS(sink != nullptr, "images need somewhere to go");
  FORESIGHT_CHECK(options.Check());
  const std::lock_guard lock(mutex_);
  live_view_ = std::make_shared<LiveView>(options, std::move(sink));
  return {};
}

void CaptureHead::StopLiveView() {
  const std::lock_guard lock(mutex_);
  live_view_.reset();
}

/// With the mutex held.
Status CaptureHead::CheckReady(const char* what) const {
  if (status_.state == HeadState::kReady) return {};
  return Fail(ErrorCode::kState, "{}: cannot {} while {}{}", options_.description, what,
              ToString(status_.state),
              status_.state == HeadState::kDisconnected ? ": home it first" : "");
}

void CaptureHead::EndScan(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  end_reason_ = reason;
}

void CaptureHead::StopMotor() {
  // In this order: if the thread starts a move in between, it sees the count afterwards and stops.
  ++stop_count_;
  StopMotorNow();
}

void CaptureHead::OperatorSeen() {
  operator_seen_s_ = devices_.clock->Now();
}

/// Why the motor must not turn any longer, if nobody watches it.
std::optional<std::string> CaptureHead::OperatorLost() const {
  const double away_s = devices_.clock->Now() - operator_seen_s_;
  if (options_.operator_timeout_s == 0.0 || away_s <= options_.operator_timeout_s)
    return std::nullopt;
  return fmt::format("the operator's link was lost for {:.1f} s; the motor was stopped", away_s);
}

void CaptureHead::Work(const std::stop_token& stop) {
  for (;;) {
    Request request;
    {
      std::unique_lock lock(mutex_);
      const auto asked = [this] { return !std::holds_alternative<std::monostate>(request_); };
      wake_.wait_for(lock, stop, live_view_ ? kLiveViewPeriod : kIdlePeriod, asked);
      request = std::exchange(request_, std::monostate());
    }
    try {
      // A request that was accepted is answered even now: somebody waits for the scan's end.
      if (auto* home = std::get_if<HomeRequest>(&request)) {
        RunHoming(*home, stop);
      } else if (auto* scan = std::get_if<ScanRequest>(&request)) {
        RunScan(*scan, stop);
      } else if (auto* stops = std::get_if<StopsRequest>(&request)) {
        RunStops(*stops, stop);
      } else if (stop.stop_requested()) {
        return;
      } else {
        LookAtMotor();
      }
      LookAtLiveView(!std::holds_alternative<std::monostate>(request));
    } catch (const std::exception& error) {
      EnterFault(error.what());
    }
  }
}

void CaptureHead::RunHoming(const HomeRequest& request, const std::stop_token& stop) {
  const foresight::Status homed = ConnectAndHome(request, stop);
  if (homed) {
    // What the encoder said until now counted from another zero.
    devices_.motor->TakeTrack();
    encoder_.Forget();
    Update([](HeadStatus& status) {
      status.state = HeadState::kReady;
      status.message.clear();
    });
    LookAtMotor();
  } else if (homed.error().code == ErrorCode::kCancelled) {
    StopMotorNow();
    Update([&](HeadStatus& status) {
      status.state = HeadState::kDisconnected;
      status.message = homed.error().message;
    });
  } else {
    EnterFault(homed.error().message);
  }
}

Status CaptureHead::ConnectAndHome(const HomeRequest& request, const std::stop_token& stop) {
  const auto stopped = [&] { return stop.stop_requested() || stop_count_ != request.stops_before; };
  FORESIGHT_CHECK(devices_.motor->Connect());
  FORESIGHT_CHECK(devices_.lidar->Connect());
  FORESIGHT_CHECK(devices_.camera->Connect());
  if (!stopped() && !OperatorLost()) FORESIGHT_CHECK(devices_.motor->StartHoming());
  const double deadline_s = devices_.clock->Now() + options_.homing_timeout_s;
  for (;;) {
    if (stopped())
      return Fail(ErrorCode::kCancelled, "homing was stopped: home again before scanning");
    if (const auto lost = OperatorLost())
      return Fail(ErrorCode::kCancelled, "{}; home again before scanning", *lost);
    FORESIGHT_TRY(const bool moving, devices_.motor->Moving());
    if (!moving) break;
    if (devices_.clock->Now() > deadline_s)
      return Fail(ErrorCode::kDevice, "{}: found no zero reference within {:.0f} s",
                  devices_.motor->Describe(), options_.homing_timeout_s);
    devices_.clock->Sleep(kHomingPoll);
    Update([this](HeadStatus& status) { status.time_s = devices_.clock->Now(); });
  }
  if (!devices_.motor->Homed())
    return Fail(ErrorCode::kDevice, "{}: came to rest without finding its zero reference",
                devices_.motor->Describe());
  return {};
}

std::optional<SweepEnd> CaptureHead::Interruption(int stops_before,
                                                  const std::stop_token& stop) const {
  if (stop.stop_requested())
    return SweepEnd{ScanState::kInterrupted, "the head was switched off", false, true};
  if (stop_count_ != stops_before)
    return SweepEnd{ScanState::kAborted, "the operator stopped the motor", false, false};
  {
    const std::lock_guard lock(mutex_);
    if (end_reason_) return SweepEnd{ScanState::kAborted, *end_reason_, false, false};
  }
  if (const auto lost = OperatorLost())
    return SweepEnd{ScanState::kInterrupted, *lost + "; the scan ends there", false, false};
  return std::nullopt;
}

CaptureSweep::Hooks CaptureHead::HooksOf(int stops_before, const std::stop_token& stop) {
  CaptureSweep::Hooks hooks;
  hooks.interruption = [this, stops_before, stop] { return Interruption(stops_before, stop); };
  hooks.report = [this](const SweepProgress& progress) {
    Update([&](HeadStatus& status) {
      status.state = progress.state;
      status.time_s = devices_.clock->Now();
      status.angle_rad = progress.position.angle_rad;
      status.speed_rad_s = progress.speed_rad_s;
      status.lines = progress.lines;
      status.frames = progress.frames;
      status.lost_lines = progress.lost_lines;
    });
  };
  return hooks;
}

void CaptureHead::RunScan(ScanRequest& request, const std::stop_token& stop) {
  std::optional<CaptureSweep> sweep;
  try {
    sweep.emplace(devices_, options_, request.header, encoder_, *request.sink,
                  HooksOf(request.stops_before, stop));
  } catch (const std::exception& error) {
    Request unbegun = request;
    EndUnbegun(unbegun, error.what());
    throw;
  }
  const SweepEnd end = sweep->Run();
  request.sink.reset();
  ShowEnd(end);
}

void CaptureHead::RunStops(StopsRequest& request, const std::stop_token& stop) {
  const SweepEnd end = CaptureStops(devices_, options_, request.plan, encoder_, *request.sink,
                                    HooksOf(request.stops_before, stop))
                           .Run();
  request.sink.reset();
  ShowEnd(end);
}

void CaptureHead::ShowEnd(const SweepEnd& end) {
  if (end.fault) return EnterFault(end.reason);
  Update([&](HeadStatus& status) {
    status.state = HeadState::kReady;
    status.speed_rad_s = 0.0;
    status.commanded_speed_rad_s = 0.0;
    status.message = end.reason;
  });
}

/// Between the scans: shows the operator where the motor is, and notices when it is lost.
void CaptureHead::LookAtMotor() {
  if (Status().state != HeadState::kReady) return;
  const Result<MotorSample> position = devices_.motor->Position();
  if (!position) return EnterFault(position.error().message);
  // Nobody needs the track, and it must not pile up. The plate may be turned by hand.
  encoder_.ExpectAnyMotion(ScanPlan::kMaxSpeed_rad_s);
  for (const MotorSample& sample : devices_.motor->TakeTrack())
    if (const auto impossible = encoder_.Check(sample))
      return EnterFault(fmt::format("{}: {}", devices_.motor->Describe(), *impossible));
  Update([&](HeadStatus& status) {
    status.time_s = devices_.clock->Now();
    status.angle_rad = position->angle_rad;
  });
}

void CaptureHead::LookAtLiveView(bool camera_was_used) {
  std::shared_ptr<LiveView> view;
  double angle_rad = 0.0;
  {
    const std::lock_guard lock(mutex_);
    view = live_view_;
    if (!view || status_.state != HeadState::kReady) return;
    angle_rad = status_.angle_rad;
  }
  if (camera_was_used) view->Forget();
  view->Look(*devices_.camera, *devices_.clock, angle_rad);
}

/// Tells the sink of what was accepted and never began.
void CaptureHead::EndUnbegun(Request& request, const std::string& reason) {
  try {
    if (auto* scan = std::get_if<ScanRequest>(&request)) {
      scan->sink->OnScanStarted(scan->header);
      scan->sink->OnScanEnded(ScanState::kInterrupted, reason);
    } else if (auto* stops = std::get_if<StopsRequest>(&request)) {
      stops->sink->OnStopsEnded(ScanState::kInterrupted, reason);
    }
  } catch (const std::exception& error) {
    LogError("{}: {}", options_.description, error.what());
  }
}

void CaptureHead::EnterFault(const std::string& what) {
  StopMotorNow();
  LogError("{}: {}", options_.description, what);
  Request unbegun;
  {
    const std::lock_guard lock(mutex_);
    // Homing that the operator asked for meanwhile is what leads out of the fault.
    if (std::holds_alternative<HomeRequest>(request_)) return;
    // A scan that was accepted meanwhile must not turn a motor that has just failed.
    unbegun = std::exchange(request_, std::monostate());
    status_.state = HeadState::kFault;
    status_.speed_rad_s = 0.0;
    status_.commanded_speed_rad_s = 0.0;
    // Told to, not known to: where the motor's own link is lost, the drive's watchdog must do it.
    status_.message = what +
                      "; the motor was told to stop. See that it stands, check the device's power "
                      "and cable, then home the head";
  }
  EndUnbegun(unbegun, what);
}

void CaptureHead::StopMotorNow() noexcept {
  try {
    devices_.motor->QuickStop();
  } catch (const std::exception& error) {
    LogError("{}: {}", options_.description, error.what());
  }
}

void CaptureHead::Update(const std::function<void(HeadStatus&)>& change) {
  const std::lock_guard lock(mutex_);
  change(status_);
}

}  // namespace foresight
