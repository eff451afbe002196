// The whole chain against the truth of simulated sessions, and what it must refuse.
// calibration_statistics_test.cpp has the accuracy over many sessions.
#include "core/calibration/calibrate_chain.h"

#include <gmock/gmock.h>

#include "core/geometry/angles.h"
#include "tests/core/calibration/chain/calibrated_session.h"

namespace foresight {
namespace {

using samples::CalibratedSession;
using samples::CalibrateSimulated;
using ::testing::HasSubstr;

CalibrationSimulation Seeded(std::uint64_t seed) {
  CalibrationSimulation options;
  options.seed = seed;
  return options;
}

std::string MessageOf(const CalibrationSession& session,
                      const ChainCalibrationOptions& options = {}) {
  const auto found = CalibrateChain(session, options, {});
  return found ? "accepted" : found.error().message;
}

class CalibrateChainOfMount : public ::testing::TestWithParam<CameraMount> {};

TEST_P(CalibrateChainOfMount, FindsEverythingFromARoughDrawing) {
  CalibrationSimulation options = Seeded(4);
  options.mount = GetParam();
  const CalibratedSession session = CalibrateSimulated(options);
  // The bars of the issue for a joint solve.
  EXPECT_LT(DegreesFromRadians(session.error.axis_rad), 0.035);
  EXPECT_LT(1000.0 * session.error.axis_m, 0.8);
  EXPECT_LT(DegreesFromRadians(session.error.angles_rms_rad), 0.03);
  EXPECT_LT(DegreesFromRadians(session.error.lidar_rad), 0.2);
  EXPECT_LT(1000.0 * session.error.lidar_m, 3.0);
  EXPECT_LT(1000.0 * std::abs(session.error.stamp_offset_s), 1.0);
  ASSERT_TRUE(session.found.fit);
  EXPECT_NEAR(session.found.fit->ReducedChiSquare(), 1.0, 0.05);
  EXPECT_THAT(session.found.weakest, HasSubstr("+-"));
  ASSERT_TRUE(session.found.linear);
  // Another method, without start: Procrustes of a linear solution.
  EXPECT_LT(DegreesFromRadians(session.found.linear->turn_rad), 2.0);
  EXPECT_LT(session.found.linear->shift_m, 0.03);
}
INSTANTIATE_TEST_SUITE_P(Mounts, CalibrateChainOfMount,
                         ::testing::Values(CameraMount::kNormal, CameraMount::kPortrait,
                                           CameraMount::kUpsideDown));

TEST(CalibrateChain, TellsABiasOfTheRanges) {
  CalibrationSimulation options = Seeded(5);
  options.range_bias_m = 0.020;
  const CalibratedSession session = CalibrateSimulated(options);
  EXPECT_NEAR(1000.0 * session.found.rig.lidar.range_offset_m, -20.0, 4.0);
  EXPECT_LT(1000.0 * session.error.lidar_m, 3.0);
}

TEST(CalibrateChain, JointRefinementHalvesTheErrorOfTheAngles) {
  // The stages take the intrinsics as exact, with which the angles' scale is wrong.
  double joint = 0.0, stages = 0.0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    CalibrationSimulation options = Seeded(seed);
    options.sweeps = 1;
    joint += std::pow(CalibrateSimulated(options).error.angles_rms_rad, 2);
    ChainCalibrationOptions first;
    first.stage = CalibrationStage::kLidar;
    stages += std::pow(CalibrateSimulated(options, first).error.angles_rms_rad, 2);
  }
  EXPECT_LT(std::sqrt(joint), 0.8 * std::sqrt(stages));
}

TEST(CalibrateChain, AsInThePaperIgnoresABiasOfTheRanges) {
  // A known limit of Eq. (6): a bias of 20 mm becomes a shift of the lidar.
  CalibrationSimulation options = Seeded(7);
  options.range_bias_m = 0.020;
  ChainCalibrationOptions paper;
  paper.as_in_the_paper = true;
  const CalibratedSession printed = CalibrateSimulated(options, paper);
  EXPECT_GT(1000.0 * printed.error.lidar_m, 10.0);
  EXPECT_FALSE(printed.found.covariance);
  EXPECT_NEAR(printed.found.rig.camera_from_head.translation().x(), 0.0, 1e-9);
}

TEST(CalibrateChain, RefusesASweepThatGoesOneWay) {
  CalibrationSimulation options = Seeded(8);
  options.one_way_sweep = true;
  const auto made = SimulateCalibration(options);
  EXPECT_THAT(MessageOf(made->session), HasSubstr("goes up only"));
}

TEST(CalibrateChain, GoesWithoutASweepAndSaysSo) {
  CalibrationSimulation options = Seeded(8);
  options.sweeps = 0;
  const CalibratedSession session = CalibrateSimulated(options);
  EXPECT_THAT(session.found.notes, ::testing::Contains(HasSubstr("no sweep")));
  EXPECT_EQ(session.found.covariance->Find("stamp offset"), -1);
  ChainCalibrationOptions time;
  time.stage = CalibrationStage::kTime;
  EXPECT_THAT(MessageOf(session.made.session, time), HasSubstr("the session has no sweep"));
}

TEST(CalibrateChain, SaysThatTheLidarSeesTooFewBoards) {
  CalibrationSimulation options = Seeded(9);
  options.sweeps = 0;
  options.poses = 3;
  auto made = SimulateCalibration(options);
  // The boards stand where no beam passes: only the outermost beams have returns.
  for (PatternPose& pose : made->session.poses)
    for (MotorStop& stop : pose.stops)
      for (LidarLine& line : stop.lines)
        std::fill(line.range_mm.begin() + 200, line.range_mm.end() - 200, std::uint16_t{1});
  EXPECT_THAT(MessageOf(made->session), HasSubstr("lie on the boards"));
}

TEST(CalibrateChain, SaysWhichDirectionAParallelHingeLeavesOpen) {
  // One pose of the stand: two planes, met by a few lines, leave the lidar loose.
  CalibrationSimulation options = Seeded(10);
  auto made = SimulateCalibration(options);
  auto& poses = made->session.poses;
  for (std::size_t pose = 1; pose < poses.size(); ++pose) {
    poses[pose].sweep = {};
    for (MotorStop& stop : poses[pose].stops) stop.lines.clear();
    std::erase_if(poses[pose].stops, [](const MotorStop& stop) { return stop.view.empty(); });
  }
  ChainCalibrationOptions only_lidar;
  const auto found = CalibrateChain(made->session, only_lidar, {});
  // Either too few lines, or a weak direction with what to do about it: never a silent answer.
  const std::string text = found ? found->weakest : found.error().message;
  EXPECT_THAT(text, ::testing::AnyOf(HasSubstr("hinge"), HasSubstr("hinges")));
}

TEST(CalibrateChain, SaysThatTheTableOfAnglesIsThatOfAnotherHead) {
  auto made = SimulateCalibration(Seeded(11));
  std::vector<AngleCorrection::Knot> knots;
  for (int degrees = -30; degrees <= 80; degrees += 10) {
    const double motor = RadiansFromDegrees(degrees);
    knots.push_back({motor, motor + 0.01 * std::sin(3.0 * motor)});
  }
  made->session.prior.angle_correction = *AngleCorrection::FromKnots(knots);
  const auto found = CalibrateChain(made->session, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_THAT(found->notes, ::testing::Contains(HasSubstr("of another head")));
}

TEST(CalibrateChain, ScalesItsNoiseToTheResidualsWhenAsked) {
  CalibrationSimulation options = Seeded(12);
  options.corner_sigma_px = 0.5;  // corners are worse than assumed
  ChainCalibrationOptions chain;
  const double assumed = CalibrateSimulated(options, chain).found.fit->ReducedChiSquare();
  chain.noise_from_residuals = true;
  const CalibratedSession session = CalibrateSimulated(options, chain);
  EXPECT_GT(assumed, 1.5);
  EXPECT_NEAR(session.found.fit->ReducedChiSquare(), 1.0, 0.05);
  EXPECT_NEAR(session.found.noise.corner_px, 0.5, 0.03);
}

TEST(CalibrateChain, StopsWhenItIsCancelled) {
  const auto made = SimulateCalibration(Seeded(1));
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto found = CalibrateChain(made->session, {}, context);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace foresight
