// From a scene with boards to a rig: a simulated head stops and sweeps before a stand that is moved
// from place to place, everything goes into a session's folder, and the folder is calibrated.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <iostream>

#include "app/common/record_calibration.h"
#include "app/common/wait_for_head.h"
#include "core/calibration/compare_rigs.h"
#include "core/calibration/session_file.h"
#include "core/evaluation/calibration_scene.h"
#include "core/geometry/angles.h"
#include "hardware/simulated/simulated_head.h"
#include "tests/support/shrink_camera.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A head in a room with the boards of a simulated session, which exists in numbers only.
class RecordedCalibration : public testing::Test {
 protected:
  enum class Stand { kCheckerboards, kCharuco };

  void MakeHead(const CalibrationSimulation& options, double image_scale,
                Stand stand = Stand::kCheckerboards) {
    auto made = SimulateCalibration(options);
    ASSERT_TRUE(made) << made.error().message;
    made_ = std::move(*made);
    if (stand == Stand::kCharuco) MarkBoards(&made_.session.mount);
    const auto scene = SceneFromYaml(CalibrationSceneYaml(made_), "scene.yaml");
    ASSERT_TRUE(scene) << scene.error().message;
    SensorRig truth = made_.truth, prior = made_.session.prior;
    for (SensorRig* rig : {&truth, &prior}) Shrink(image_scale, &rig->camera);
    WorldOptions world;
    world.seed = options.seed;
    world_ = std::make_shared<const World>(std::make_shared<const Scene>(*scene), truth, world);
    SimulatedHeadOptions head_options;
    head_options.believed_rig = prior;
    head_options.speed = SimulationSpeed::kAsFastAsPossible;
    auto head = MakeSimulatedHead(world_, head_options);
    ASSERT_TRUE(head) << head.error().message;
    head_ = std::move(*head);
    ASSERT_TRUE(HomeAndWait(*head_, {}));
    // The stand as it was drawn, not as it was built.
    auto folder = SessionFolder::Create(folder_ / "session",
                                        {.name = "recorded",
                                         .mount = made_.session.mount,
                                         .intrinsic_board = made_.session.intrinsic_board,
                                         .prior = prior});
    ASSERT_TRUE(folder) << folder.error().message;
    session_.emplace(std::move(*folder));
  }

  void RecordAllPlaces(const CalibrationSimulation& options) {
    PoseRecording pose;
    for (double deg = options.first_stop_deg; deg <= options.last_stop_deg + 1e-6;
         deg += options.stop_step_deg)
      pose.stops.angles_rad.push_back(RadiansFromDegrees(deg));
    pose.stops.lines = options.scans_per_stop;
    ScanPlan sweep{.from_rad = pose.stops.angles_rad.front(),
                   .to_rad = pose.stops.angles_rad.back(),
                   .speed_rad_s = RadiansFromDegrees(options.sweep_speed_deg_s),
                   .passes = 2};
    sweep.image_angles_rad = {sweep.from_rad};
    pose.sweep = sweep;
    const Scene& scene = world_->scene();
    for (int place = 1; place <= static_cast<int>(scene.places.size()); ++place) {
      ASSERT_TRUE(world_->MoveStand(place));
      const StandPlace& there = scene.places[static_cast<std::size_t>(place - 1)];
      pose.name = there.name;
      if (scene.stands[static_cast<std::size_t>(there.stand)].b) {
        const auto recorded = RecordPose(*head_, pose, *session_, {});
        ASSERT_TRUE(recorded) << recorded.error().message;
        EXPECT_EQ(recorded->missing, "");
        EXPECT_EQ(recorded->images, static_cast<int>(pose.stops.angles_rad.size()));
        EXPECT_TRUE(recorded->sweep);
      } else {
        StopPlan view = pose.stops;
        view.angles_rad = {0.0};
        view.lines = 0;
        const Status recorded = RecordIntrinsicView(*head_, view, there.name, *session_, {});
        ASSERT_TRUE(recorded) << recorded.error().message;
      }
    }
  }

  /// Reads the folder, looks for the boards and solves; says how long both took.
  void Calibrate() {
    const auto start = Clock::now();
    auto session = ReadCalibrationSession(session_->Path(), {});
    ASSERT_TRUE(session) << session.error().message;
    detection_s_ = SecondsSince(start);
    const auto solve = Clock::now();
    const auto found = CalibrateChain(*session, {}, {});
    ASSERT_TRUE(found) << found.error().message;
    solve_s_ = SecondsSince(solve);
    views_ = static_cast<int>(session->intrinsic_views.size());
    found_ = *found;
    error_ = CompareRigs(found_.rig, TrueRig()).value();
    std::cout << fmt::format(
        "{} views; focal {:.2f} px, axis {:.4f} deg {:.2f} mm, angles rms {:.4f} deg, lidar {:.3f} "
        "deg {:.2f} mm, range offset {:.2f} mm, stamps {:.3f} ms; chi2 {:.3f}; boards {:.1f} s, "
        "solve {:.1f} s\n",
        views_, error_.focal_px, DegreesFromRadians(error_.axis_rad), 1e3 * error_.axis_m,
        DegreesFromRadians(error_.angles_rms_rad), DegreesFromRadians(error_.lidar_rad),
        1e3 * error_.lidar_m, 1e3 * error_.range_offset_m, 1e3 * error_.stamp_offset_s,
        found_.fit ? found_.fit->ReducedChiSquare() : 0.0, detection_s_, solve_s_);
  }

