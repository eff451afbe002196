// From the drawn rig to one as good as the true one, by clicks: all places of the stand are
// captured, the session is solved, the rig saved and put in force; then the valve of the same room
// is scanned, and depth and pose are compared with what the true rig makes of the same scans.
#include <gtest/gtest.h>

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QPushButton>
#include <cmath>

#include "core/base/quantile.h"
#include "core/calibration/compare_rigs.h"
#include "core/detection/fit_in_scan.h"
#include "core/evaluation/calibration_scene.h"
#include "core/geometry/angles.h"
#include "core/registration/register_scan.h"
#include "core/sensor/rig_id.h"
#include "hardware/simulated/simulated_head.h"
#include "tests/display/mouse.h"
#include "tests/display/running_window.h"
#include "tests/support/shrink_camera.h"
#include "tests/ui/wait_for.h"
#include "ui/panels/chain_calibration_panel.h"
#include "ui/viewmodels/camera_calibration_model.h"

namespace foresight {
namespace {

constexpr int kLimit_ms = 400'000;  // a full session on a machine that is busy

/// Squared errors of some scans.
struct Errors {
  double depth_m2 = 0.0;
  double position_m2 = 0.0;
  double axis_rad2 = 0.0;
  int scans = 0;

  double Depth_mm() const { return 1e3 * std::sqrt(depth_m2 / scans); }
  double Position_mm() const { return 1e3 * std::sqrt(position_m2 / scans); }
  double Axis_deg() const { return DegreesFromRadians(std::sqrt(axis_rad2 / scans)); }
};

struct CalibrationEndToEnd : testing::Test {
  QTemporaryDir folder;
  bool kept_in_folder = qputenv("XDG_DATA_HOME", folder.path().toUtf8());
  std::shared_ptr<const World> world;
  SensorRig true_rig;  ///< as well calibrated as can be
  std::unique_ptr<RunningWindow> running;
  ChainCalibrationPanel* panel = nullptr;
  Errors with_true, with_found;

  ~CalibrationEndToEnd() override { qunsetenv("XDG_DATA_HOME"); }

  ChainCalibrationModel& Model() { return running->bench().head_calibration; }

  /// The shipped room with the valve and the boards of a simulated session; the head believes the
  /// drawing.
  void Open(const CalibrationSimulation& options, double image_scale) {
    auto made = SimulateCalibration(options);
    ASSERT_TRUE(made) << made.error().message;
    MarkBoards(&made->session.mount);
    const auto boards = SceneFromYaml(CalibrationSceneYaml(*made), "boards");
    ASSERT_TRUE(boards) << boards.error().message;
    Scene scene = LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml").value();
    scene.stands = boards->stands;
    scene.places = boards->places;
    SensorRig prior = made->session.prior;
    true_rig = made->truth;
    for (SensorRig* rig : {&true_rig, &prior}) Shrink(image_scale, &rig->camera);
    WorldOptions world_options;
    world_options.seed = options.seed;
    world = std::make_shared<const World>(std::make_shared<const Scene>(std::move(scene)), true_rig,
                                          world_options);
    true_rig.angle_correction = world->CalibratedCorrection();
    SimulatedHeadOptions head;
    head.believed_rig = prior;
    head.speed = SimulationSpeed::kAsFastAsPossible;
    running.reset();
    running = std::make_unique<RunningWindow>(world, head);
    panel = running->window().HeadCalibration();
    StandPlan plan = Model().Recorder()->Plan();
    plan.first_deg = options.first_stop_deg;
    plan.last_deg = options.last_stop_deg;
    plan.step_deg = options.stop_step_deg;
    plan.lines = options.scans_per_stop;
    Model().Recorder()->SetPlan(plan);
  }

  bool ClickOn(const char* name) {
    auto* button = panel->findChild<QAbstractButton*>(QString::fromLatin1(name));
    const bool possible =
        WaitFor([&] { return button->isVisible() && button->isEnabled() && !Model().Reading(); },
                kLimit_ms);
    if (possible)
      Click(button);
    else
      ADD_FAILURE() << name << ": " << button->toolTip().toStdString();
    return possible;
  }

