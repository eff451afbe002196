// What a plan promises, against what a simulated head brings home.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/depth/aligned_samples.h"
#include "core/registration/register_scan.h"
#include "hardware/simulated/simulated_head.h"
#include "tests/hardware/tiny_head.h"

namespace foresight {
namespace {

constexpr int kLineTolerance = 2;

ScanPlan WidePlan() {
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(-20.0);
  plan.to_rad = RadiansFromDegrees(25.0);
  plan.speed_rad_s = RadiansFromDegrees(15.0);
  plan.image_angles_rad = {RadiansFromDegrees(-15.0), RadiansFromDegrees(3.0),
                           RadiansFromDegrees(20.0)};
  return plan;
}

std::shared_ptr<const Scan> Execute(const ScanPlan& plan) {
  TinyHead tiny;
  return tiny.Home() ? tiny.Run(plan) : nullptr;
}

/// From the first line to the last line or image.
double ExecutedSeconds(const Scan& scan) {
  double end_s = scan.lines.back().time_s;
  for (const CameraFrame& frame : scan.frames) end_s = std::max(end_s, frame.time_s);
  return end_s - scan.lines.front().time_s;
}

struct Variant {
  const char* name;
  int passes;
  ScanPlan::ImageMode mode;
};

class PlannedScan : public testing::TestWithParam<Variant> {};

TEST_P(PlannedScan, TakesAsLongAndBringsAsManyLinesAsPredicted) {
  ScanPlan plan = WidePlan();
  plan.passes = GetParam().passes;
  plan.image_mode = GetParam().mode;
  for (const bool downwards : {false, true}) {
    if (downwards) std::swap(plan.from_rad, plan.to_rad);
    const auto scan = Execute(plan);
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->state, ScanState::kComplete) << scan->reason;
    EXPECT_EQ(scan->frames.size(), 3u);
    const ScanPrediction predicted = PredictScan(plan, TinyRig()).value();
    EXPECT_NEAR(ExecutedSeconds(*scan), predicted.duration_s, 0.05 * predicted.duration_s);
    EXPECT_NEAR(static_cast<int>(scan->lines.size()), predicted.lines, kLineTolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(
    AllPlans, PlannedScan,
    testing::Values(Variant{"OneWay", 1, ScanPlan::ImageMode::kOnTheFly},
                    Variant{"ThereAndBack", 2, ScanPlan::ImageMode::kOnTheFly},
                    Variant{"OneWayStopAndShoot", 1, ScanPlan::ImageMode::kStopAndShoot},
                    Variant{"ThereAndBackStopAndShoot", 2, ScanPlan::ImageMode::kStopAndShoot}),
    [](const auto& variant) { return variant.param.name; });

TEST(CaptureHead, TwoPassesGoThereAndBackInOneScan) {
  ScanPlan plan = TinyPlan();
  plan.passes = 2;
  const auto scan = Execute(plan);
  ASSERT_TRUE(scan);
  const auto angle = [&](const LidarLine& line) {
    return DegreesFromRadians(scan->track.AngleAt(line.time_s));
  };
  const std::size_t half = scan->lines.size() / 2;
  for (std::size_t i = 1; i + 1 < scan->lines.size(); ++i) {
    EXPECT_GT(scan->lines[i].seq, scan->lines[i - 1].seq);
    // 0.25 deg a line; the encoder's step leaves a third of its 0.02 deg.
    const double step = angle(scan->lines[i]) - angle(scan->lines[i - 1]);
    const bool turning = i + 1 >= half && i <= half + 1;
    if (!turning) {
      EXPECT_NEAR(step, i < half ? 0.25 : -0.25, 0.015) << i;
    }
  }
  EXPECT_NEAR(angle(scan->lines.front()), angle(scan->lines.back()), 0.5);
  EXPECT_EQ(scan->frames.size(), 1u) << "images are taken once";
}

TEST(CaptureHead, StopAndShootTakesItsImagesStandingAtTheirAngles) {
  ScanPlan plan = WidePlan();
  plan.image_mode = ScanPlan::ImageMode::kStopAndShoot;
  plan.exposure_s = 0.05;  // five pixels of blur, in passing
  const auto scan = Execute(plan);
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->frames.size(), 3u);
  for (const CameraFrame& frame : scan->frames) {
    EXPECT_EQ(frame.exposure_s, 0.05);
    EXPECT_GT(frame.time_s, scan->lines.back().time_s);
    EXPECT_NEAR(DegreesFromRadians(frame.motor_angle_rad),
                DegreesFromRadians(frame.target_angle_rad), 0.03);
    EXPECT_NEAR(scan->track.AngleAt(frame.time_s - 0.03), scan->track.AngleAt(frame.time_s + 0.03),
                1e-12);
  }
}

TEST(CaptureHead, OnTheFlyTheExposureIsCappedByTheBlur) {
  ScanPlan plan = TinyPlan();
  plan.exposure_s = 0.5;
  plan.max_blur_px = 0.3;
  const auto scan = Execute(plan);
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->frames.size(), 1u);
  // 20 px a radian at 10 deg/s.
  const double cap_s = 0.3 / (20.0 * RadiansFromDegrees(10.0));
  EXPECT_NEAR(scan->frames[0].exposure_s, cap_s, 1e-9);
  EXPECT_EQ(scan->plan.exposure_s, 0.5) << "the plan says what was asked for";
  EXPECT_EQ(PredictScan(plan, TinyRig())->exposure_s, scan->frames[0].exposure_s);
}

/// A wall at 5 m before a head with a long lens, whose pixels are nearly all alike.
Result<std::unique_ptr<SensorHead>> HeadBeforeAWall(SensorRig* rig) {
  auto scene = std::make_shared<Scene>();
  scene->name = "wall";
  SceneMesh wall;
  wall.vertices = {{5, -9, -9}, {5, 9, -9}, {5, 9, 9}, {5, -9, 9}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene->meshes = {wall};
  scene->lights = {Light()};
  *rig = DefaultSensorRig();
  rig->camera = PinholeCamera(320, 240, 600.0, 159.5, 119.5);
  SimulatedHeadOptions options;
  options.true_rig = options.believed_rig = *rig;
  options.speed = SimulationSpeed::kAsFastAsPossible;
  return MakeSimulatedHead(scene, options);
}

/// Samples a pixel in the middle of the image.
double MeasuredDensity(const Scan& scan) {
  const RunContext context;
  const RegisteredScan points = RegisterScan(scan, context).value();
  const AlignedSamples samples =
      AlignToImage(points, scan.rig, scan.frames.at(0).motor_angle_rad, context).value();
  constexpr double kHalf_px = 80.0;
  const auto central = [](const AlignedSample& sample) {
    return std::abs(sample.u - 159.5) < kHalf_px && std::abs(sample.v - 119.5) < kHalf_px;
  };
  return static_cast<double>(
             std::count_if(samples.samples.begin(), samples.samples.end(), central)) /
         (4.0 * kHalf_px * kHalf_px);
}

TEST(PredictScan, TheDensityIsThatOfAnExecutedScan) {
  for (const int passes : {1, 2}) {
    SensorRig rig;
    const auto head = HeadBeforeAWall(&rig).value();
    ScanPlan plan;
    plan.from_rad = RadiansFromDegrees(-15.0);
    plan.to_rad = RadiansFromDegrees(15.0);
    plan.speed_rad_s = RadiansFromDegrees(20.0);
    plan.passes = passes;
    const auto wait = [&](HeadState state) {
      while (head->Status().state != state) std::this_thread::yield();
    };
    ASSERT_TRUE(head->Home());
    wait(HeadState::kReady);
    const auto assembler = std::make_shared<ScanAssembler>();
    ASSERT_TRUE(head->StartScan(plan, assembler));
    wait(HeadState::kReady);
    const auto scan = assembler->Snapshot();
    ASSERT_EQ(scan->frames.size(), 1u) << scan->reason;
    const double predicted = PredictScan(plan, rig)->density;
    EXPECT_NEAR(MeasuredDensity(*scan), predicted, 0.1 * predicted) << passes << " passes";
  }
}

}  // namespace
}  // namespace foresight
