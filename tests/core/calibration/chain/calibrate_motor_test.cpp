// Camera and motor: accuracy against the truth of simulated sessions, and what must be refused.
#include "core/calibration/calibrate_motor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/calibration/compare_rigs.h"
#include "core/calibration/motor_graph.h"
#include "core/evaluation/simulate_calibration.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

CalibrationSimulation OnlyImages(std::uint64_t seed) {
  CalibrationSimulation options;
  options.seed = seed;
  options.scans_per_stop = 0;
  options.sweeps = 0;
  return options;
}

SensorRig RigOf(const MotorCalibration& found, const SensorRig& prior) {
  SensorRig rig = prior;
  rig.camera_from_head = found.state.camera_from_head;
  std::vector<AngleCorrection::Knot> knots;
  for (std::size_t i = 0; i < found.state.motor_rad.size(); ++i)
    knots.push_back({found.state.motor_rad[i], found.state.plate_rad[i]});
  rig.angle_correction = *AngleCorrection::FromKnots(std::move(knots));
  return rig;
}

struct Accuracy {
  RigError error;
  double mean_px = 0.0;
};

Accuracy AccuracyOf(const CalibrationSimulation& options,
                    const MotorCalibrationOptions& motor = {}) {
  const auto made = SimulateCalibration(options);
  EXPECT_TRUE(made) << made.error().message;
  const auto found = CalibrateMotor(made->session, made->truth.camera, motor, {});
  EXPECT_TRUE(found) << "seed " << options.seed << ": " << found.error().message;
  if (!found) return {};
  return {CompareRigs(RigOf(*found, made->session.prior), made->truth).value(),
          found->mean_error_px};
}

std::string MessageOf(const CalibrationSession& session, const CameraModel& camera,
                      const MotorCalibrationOptions& options = {}) {
  const auto found = CalibrateMotor(session, camera, options, {});
  return found ? "accepted" : found.error().message;
}

class CalibrateMotor : public ::testing::TestWithParam<CameraMount> {};

TEST_P(CalibrateMotor, FindsAxisAndAnglesOfEveryMount) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CalibrationSimulation options = OnlyImages(seed);
    options.mount = GetParam();
    const Accuracy found = AccuracyOf(options);
    // The bars of the issue, with the true intrinsics: 0.06 deg, 0.8 mm, 0.05 deg rms.
    EXPECT_LT(DegreesFromRadians(found.error.axis_rad), 0.06) << "seed " << seed;
    EXPECT_LT(1000.0 * found.error.axis_m, 0.8) << "seed " << seed;
    EXPECT_LT(DegreesFromRadians(found.error.angles_rms_rad), 0.05) << "seed " << seed;
    // 1.2533 sigma is the mean distance of noise of 0.287 px an axis.
    EXPECT_NEAR(found.mean_px, 0.36, 0.015) << "seed " << seed;
  }
}
INSTANTIATE_TEST_SUITE_P(Mounts, CalibrateMotor,
                         ::testing::Values(CameraMount::kNormal, CameraMount::kPortrait,
                                           CameraMount::kUpsideDown));

TEST(CalibrateMotorAccuracy, OfExactCornersIsThatOfNumbers) {
  CalibrationSimulation options = OnlyImages(5);
  options.corner_sigma_px = 0.0;
  options.repeatability_rad = 0.0;
  const Accuracy found = AccuracyOf(options);
  EXPECT_LT(found.error.axis_rad, 1e-7);
  EXPECT_LT(found.error.axis_m, 1e-7);
  EXPECT_LT(found.error.angles_most_rad, 1e-7);
}

TEST(CalibrateMotorAccuracy, AsInThePaperADihedralErrorMovesTheAxis) {
  CalibrationSimulation options = OnlyImages(3);
  options.dihedral_error_rad = 0.0087;  // 0.5 deg
  MotorCalibrationOptions paper;
  paper.as_in_the_paper = true;
  const Accuracy printed = AccuracyOf(options, paper), ours = AccuracyOf(options);
  // A known limit of the printed sequence: the stand is taken for perpendicular.
  EXPECT_GT(printed.mean_px, 1.5 * ours.mean_px);
}

