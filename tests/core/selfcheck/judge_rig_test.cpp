// What the measurements mean, in words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/angles.h"
#include "core/selfcheck/check_rig.h"

namespace foresight {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

CameraCheck GoodCamera() {
  CameraCheck camera;
  camera.turn_rad.setZero();
  camera.covariance = std::pow(RadiansFromDegrees(0.02), 2) * Eigen::Matrix3d::Identity();
  camera.gain_sigmas = 0.0;
  camera.score = camera.score_before = 0.9;
  camera.score_aside = 0.4;
  camera.edges = 1000;
  camera.images = 1;
  return camera;
}

/// By 0.31 deg about its y axis, and sure of it.
CameraCheck TurnedCamera() {
  CameraCheck camera = GoodCamera();
  camera.turn_rad.y() = RadiansFromDegrees(0.31);
  camera.gain_sigmas = 8.0;
  camera.score_before = 0.8;
  return camera;
}

PlateCheck GoodPlate() {
  PlateCheck plate;
  plate.drift.setZero();
  plate.covariance.setZero();
  plate.covariance.diagonal().setConstant(std::pow(RadiansFromDegrees(0.01), 2));
  plate.up_and_down = true;
  plate.speed_rad_s = RadiansFromDegrees(20.0);
  plate.planes = 6;
  return plate;
}

TurnCheck GoodTurns() {
  TurnCheck turns;
  turns.drift.setZero();
  turns.covariance.setZero();
  turns.covariance.diagonal().setConstant(std::pow(RadiansFromDegrees(0.02), 2));
  turns.covariance(TurnCheck::kScale, TurnCheck::kScale) = std::pow(0.001, 2);
  turns.bend_seen = true;
  turns.spread_rad = RadiansFromDegrees(30.0);
  turns.images = 3;
  turns.points = 3000;
  turns.explained = 0.98;
  return turns;
}

PassCheck GoodPasses() {
  return {.stamp_s = -0.0008,
          .sigma_s = 0.0001,
          .speed_rad_s = RadiansFromDegrees(20.0),
          .patches = 4000};
}

RigCheck Judged(const Result<PlateCheck>& plate, const Result<CameraCheck>& camera,
                const Result<TurnCheck>& turns = GoodTurns(),
                const Result<PassCheck>& passes = GoodPasses()) {
  return JudgeRig(DefaultSensorRig(), plate, camera, turns, passes, RigCheckLimits());
}

const RigFinding& FindingOf(const RigCheck& check, const std::string& name) {
  for (const RigFinding& finding : check.findings)
    if (finding.name == name) return finding;
  throw std::logic_error("no such finding");
}

TEST(JudgeRig, IsQuietWhereNothingDrifted) {
  const RigCheck check = Judged(GoodPlate(), GoodCamera());
  EXPECT_THAT(check.drifted, IsEmpty());
  EXPECT_TRUE(check.SawAnything());
  for (const RigFinding& finding : check.findings)
    EXPECT_EQ(finding.state, RigFinding::State::kFine) << finding.name;
}

TEST(JudgeRig, AlwaysSaysThatTheMotorsZeroIsNotSeen) {
  EXPECT_THAT(Judged(GoodPlate(), GoodCamera()).cannot_see, Contains(HasSubstr("motor's zero")));
}

TEST(JudgeRig, DoesNotBlameTheCameraForAnEdgeThatFitsALittleBetter) {
  CameraCheck camera = GoodCamera();
  camera.turn_rad.y() = RadiansFromDegrees(0.31);
  camera.gain_sigmas = 8.0;
  camera.score_before = 0.88;  // 4 % of what the edges stand out
  const RigCheck check = Judged(GoodPlate(), camera);
  EXPECT_THAT(check.drifted, IsEmpty());
  EXPECT_THAT(check.cannot_see,
              Contains(AllOf(HasSubstr("camera's y axis"),
                             HasSubstr("with it the edges stand out by 4 % more, 8.0 deviations, "
                                       "where 7 % and 2.0 are believed"))));
}

TEST(JudgeRig, SaysByHowMuchTheCameraTurnedAndThatItWasTheCamera) {
  const CameraCheck camera = TurnedCamera();
  const RigCheck check = Judged(GoodPlate(), camera);
  EXPECT_THAT(check.drifted, Contains(HasSubstr("camera's y axis: off by 0.31 deg +- 0.02 deg")));
  EXPECT_THAT(check.drifted, Contains(HasSubstr("it is the camera that turned")));
}

TEST(JudgeRig, BlamesTheLidarWherePlanesBendToo) {
  const CameraCheck camera = TurnedCamera();
  PlateCheck plate = GoodPlate();
  plate.drift[PlateCheck::kTurnY] = RadiansFromDegrees(0.3);
  const RigCheck check = Judged(plate, camera);
  EXPECT_THAT(check.drifted, Contains(HasSubstr("it is the lidar that turned")));
  EXPECT_THAT(check.drifted, Not(Contains(HasSubstr("it is the camera"))));
}

TEST(JudgeRig, ImagesThatTurnAsTheMotorSaysClearTheCamera) {
  const CameraCheck camera = TurnedCamera();
  const RigCheck check = Judged(Fail(ErrorCode::kTooFewPoints, "no planes"), camera);
  EXPECT_THAT(check.drifted, Contains(HasSubstr("it is the lidar that turned")));
}

TEST(JudgeRig, SaysByHowMuchTheCameraTurnedOnThePlate) {
  TurnCheck turns = GoodTurns();
  turns.drift[TurnCheck::kCameraZ] = RadiansFromDegrees(-0.3);
  const RigCheck check = Judged(GoodPlate(), GoodCamera(), turns);
  EXPECT_THAT(check.drifted, testing::ElementsAre(
                                 "camera against the motor, about the head's z axis: off by -0.30 "
                                 "deg +- 0.02 deg, the limit is 0.20 deg"));
}

TEST(JudgeRig, SaysAScaleOfTheMotorInPercent) {
  TurnCheck turns = GoodTurns();
  turns.drift[TurnCheck::kScale] = 0.012;
  EXPECT_THAT(Judged(GoodPlate(), GoodCamera(), turns).drifted,
              testing::ElementsAre(HasSubstr("off by 1.20 % +- 0.10 %, the limit is 0.50 %")));
}

TEST(JudgeRig, TwoImagesSayNothingOfThePlateBetweenThem) {
  TurnCheck turns = GoodTurns();
  turns.bend_seen = false;
  const RigCheck check = Judged(GoodPlate(), GoodCamera(), turns);
  EXPECT_EQ(FindingOf(check, "motor bend").state, RigFinding::State::kNotSeen);
  EXPECT_THAT(check.cannot_see, Contains("the plate halfway between the outermost images: not "
                                         "measured; three images, farther apart, where surfaces "
                                         "have a pattern, show it"));
}

TEST(JudgeRig, SaysSoWhereCameraAndLidarBothMoved) {
  const CameraCheck camera = TurnedCamera();
  PlateCheck plate = GoodPlate();
  plate.drift[PlateCheck::kTurnY] = RadiansFromDegrees(0.3);
  TurnCheck turns = GoodTurns();
  turns.drift[TurnCheck::kCameraZ] = RadiansFromDegrees(-0.3);
  EXPECT_THAT(Judged(plate, camera, turns).drifted,
              Contains("both camera and lidar moved against the motor"));
}

TEST(JudgeRig, AboutTheMotorsAxisNobodyCanTellWhichOfThemTurned) {
  CameraCheck camera = GoodCamera();
  camera.turn_rad.x() = RadiansFromDegrees(0.31);
  camera.gain_sigmas = 8.0;
  camera.score_before = 0.8;
  EXPECT_THAT(Judged(GoodPlate(), camera).drifted, Contains(HasSubstr("does not show")));
}

TEST(JudgeRig, AUncertainDriftIsNotSeenRatherThanFoundOrFine) {
  CameraCheck camera = GoodCamera();
  camera.turn_rad.y() = RadiansFromDegrees(0.5);
  camera.covariance(1, 1) = std::pow(RadiansFromDegrees(0.3), 2);
  camera.gain_sigmas = 8.0;
  camera.score_before = 0.8;
  const RigCheck check = Judged(GoodPlate(), camera);
  EXPECT_THAT(check.drifted, IsEmpty());
  EXPECT_THAT(check.cannot_see, Contains(HasSubstr("camera's y axis")));
}

TEST(JudgeRig, ASweepOneWaySaysNothingOfTheStampsAndTellsWhatToDo) {
  const RigCheck check = Judged(
      GoodPlate(), GoodCamera(), GoodTurns(),
      Fail(ErrorCode::kTooFewPoints, "the scan sweeps one way; a scan there and back shows it"));
  EXPECT_EQ(FindingOf(check, "stamps").state, RigFinding::State::kNotSeen);
  EXPECT_THAT(check.cannot_see, Contains(HasSubstr("a scan there and back shows it")));
}

TEST(JudgeRig, SaysAnOffsetOfTheStampsInMilliseconds) {
  PassCheck passes = GoodPasses();
  passes.stamp_s = 0.0101;
  EXPECT_THAT(Judged(GoodPlate(), GoodCamera(), GoodTurns(), passes).drifted,
              Contains(HasSubstr("off by 10.1 ms +- 0.1 ms, the limit is 3.0 ms")));
}

TEST(JudgeRig, WhatWasNotMeasuredIsGivenWithItsReason) {
  const RigCheck check = Judged(tl::unexpected<Error>(Error{ErrorCode::kTooFewPoints, "no planes"}),
                                tl::unexpected<Error>(Error{ErrorCode::kTooFewPoints, "no image"}),
                                Fail(ErrorCode::kTooFewPoints, "one image"),
                                Fail(ErrorCode::kTooFewPoints, "one way"));
  EXPECT_FALSE(check.SawAnything());
  EXPECT_THAT(check.drifted, IsEmpty());
  EXPECT_THAT(check.cannot_see, Contains(HasSubstr("no planes")));
  EXPECT_THAT(check.cannot_see, Contains(HasSubstr("no image")));
  EXPECT_THAT(check.cannot_see, Contains(HasSubstr("one image")));
  EXPECT_THAT(check.cannot_see, Contains(HasSubstr("one way")));
}

}  // namespace
}  // namespace foresight
