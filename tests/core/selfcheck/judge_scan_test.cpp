// What the parts of a check mean together, and in words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"
#include "core/selfcheck/check_scan.h"
#include "core/selfcheck/gather_rig.h"

namespace foresight {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

CameraCheck Camera(double turn_y_deg, double sigma_deg) {
  CameraCheck camera;
  camera.turn_rad = {0.0, RadiansFromDegrees(turn_y_deg), 0.0};
  camera.covariance = std::pow(RadiansFromDegrees(sigma_deg), 2) * Eigen::Matrix3d::Identity();
  camera.score = 0.9;
  camera.score_before = 0.7;
  camera.score_aside = 0.4;
  camera.gain_sigmas = 8.0;
  camera.edges = 1000;
  camera.images = 1;
  return camera;
}

RigCheck Rig(const Result<CameraCheck>& camera) {
  return JudgeRig(DefaultSensorRig(), Fail(ErrorCode::kTooFewPoints, "no planes"), camera,
                  Fail(ErrorCode::kTooFewPoints, "one image"),
                  Fail(ErrorCode::kTooFewPoints, "one way"), {});
}

std::vector<HeldOutBeam> Beams(double confidence, double right) {
  Random random(1);
  std::vector<HeldOutBeam> beams;
  for (int i = 0; i < 2000; ++i) {
    HeldOutBeam beam;
    beam.line = i / 50;
    beam.beam = i % 50;
    beam.depth_m = 3.0f;
    beam.map_m = random.Uniform() < right ? 3.005f : 3.3f;
    beam.confidence = static_cast<float>(confidence);
    beam.kept = true;
    beams.push_back(beam);
  }
  return beams;
}

DepthCheck Depth(double confidence, double right) {
  return SummariseHeldOut(Beams(confidence, right), Beams(confidence, right), {},
                          DepthMethod::kForesight, {});
}

ScanCheck Judged(const Result<DepthCheck>& depth, const RigCheck& rig,
                 const std::vector<HalfFits>& objects = {}) {
  return JudgeScan(DefaultSensorRig(), depth, rig, objects);
}

TEST(JudgeScan, AGoodScanNeedsNothing) {
  const ScanCheck check = Judged(Depth(0.95, 0.98), Rig(Camera(0.03, 0.02)));
  EXPECT_EQ(check.light, CheckLight::kGood);
  EXPECT_THAT(check.advice,
              StartsWith("nothing to do: image edges lie on the lidar's within 0.3 px"));
}

TEST(JudgeScan, SaysHowManyPixelsTheImagesEdgesLieAside) {
  // -0.39 deg about y of a camera of 601 px: 4.1 px to the left.
  const ScanCheck check = Judged(Depth(0.95, 0.98), Rig(Camera(-0.39, 0.02)));
  EXPECT_EQ(check.light, CheckLight::kAmber);
  EXPECT_EQ(
      check.advice,
      "image edges lie 4.1 px left of the lidar's: check the calibration of camera and lidar");
}

TEST(JudgeScan, PixelsAsideAreThoseOfTheTurn) {
  const SensorRig rig = DefaultSensorRig();
  const RigCheck check = Rig(Camera(0.3, 0.02));
  const Eigen::Vector3d ahead(0.0, 0.0, 2.0);
  const Eigen::Vector2d before = *rig.camera.Project(ahead);
  const Eigen::Vector2d after = *rig.camera.Project(RotationExp(check.camera->turn_rad) * ahead);
  // The lens is no pinhole: it spreads its middle by 6 % less.
  EXPECT_LT((EdgesOff_px(rig, check) - (after - before)).norm(), 0.3);
}

TEST(JudgeScan, ADirectionThatIsNotSeenIsNotCalledGood) {
  CameraCheck camera = Camera(0.03, 0.02);
  camera.turn_rad.x() = RadiansFromDegrees(0.8);  // 8 px, but it may be anything
  camera.covariance(0, 0) = std::pow(RadiansFromDegrees(0.5), 2);
  const ScanCheck check = Judged(Depth(0.95, 0.98), Rig(camera));
  EXPECT_EQ(check.points.at(0).light, CheckLight::kGood);
  const double px = DefaultSensorRig().camera.fx * RadiansFromDegrees(0.03);
  EXPECT_EQ(check.points.at(0).sentence,
            fmt::format("image edges lie on the lidar's within {:.1f} px", px));
}

TEST(JudgeScan, AGraveDriftIsRed) {
  EXPECT_EQ(Judged(Depth(0.95, 0.98), Rig(Camera(0.7, 0.02))).light, CheckLight::kRed);
}

TEST(JudgeScan, DepthThatPromisesTooMuchIsTold) {
  const ScanCheck check = Judged(Depth(0.95, 0.85), Rig(Camera(0.03, 0.02)));
  EXPECT_EQ(check.light, CheckLight::kAmber);
  EXPECT_THAT(check.advice, HasSubstr("promises to be right in 95 % of the places is right in 8"));
  EXPECT_EQ(Judged(Depth(0.95, 0.6), Rig(Camera(0.03, 0.02))).light, CheckLight::kRed);
}

/// Pairs of neighbouring lines that stayed out. The map's error is the same all along a pair.
std::vector<HeldOutBeam> LinePairs(double map_m, double line_m, double beam_m) {
  Random random(7);
  std::vector<HeldOutBeam> beams;
  for (int pair = 0; pair < 600; ++pair) {
    const double map_error_m = map_m * random.Normal();
    for (const int line : {20 * pair + 10, 20 * pair + 11}) {
      const double line_error_m = line_m * random.Normal();
      for (int beam = 0; beam < 30; ++beam) {
        HeldOutBeam held_out;
        held_out.line = line;
        held_out.beam = beam;
        held_out.depth_m = static_cast<float>(3.0 + line_error_m + beam_m * random.Normal());
        held_out.map_m = static_cast<float>(3.0 + map_error_m);
        held_out.confidence = 0.95f;
        held_out.kept = true;
        beams.push_back(held_out);
      }
    }
  }
  return beams;
}

// Quantiles of |z|: 1.282 and 1.960. 600 pairs of lines tell them to 5 %.
TEST(SummariseHeldOut, TheMapsOwnErrorIsWithoutTheBeamsNoise) {
  const auto beams = LinePairs(0.003, 0.0, 0.006);
  const DepthCheck check = SummariseHeldOut(beams, beams, {}, DepthMethod::kForesight, {});
  EXPECT_NEAR(check.all.q80_m, 1.282 * std::hypot(0.003, 0.006), 0.0003);
  EXPECT_NEAR(check.map_q80_m, 1.282 * 0.003, 0.15 * 1.282 * 0.003);
  EXPECT_NEAR(check.map_q95_m, 1.960 * 0.003, 0.15 * 1.960 * 0.003);
}

TEST(SummariseHeldOut, WhatAWholeLineIsOffByIsNoErrorOfTheMap) {
  const auto beams = LinePairs(0.003, 0.003, 0.006);
  const DepthCheck check = SummariseHeldOut(beams, beams, {}, DepthMethod::kForesight, {});
  EXPECT_NEAR(check.map_q80_m, 1.282 * 0.003, 0.15 * 1.282 * 0.003);
  EXPECT_NEAR(check.map_q95_m, 1.960 * 0.003, 0.15 * 1.960 * 0.003);
}

TEST(SummariseHeldOut, LargeNoiseIsNoErrorOfTheMap) {
  const auto beams = LinePairs(0.006, 0.0, 0.025);  // four beams differ by 50 mm and more
  const DepthCheck check = SummariseHeldOut(beams, beams, {}, DepthMethod::kForesight, {});
  EXPECT_NEAR(check.map_q80_m, 1.282 * 0.006, 0.25 * 1.282 * 0.006);
  EXPECT_NEAR(check.map_q95_m, 1.960 * 0.006, 0.25 * 1.960 * 0.006);
}

TEST(JudgeScan, AFewBeamsSayNothingOfTheDepth) {
  auto beams = Beams(0.95, 0.5);
  beams.resize(90);
  const DepthCheck depth = SummariseHeldOut(beams, beams, {}, DepthMethod::kForesight, {});
  EXPECT_EQ(depth.state, DepthCheck::State::kNotSeen);
  EXPECT_THAT(
      Judged(depth, Rig(Camera(0.03, 0.02))).points.at(4).sentence,
      StartsWith("depth: of 180 beams held out 180 lie where the mask keeps the map, too few"));
}

TEST(JudgeScan, AnObjectThatDiffersBetweenHalvesIsTold) {
  HalfFits object;
  object.state = HalfFits::State::kDiffer;
  object.what = "4 spokes, rim 240 mm across";
  object.differences = {{"along z", 0.0062, 0.0015, false}};
  const ScanCheck check = Judged(Depth(0.95, 0.98), Rig(Camera(0.03, 0.02)), {object});
  EXPECT_EQ(check.light, CheckLight::kAmber);
  EXPECT_THAT(check.advice,
              StartsWith("4 spokes, rim 240 mm across: even and odd lines differ along z: 6.2 mm, "
                         "4.1 deviations of 1.5 mm"));
}

TEST(JudgeScan, TheCalibrationComesFirstAndTheOthersAreCounted) {
  const ScanCheck check = Judged(Depth(0.95, 0.85), Rig(Camera(0.39, 0.02)));
  EXPECT_THAT(check.advice, StartsWith("image edges lie 4.1 px right"));
  EXPECT_THAT(check.advice, EndsWith("(and 1 more)"));
}

TEST(JudgeScan, SaysWhatNoScanSees) {
  const ScanCheck check = Judged(Depth(0.95, 0.98), Rig(Camera(0.03, 0.02)));
  EXPECT_THAT(check.cannot_see, testing::Contains(HasSubstr("motor's zero")));
}

TEST(JudgeScan, AScanThatSaysNothingIsNotGood) {
  const Result<DepthCheck> none = Fail(ErrorCode::kTooFewPoints, "the scan has no image");
  const ScanCheck check = Judged(none, Rig(Fail(ErrorCode::kTooFewPoints, "no image")));
  EXPECT_EQ(check.light, CheckLight::kNotSeen);
  EXPECT_THAT(check.advice, StartsWith("nothing can be said"));
}

TEST(GatherRig, ManyScansTellWhatOneDoesNot) {
  // Of one scan 0.1 deg of deviation is no ground to say anything.
  const RigCheck one = Rig(Camera(0.3, 0.1));
  EXPECT_THAT(one.drifted, IsEmpty());
  const std::vector<RigCheck> checks(9, one);
  const RigCheck all = GatherRig(checks, DefaultSensorRig(), {});
  EXPECT_THAT(all.drifted,
              testing::Contains(HasSubstr("camera's y axis: off by 0.30 deg +- 0.03")));
}

TEST(GatherRig, ScansThatDisagreeSayLess) {
  const std::vector<RigCheck> checks = {Rig(Camera(0.5, 0.02)), Rig(Camera(-0.5, 0.02))};
  const RigCheck all = GatherRig(checks, DefaultSensorRig(), {});
  ASSERT_TRUE(all.camera);
  // A deviation of 0.5 deg over the root of two scans.
  EXPECT_GT(all.camera->Sigma(1), RadiansFromDegrees(0.15));
}

TEST(GatherRig, KeepsTheReasonWhereNoScanSawAnything) {
  const std::vector<RigCheck> checks = {Rig(Fail(ErrorCode::kTooFewPoints, "no image"))};
  EXPECT_EQ(GatherRig(checks, DefaultSensorRig(), {}).no_camera, "no image");
}

}  // namespace
}  // namespace foresight