  void CalibrateByClicks() {
    ASSERT_TRUE(running->bench().commands.Run("view.calibrate_head"));
    running->Settle();
    ASSERT_TRUE(ClickOn("step2"));
    ASSERT_TRUE(ClickOn("captureAll"));
    ASSERT_TRUE(WaitFor([&] { return Model().Tour()->Running(); }));
    ASSERT_TRUE(WaitFor([&] { return !Model().Tour()->Running(); }, kLimit_ms));
    for (const LogEntry& entry : running->bench().log.Entries())
      EXPECT_EQ(entry.notice.level, Notice::Level::kInfo)
          << entry.notice.what.toStdString() << ' ' << entry.notice.next.toStdString();
    ASSERT_TRUE(ClickOn("step3"));
    ASSERT_TRUE(ClickOn("solveHead"));
    ASSERT_TRUE(WaitFor([&] { return Model().SolutionIsCurrent(); }, kLimit_ms))
        << Model().StateText().toStdString();
    ASSERT_TRUE(ClickOn("step4"));
    ASSERT_TRUE(ClickOn("saveRig"));
    QFileDialog* dialog = nullptr;
    ASSERT_TRUE(WaitFor([&] {
      dialog = panel->findChild<QFileDialog*>(QStringLiteral("file_dialog"));
      return dialog != nullptr && dialog->isVisible();
    }));
    Click(dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Save));
    ASSERT_TRUE(ClickOn("putInForce"));
    ASSERT_TRUE(WaitFor([&] { return Model().Rig()->WhyNotRollBack().isEmpty(); }, kLimit_ms));
    ASSERT_TRUE(WaitFor([&] { return !Model().Busy(); }, kLimit_ms));
    // Back to the room, without the stand.
    ASSERT_TRUE(ClickOn("step2"));
    auto* stand = panel->findChild<QComboBox*>(QStringLiteral("standAt"));
    ASSERT_TRUE(WaitFor([&] { return stand->isEnabled(); }));
    stand->setCurrentIndex(0);
    Q_EMIT stand->activated(0);
    EXPECT_EQ(world->StandAt(), 0);
  }

  Rigid<frame::Camera, frame::Object> TrueValve(double motor_rad) const {
    return true_rig.CameraFromBase(motor_rad) * world->BaseFromRobot() *
           world->scene().valves.at(0).robot_from_object;
  }

  /// Where the valve is seen, by what is true: the operator draws round it in the image.
  ImageRoi RoundTheValve(double motor_rad) const {
    const Eigen::Vector3d center = TrueValve(motor_rad).translation();
    const double radius_m = 1.35 * world->scene().valves.at(0).model.rim_radius_m;
    ImageRoi region;
    region.motor_rad = motor_rad;
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      region.polygon.push_back(
          *true_rig.camera.Project(center + radius_m * Eigen::Vector3d(x, y, 0.0)));
    return region;
  }

  /// What a rig makes of the last scan, against what is true.
  void Measure(const SensorRig& rig, Errors* errors) {
    const Scan& scan = *running->bench().live.session.CurrentScan();
    const CameraFrame& image = *running->bench().live.session.CurrentImage();
    Scan with_rig = scan;
    with_rig.rig = rig;
    const auto cloud = RegisterScan(with_rig, {});
    ASSERT_TRUE(cloud) << cloud.error().message;
    const auto depth = ComputeDepthInFrame(*cloud, rig, image, {}, {});
    ASSERT_TRUE(depth) << depth.error().message;
    const DepthImage truth = world->TrueDepth(image.motor_angle_rad, {});
    // The median of the squares: one pixel at an edge is metres off, with either rig.
    std::vector<double> squares_m2;
    for (int y = 0; y < truth.height(); ++y)
      for (int x = 0; x < truth.width(); ++x)
        if (depth->mask(x, y) != 0 && std::isfinite(truth(x, y)))
          squares_m2.push_back(std::pow(depth->dense.depth_m(x, y) - truth(x, y), 2));
    ASSERT_GT(squares_m2.size(), 1000u);
    errors->depth_m2 += UpperMedian(std::move(squares_m2));

    const auto found = FitValveInScan({rig, *cloud, {}, &*depth}, FitSource::kRaw,
                                      RoundTheValve(image.motor_angle_rad), {}, {});
    ASSERT_TRUE(found) << found.error().message;
    const auto camera_from_object =
        rig.CameraFromBase(image.motor_angle_rad) * found->best.base_from_object;
    const auto truth_pose = TrueValve(image.motor_angle_rad);
    errors->position_m2 +=
        (camera_from_object.translation() - truth_pose.translation()).squaredNorm();
    const double cosine = std::abs((camera_from_object.rotation() * Eigen::Vector3d::UnitZ())
                                       .dot(truth_pose.rotation() * Eigen::Vector3d::UnitZ()));
    errors->axis_rad2 += std::pow(std::acos(std::min(1.0, cosine)), 2);
    ++errors->scans;
  }

