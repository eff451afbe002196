#include "tests/display/running_window.h"

#include <gtest/gtest.h>

#include <QPushButton>

#include "app/common/simulated_stand.h"
#include "tests/display/mouse.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

constexpr int kScanLimit_ms = 180'000;  // the simulated camera and the depth take seconds each

std::shared_ptr<const World> RoomWithTheValve(const SensorRig& rig) {
  Scene scene = LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml").value();
  return std::make_shared<const World>(std::make_shared<const Scene>(std::move(scene)), rig,
                                       WorldOptions());
}

SimulatedHeadOptions AsFastAsPossible(const SensorRig& rig) {
  SimulatedHeadOptions options;
  options.speed = SimulationSpeed::kAsFastAsPossible;
  options.true_rig = options.believed_rig = rig;
  return options;
}

}  // namespace

RunningWindow::RunningWindow(const SensorRig& rig)
    : RunningWindow(RoomWithTheValve(rig), AsFastAsPossible(rig)) {}

RunningWindow::RunningWindow(std::shared_ptr<const World> world,
                             const SimulatedHeadOptions& options)
    : world_(std::move(world)) {
  std::shared_ptr<SensorHead> head = MakeSimulatedHead(world_, options).value();
  bench_ = std::make_unique<Workbench>(std::move(head), SessionMode::kSimulation, StandIn(world_));
  EXPECT_TRUE(bench_->recording.BeginInFolder(missions_.path()));
  window_ = std::make_unique<MainWindow>(bench_.get());
  window_->show();
  bench_->head.home();
  Settle();  // the first drawing of everything, which takes a second, is no stall of a mission
  stalls_.TakeWorst();
}

RunningWindow::~RunningWindow() = default;

bool RunningWindow::ScanWithTheMouse() {
  auto* button = window_->findChild<QPushButton*>(QStringLiteral("scanButton"));
  if (!WaitFor([&] { return button->isEnabled(); }, kScanLimit_ms)) return false;
  Click(button);
  const bool computed =
      WaitFor([&] { return bench_->live.session.Depth() && bench_->Idle(); }, kScanLimit_ms);
  Settle();
  scan_stall_ = stalls_.TakeWorst();
  return computed;
}

Eigen::Vector3d RunningWindow::ValveInRobot() const {
  return world_->scene().valves.at(0).robot_from_object.translation();
}

std::pair<Eigen::Vector2d, Eigen::Vector2d> RunningWindow::AroundValve() {
  const Scan& scan = *bench_->live.session.CurrentScan();
  const auto camera_from_robot =
      scan.rig.CameraFromBase(bench_->live.session.CurrentImage()->motor_angle_rad) *
      scan.rig.robot_from_base.Inverse();
  const Eigen::Vector3d center = camera_from_robot * ValveInRobot();
  const double radius_m = 1.35 * world_->scene().valves.at(0).model.rim_radius_m;
  return {*scan.rig.camera.Project(center - Eigen::Vector3d(radius_m, radius_m, 0.0)),
          *scan.rig.camera.Project(center + Eigen::Vector3d(radius_m, radius_m, 0.0))};
}

void RunningWindow::Settle() {
  QElapsedTimer timer;
  timer.start();
  WaitFor([&] { return timer.elapsed() > 500; });
}

}  // namespace foresight