  /// With the plate's angles at the stops; 0 deg is 0 by definition.
  SensorRig TrueRig() const {
    SensorRig rig = world_->true_rig();
    std::vector<AngleCorrection::Knot> knots;
    for (const auto& knot : found_.rig.angle_correction.knots())
      knots.push_back({knot.motor_rad,
                       world_->PlateAngle(knot.motor_rad, true) - world_->PlateAngle(0.0, true)});
    rig.angle_correction = *AngleCorrection::FromKnots(std::move(knots));
    return rig;
  }

  void ExpectTheBars() const {
    EXPECT_GE(views_, 15);  // some are cut by the image's border
    EXPECT_LT(DegreesFromRadians(error_.axis_rad), 0.035);
    EXPECT_LT(1e3 * error_.axis_m, 0.8);
    EXPECT_LT(DegreesFromRadians(error_.angles_rms_rad), 0.03);
    EXPECT_LT(DegreesFromRadians(error_.lidar_rad), 0.2);
    EXPECT_LT(1e3 * error_.lidar_m, 3.0);
    EXPECT_LT(1e3 * std::abs(error_.stamp_offset_s), 1.0);
    EXPECT_LT(detection_s_ + solve_s_, 60.0);
  }

  TemporaryFolder folder_;
  SimulatedCalibration made_;
  std::shared_ptr<const World> world_;
  std::unique_ptr<SensorHead> head_;
  std::optional<SessionFolder> session_;
  ChainCalibration found_;
  RigError error_;
  int views_ = 0;
  double detection_s_ = 0.0, solve_s_ = 0.0;
};

CalibrationSimulation Simulation() {
  CalibrationSimulation options;
  options.seed = 3;
  options.distinct_boards = true;
  return options;
}

// A few seconds: half the image, half of the poses and stops. Bars are twice those of a full
// session.
TEST_F(RecordedCalibration, AShortSessionGivesTheRigOfTheHead) {
  CalibrationSimulation options = Simulation();
  options.intrinsic_views = 10;
  options.poses = 4;
  options.stop_step_deg = 20.0;
  options.first_stop_deg = -20.0;
  options.scans_per_stop = 10;
  options.most_distance_m = 1.1;
  ASSERT_NO_FATAL_FAILURE(MakeHead(options, 0.5));
  ASSERT_NO_FATAL_FAILURE(RecordAllPlaces(options));
  ASSERT_NO_FATAL_FAILURE(Calibrate());
  EXPECT_GE(views_, 8);
  EXPECT_LT(DegreesFromRadians(error_.axis_rad), 0.07);
  EXPECT_LT(1e3 * error_.axis_m, 1.6);
  EXPECT_LT(DegreesFromRadians(error_.angles_rms_rad), 0.06);
  EXPECT_LT(DegreesFromRadians(error_.lidar_rad), 0.4);
  EXPECT_LT(1e3 * error_.lidar_m, 6.0);
  EXPECT_LT(1e3 * std::abs(error_.stamp_offset_s), 2.0);
}

// By night: the whole session of the issue, against its bars.
TEST_F(RecordedCalibration, AFullSessionMeetsTheBars) {
  CalibrationSimulation options = Simulation();
  options.most_distance_m = 1.2;  // where markers have 2.5 px a cell
  ASSERT_NO_FATAL_FAILURE(MakeHead(options, 1.0, Stand::kCharuco));
  ASSERT_NO_FATAL_FAILURE(RecordAllPlaces(options));
  ASSERT_NO_FATAL_FAILURE(Calibrate());
  ExpectTheBars();
}

// No image is left out: none of the boards is taken for the other, or found across the hinge.
TEST_F(RecordedCalibration, AFullSessionOfCheckerboardsMeetsTheBars) {
  const CalibrationSimulation options = Simulation();
  ASSERT_NO_FATAL_FAILURE(MakeHead(options, 1.0));
  ASSERT_NO_FATAL_FAILURE(RecordAllPlaces(options));
  ASSERT_NO_FATAL_FAILURE(Calibrate());
  ExpectTheBars();
  EXPECT_THAT(found_.notes, testing::Not(testing::Contains(testing::HasSubstr("left out:"))));
}

TEST_F(RecordedCalibration, WhatCameBeforeACancelIsInTheSession) {
  CalibrationSimulation options = Simulation();
  options.intrinsic_views = 1;
  options.poses = 1;
  ASSERT_NO_FATAL_FAILURE(MakeHead(options, 0.25));
  ASSERT_TRUE(world_->MoveStand(2));
  std::stop_source stop;
  RunContext context;
  context.stop = stop.get_token();
  PoseRecording pose;
  pose.stops.angles_rad = {0.0, 0.1};
  pose.stops.lines = 3;
  ASSERT_TRUE(RecordPose(*head_, pose, *session_, context));
  stop.request_stop();
  pose.stops.lines = 4000;  // minutes
  const auto cancelled = RecordPose(*head_, pose, *session_, context);
  ASSERT_TRUE(cancelled) << cancelled.error().message;
  EXPECT_NE(cancelled->missing, "");
  EXPECT_FALSE(cancelled->sweep);
  const auto index = ReadSessionIndex(session_->Path());
  ASSERT_TRUE(index);
  ASSERT_FALSE(index->poses.empty());
  EXPECT_EQ(index->poses[0].stops.size(), 2u);
  EXPECT_EQ(head_->Status().state, HeadState::kReady);
}

}  // namespace
}  // namespace foresight