  /// Scans the valve and adds to the errors of both rigs.
  void ScanTheValve(int scans) {
    const SensorRig in_force = running->bench().head.Rig();
    const RigError off = CompareRigs(in_force, true_rig).value();
    std::printf(
        "camera %.3f px, axis %.4f deg %.2f mm, angles %.4f deg, lidar %.4f deg %.2f mm, range "
        "%+.2f mm, stamps %+.2f ms\n",
        off.camera_rms_px, DegreesFromRadians(off.axis_rad), 1e3 * off.axis_m,
        DegreesFromRadians(off.angles_rms_rad), DegreesFromRadians(off.lidar_rad),
        1e3 * off.lidar_m, 1e3 * off.range_offset_m, 1e3 * off.stamp_offset_s);
    for (int i = 0; i < scans; ++i) {
      ASSERT_TRUE(running->ScanWithTheMouse());
      ASSERT_EQ(RigId(running->bench().live.session.CurrentScan()->rig), RigId(in_force));
      ASSERT_NO_FATAL_FAILURE(Measure(in_force, &with_found));
      ASSERT_NO_FATAL_FAILURE(Measure(true_rig, &with_true));
    }
  }

  /// Errors may be `factor` times those of the true rig.
  void ExpectAsGoodAsTheTrueRig(double factor) const {
    const auto print = [](const char* name, const Errors& errors) {
      std::printf("%s rig: depth %.2f mm (median), valve %.2f mm, %.3f deg (rms of %d scans)\n",
                  name, errors.Depth_mm(), errors.Position_mm(), errors.Axis_deg(), errors.scans);
    };
    print("true", with_true);
    print("found", with_found);
    EXPECT_LT(with_found.Depth_mm(), factor * with_true.Depth_mm());
    EXPECT_LT(with_found.Position_mm(), factor * with_true.Position_mm());
    EXPECT_LT(with_found.Axis_deg(), factor * with_true.Axis_deg());
  }
};

CalibrationSimulation FullSession(std::uint64_t seed) {
  CalibrationSimulation options;
  options.seed = seed;
  options.distinct_boards = true;
  options.most_distance_m = 1.2;  // where markers have 2.5 px a cell
  return options;
}

TEST_F(CalibrationEndToEnd, AShortSessionGivesAUsableRig) {
  CalibrationSimulation options = FullSession(3);
  options.intrinsic_views = 8;
  options.poses = 4;
  options.first_stop_deg = -20.0;
  options.stop_step_deg = 20.0;
  options.scans_per_stop = 10;
  options.most_distance_m = 1.1;
  ASSERT_NO_FATAL_FAILURE(Open(options, 0.5));
  ASSERT_NO_FATAL_FAILURE(CalibrateByClicks());
  ASSERT_NO_FATAL_FAILURE(ScanTheValve(1));
  // A third of the data and one scan: errors of rig and fit add up or cancel by chance, by a factor
  // of 1.3 even after a full session with this seed. The drawn rig, 100 mm off, has 30 times the
  // valve's 3 mm.
  ExpectAsGoodAsTheTrueRig(3.0);
}

// By night. The valve's fit has an error of its own, the same in each scan: one rig's error adds to
// it or takes from it, so several rigs are looked at.
TEST_F(CalibrationEndToEnd, AFullSessionIsAsGoodAsTheTrueRig) {
  for (const std::uint64_t seed : {21, 22, 23, 24}) {
    ASSERT_NO_FATAL_FAILURE(Open(FullSession(seed), 1.0));
    ASSERT_NO_FATAL_FAILURE(CalibrateByClicks());
    ASSERT_NO_FATAL_FAILURE(ScanTheValve(4));
  }
  ExpectAsGoodAsTheTrueRig(1.2);
}

}  // namespace
}  // namespace foresight