TEST(CalibrateMotorRefusals, NameAStopThatNoImageShows) {
  auto made = SimulateCalibration(OnlyImages(1));
  for (PatternPose& pose : made->session.poses)
    for (MotorStop& stop : pose.stops)
      if (std::abs(DegreesFromRadians(stop.motor_rad) - 40.0) < 0.1) {
        stop.view = {};
        stop.lines.resize(1);
        stop.lines[0].range_mm.assign(1081, 1000);
      }
  EXPECT_THAT(MessageOf(made->session, made->truth.camera),
              ::testing::HasSubstr("no image shows the stand at the stops 40 deg"));
}

TEST(CalibrateMotorRefusals, NameStopsThatAreNotTiedToTheReference) {
  auto made = SimulateCalibration(OnlyImages(1));
  // Half of the poses see only 0 deg and below, the others only what is above.
  for (std::size_t pose = 0; pose < made->session.poses.size(); ++pose)
    std::erase_if(made->session.poses[pose].stops,
                  [pose](const MotorStop& stop) { return (stop.motor_rad > 0.01) == (pose < 3); });
  std::erase_if(made->session.poses, [](const PatternPose& pose) { return pose.stops.empty(); });
  EXPECT_THAT(MessageOf(made->session, made->truth.camera),
              ::testing::HasSubstr("no pose of the stand ties the stops"));

  MotorCalibrationOptions leave_out;
  leave_out.loose_stops = MotorCalibrationOptions::LooseStops::kLeaveOut;
  const auto found = foresight::CalibrateMotor(made->session, made->truth.camera, leave_out, {});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LE(found->state.motor_rad.back(), 0.01);
  EXPECT_THAT(found->notes.front(), ::testing::HasSubstr("left out"));
}

/// The first image of a pose that shows both boards.
MotorStop& ImageOfBoth(CalibrationSession& session, std::size_t pose) {
  auto& stops = session.poses[pose].stops;
  return *std::find_if(stops.begin(), stops.end(),
                       [](const MotorStop& stop) { return stop.view.a && stop.view.b; });
}

