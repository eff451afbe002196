#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <thread>
#include <vector>

#include "core/geometry/angles.h"
#include "hardware/head/capture_head.h"
#include "hardware/head/scan_assembler.h"
#include "hardware/head/scan_fanout.h"
#include "hardware/simulated/simulated_camera.h"
#include "hardware/simulated/simulated_lidar.h"
#include "hardware/simulated/simulated_motor.h"

namespace foresight {

/// A coarse head before a wall: a sweep of a second is simulated in a few milliseconds.
inline SensorRig TinyRig() {
  SensorRig rig = DefaultSensorRig();
  rig.camera = PinholeCamera(32, 24, 20.0, 15.5, 11.5);
  rig.lidar.beams = 61;
  rig.lidar.first_angle_rad = RadiansFromDegrees(-30.0);
  rig.lidar.angle_step_rad = RadiansFromDegrees(1.0);
  return rig;
}

inline std::shared_ptr<const World> TinyWorld() {
  auto scene = std::make_shared<Scene>();
  scene->name = "wall";
  SceneMesh wall;
  wall.vertices = {{2, -5, -5}, {2, 5, -5}, {2, 5, 5}, {2, -5, 5}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene->meshes = {wall};
  scene->lights = {Light()};
  return std::make_shared<const World>(scene, TinyRig(), WorldOptions());
}

/// 1 s, 40 lines, one image.
inline ScanPlan TinyPlan() {
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(-5.0);
  plan.to_rad = RadiansFromDegrees(5.0);
  plan.speed_rad_s = RadiansFromDegrees(10.0);
  return plan;
}

/// Counts the emergency stops of a motor and lets it fail on request.
class ObservedMotor final : public Motor {
 public:
  explicit ObservedMotor(std::unique_ptr<Motor> motor) : motor_(std::move(motor)) {}

  std::string Describe() const override { return "test motor"; }
  Status Connect() override { return motor_->Connect(); }
  Status StartHoming() override { return motor_->StartHoming(); }
  bool Homed() const override { return motor_->Homed(); }
  Status StartMove(double angle_rad, double speed_rad_s) override {
    return motor_->StartMove(angle_rad, speed_rad_s);
  }
  Result<bool> Moving() override { return motor_->Moving(); }
  Result<MotorSample> Position() override {
    if (failing) return Fail(ErrorCode::kDevice, "test motor: following error 8611h");
    return motor_->Position();
  }
  std::vector<MotorSample> TakeTrack() override {
    std::vector<MotorSample> samples = motor_->TakeTrack();
    if (keep) std::erase_if(samples, [this](const MotorSample& sample) { return !keep(sample); });
    return samples;
  }
  void QuickStop() override {
    ++quick_stops;
    motor_->QuickStop();
  }
  MotorHealth Health() const override { return motor_->Health(); }

  std::atomic<int> quick_stops{0};
  std::atomic<bool> failing{false};
  std::function<bool(const MotorSample&)> keep;  ///< of the track; set before the scan

 private:
  std::unique_ptr<Motor> motor_;
};

/// A lidar whose answers a test may change.
class TamperedLidar final : public Lidar {
 public:
  using Answer = Result<std::optional<LidarLine>>;
  explicit TamperedLidar(std::unique_ptr<Lidar> lidar) : lidar_(std::move(lidar)) {}

  std::string Describe() const override { return "test lidar"; }
  Status Connect() override { return lidar_->Connect(); }
  Status Start() override { return lidar_->Start(); }
  void Stop() override { lidar_->Stop(); }
  Answer WaitForLine(std::chrono::milliseconds timeout) override {
    Answer answer = lidar_->WaitForLine(timeout);
    return tamper ? tamper(std::move(answer)) : answer;
  }
  LidarHealth Health() const override { return lidar_->Health(); }

  std::function<Answer(Answer)> tamper;  ///< set before the scan

 private:
  std::unique_ptr<Lidar> lidar_;
};

/// A camera that takes triggers and never delivers.
class SilentCamera final : public Camera {
 public:
  explicit SilentCamera(std::shared_ptr<SensorClock> clock) : clock_(std::move(clock)) {}
  std::string Describe() const override { return "test camera"; }
  Status Connect() override { return {}; }
  Status Configure(const CameraSettings&) override { return {}; }
  Result<std::int64_t> Trigger() override { return triggers_++; }
  Result<std::optional<CameraFrame>> WaitForFrame(std::chrono::milliseconds timeout) override {
    clock_->Sleep(timeout);
    return std::nullopt;
  }
  CameraHealth Health() const override {
    CameraHealth health;
    health.connected = true;
    return health;
  }

 private:
  std::int64_t triggers_ = 0;
  std::shared_ptr<SensorClock> clock_;
};

/// Tells when a scan has ended, and runs a test's action at a line.
class ScanWatch final : public ScanSink {
 public:
  void OnScanStarted(const Scan&) override {}
  void OnLine(const LidarLine&) override {
    if (++lines_ == action_line && action) action();
  }
  void OnMotorSamples(std::span<const MotorSample>) override {}
  void OnFrame(const CameraFrame&) override {}
  void OnScanEnded(ScanState, const std::string&) override { ended_.set_value(); }

  bool WaitForEnd() {
    return ended_.get_future().wait_for(std::chrono::seconds(30)) == std::future_status::ready;
  }

  int action_line = 10;
  std::function<void()> action;

 private:
  int lines_ = 0;
  std::promise<void> ended_;
};

/// A head on simulated devices, as fast as the machine allows, with its parts in reach of the test.
struct TinyHead {
  TinyHead() : TinyHead([](HeadDevices&) {}) {}
  explicit TinyHead(const std::function<void(HeadDevices&)>& change, CaptureOptions options = {}) {
    const auto world = TinyWorld();
    HeadDevices devices;
    auto wrapped_lidar =
        std::make_unique<TamperedLidar>(std::make_unique<SimulatedLidar>(world, clock, shaft));
    auto wrapped_motor =
        std::make_unique<ObservedMotor>(std::make_unique<SimulatedMotor>(world, clock, shaft));
    lidar = wrapped_lidar.get();
    motor = wrapped_motor.get();
    devices.lidar = std::move(wrapped_lidar);
    devices.motor = std::move(wrapped_motor);
    devices.camera = std::make_unique<SimulatedCamera>(world, clock, shaft);
    devices.clock = clock;
    change(devices);
    options.description = "tiny head";
    options.simulated = true;
    head = std::make_unique<CaptureHead>(std::move(devices), TinyRig(), options);
  }

  bool WaitFor(HeadState state) const {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (head->Status().state != state) {
      if (std::chrono::steady_clock::now() > deadline) return false;
      std::this_thread::yield();
    }
    return true;
  }
  bool Home() const { return head->Home() && WaitFor(HeadState::kReady); }
  bool AtRest() const { return !shaft->MovingAt(clock->Now()); }

  /// Runs a scan to its end; nullptr when it never ends.
  std::shared_ptr<const Scan> Run(const ScanPlan& plan) {
    if (!head->StartScan(plan, sinks) || !watch->WaitForEnd()) return nullptr;
    return assembler->Snapshot();
  }

  std::shared_ptr<SimulatedClock> clock =
      std::make_shared<SimulatedClock>(SimulationSpeed::kAsFastAsPossible);
  std::shared_ptr<SimulatedShaft> shaft =
      std::make_shared<SimulatedShaft>(SimulatedMotor::kPowerOnAngle_rad);
  TamperedLidar* lidar = nullptr;
  ObservedMotor* motor = nullptr;
  std::shared_ptr<ScanAssembler> assembler = std::make_shared<ScanAssembler>();
  std::shared_ptr<ScanWatch> watch = std::make_shared<ScanWatch>();
  std::shared_ptr<ScanFanout> sinks =
      std::make_shared<ScanFanout>(std::vector<std::shared_ptr<ScanSink>>{assembler, watch});
  std::unique_ptr<CaptureHead> head;
};

}  // namespace foresight