/// The session with some images spoilt is as good as without them, and says which it left out.
void ExpectLeftOut(const CalibrationSession& session, const SensorRig& truth,
                   const std::string& which, const std::string& why) {
  const auto found = foresight::CalibrateMotor(session, truth.camera, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_THAT(found->notes, ::testing::Contains(::testing::AllOf(::testing::HasSubstr(which),
                                                                 ::testing::HasSubstr("left out"),
                                                                 ::testing::HasSubstr(why))));
  const RigError error = CompareRigs(RigOf(*found, session.prior), truth).value();
  EXPECT_LT(DegreesFromRadians(error.axis_rad), 0.06);  // the bar
}

TEST(CalibrateMotorMisfits, AnImageWithExchangedBoardsIsLeftOutByName) {
  auto made = SimulateCalibration(OnlyImages(2));
  MotorStop& stop = ImageOfBoth(made->session, 1);
  std::swap(stop.view.a, stop.view.b);
  ExpectLeftOut(made->session, made->truth, "pose 2, stop", "exchanged");
}

TEST(CalibrateMotorMisfits, AGridThatWasFoundAcrossBothBoardsIsLeftOut) {
  auto made = SimulateCalibration(OnlyImages(2));
  MotorStop& stop = ImageOfBoth(made->session, 2);
  // Left half of the grid on board A, right half on board B.
  BoardView across = *stop.view.a;
  for (std::size_t i = 0; i < across.pixels.size() && i < stop.view.b->pixels.size(); ++i)
    if (across.corner_ids[i] % made->session.mount.a.columns >= made->session.mount.a.columns / 2)
      across.pixels[i] = stop.view.b->pixels[i];
  stop.view.a = across;
  stop.view.b.reset();
  ExpectLeftOut(made->session, made->truth, "pose 3, stop", "do not lie in a plane");
}

TEST(CalibrateMotorRefusals, SayThatAllBoardsAreExchanged) {
  auto made = SimulateCalibration(OnlyImages(2));
  for (PatternPose& pose : made->session.poses)
    for (MotorStop& stop : pose.stops) std::swap(stop.view.a, stop.view.b);
  EXPECT_THAT(MessageOf(made->session, made->truth.camera),
              ::testing::HasSubstr("boards A and B are exchanged"));
}

TEST(CalibrateMotorRefusals, SayThatImagesAreMirrored) {
  auto made = SimulateCalibration(OnlyImages(2));
  for (PatternPose& pose : made->session.poses)
    for (MotorStop& stop : pose.stops)
      for (auto* view : {&stop.view.a, &stop.view.b})
        if (*view)
          for (Eigen::Vector2d& pixel : (*view)->pixels)
            pixel.x() = 2.0 * made->truth.camera.cx - pixel.x();
  EXPECT_THAT(MessageOf(made->session, made->truth.camera), ::testing::HasSubstr("mirrored"));
}

TEST(CalibrateMotorRefusals, SayThatThePlateDoesNotTurnAsCommanded) {
  // Stops of a head whose motor takes 5 % more steps a turn.
  auto made = SimulateCalibration(OnlyImages(2));
  for (PatternPose& pose : made->session.poses)
    for (MotorStop& stop : pose.stops) stop.motor_rad *= 1.05;
  EXPECT_THAT(MessageOf(made->session, made->truth.camera),
              ::testing::HasSubstr("of another head"));
}

TEST(CalibrateMotorMisfits, AnImageOfAStandThatMovedIsLeftOut) {
  auto made = SimulateCalibration(OnlyImages(2));
  MotorStop& stop = made->session.poses[2].stops[1];
  for (auto* view : {&stop.view.a, &stop.view.b})
    if (*view)
      for (Eigen::Vector2d& pixel : (*view)->pixels) pixel.x() += 40.0;
  ExpectLeftOut(made->session, made->truth, "pose 3, stop", "stand moved");
}

TEST(CalibrateMotorMisfits, ABoardTakenForTheOtherIsLeftOut) {
  // What a finder does where the image's border leaves as much of one board as the other has.
  auto made = SimulateCalibration(OnlyImages(2));
  MotorStop& stop = ImageOfBoth(made->session, 4);
  stop.view.b = stop.view.a;
  stop.view.a.reset();
  ExpectLeftOut(made->session, made->truth, "pose 5, stop", "one board was taken for the other");
}

TEST(CalibrateMotorRefusals, SayThatTheStandMovedInManyImages) {
  auto made = SimulateCalibration(OnlyImages(2));
  for (std::size_t pose = 0; pose < 5; ++pose) {
    auto& stops = made->session.poses[pose].stops;
    for (std::size_t i = 0; i < stops.size(); i += 2)
      for (auto* view : {&stops[i].view.a, &stops[i].view.b})
        if (*view)
          for (Eigen::Vector2d& pixel : (*view)->pixels)
            pixel.x() += 20.0 * static_cast<double>(i + 1);
  }
  EXPECT_THAT(MessageOf(made->session, made->truth.camera), ::testing::HasSubstr("stand moved"));
}

TEST(CalibrateMotorRefusals, DoNotMindAStopThatOnePoseLacks) {
  auto made = SimulateCalibration(OnlyImages(2));
  made->session.poses[0].stops.erase(made->session.poses[0].stops.begin() + 1);
  EXPECT_EQ(MessageOf(made->session, made->truth.camera), "accepted");
}

TEST(PaperGauge, IsTheSameAxisWithoutTurnAndShiftAlongTheCamerasX) {
  const Rigid<frame::Camera, frame::Head> ours(
      Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Eigen::Vector3d(0.5, 0.2, -0.3).normalized())),
      Eigen::Vector3d(0.03, 0.04, -0.05));
  const auto paper = InPaperGauge(ours);
  ASSERT_TRUE(paper) << paper.error().message;
  EXPECT_NEAR(paper->translation().x(), 0.0, 1e-12);
  EXPECT_NEAR(paper->rotation().x(), 0.0, 1e-12);
  const Eigen::Vector3d axis = ours.Rotate(Eigen::Vector3d::UnitX());
  EXPECT_LT((paper->Rotate(Eigen::Vector3d::UnitX()) - axis).norm(), 1e-12);
  EXPECT_LT((paper->translation() - ours.translation()).cross(axis).norm(), 1e-12);
}

TEST(PaperGauge, DoesNotExistForAPortraitMount) {
  const Rigid<frame::Camera, frame::Head> portrait(
      Eigen::Quaterniond(Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitZ())),
      Eigen::Vector3d(0.03, 0.04, -0.05));
  EXPECT_FALSE(InPaperGauge(portrait));
}

}  // namespace
}  // namespace foresight
