#include "core/registration/register_scan.h"

#include <gtest/gtest.h>

#include "tests/support/swept_plane.h"

namespace foresight {
namespace {

const Plane kRegisteredWall{Eigen::Vector3d::UnitZ(), 2.0};  // two metres ahead, in base

double WorstDistance(const RegisteredScan& scan, const Plane& plane) {
  double worst = 0.0;
  for (int line = 0; line < scan.lines; ++line)
    for (int beam = 0; beam < scan.beams; ++beam)
      if (scan.Valid(line, beam))
        worst = std::max(
            worst, std::abs(plane.Distance(scan.points[scan.Index(line, beam)].cast<double>())));
  return worst;
}

TEST(RegisterScan, AWallStaysFlatWhileThePlateTurnsFast) {
  // At 60 deg/s the plate turns 1.1 deg within a line; one angle a line would bend the wall by
  // centimetres.
  const auto scan = RegisterScan(SweptPlane(kRegisteredWall, -20, 20, 60), {});
  ASSERT_TRUE(scan);
  // Ranges are rounded to 1 mm; float points add 1e-6.
  EXPECT_LT(WorstDistance(*scan, kRegisteredWall), 0.00051);
}

TEST(RegisterScan, KeepsTheGridOfLinesAndBeams) {
  const Scan scan = SweptPlane(kRegisteredWall, -5, 5, 20);
  const auto registered = RegisterScan(scan, {});
  ASSERT_TRUE(registered);
  EXPECT_EQ(registered->lines, static_cast<int>(scan.lines.size()));
  EXPECT_EQ(registered->beams, 1081);
  // Beams that look away from the wall have no return.
  EXPECT_FALSE(registered->Valid(0, 0));
  EXPECT_TRUE(std::isnan(registered->points[registered->Index(0, 0)].x()));
  EXPECT_TRUE(registered->Valid(0, 540));
}

TEST(RegisterScan, AddsTheCalibratedRangeOffset) {
  Scan scan = SweptPlane(kRegisteredWall, -1, 1, 20);
  const auto before = RegisterScan(scan, {});
  scan.rig.lidar.range_offset_m = 0.05;
  const auto after = RegisterScan(scan, {});
  EXPECT_NEAR(after->range_m[after->Index(2, 540)] - before->range_m[before->Index(2, 540)], 0.05,
              1e-6);
}

TEST(RegisterScan, UsesTheAngleCorrection) {
  Scan scan = SweptPlane(kRegisteredWall, -20, 20, 20);
  const double shift = RadiansFromDegrees(1.0);
  scan.rig.angle_correction =
      AngleCorrection::FromKnots({{-1.0, -1.0 + shift}, {1.0, 1.0 + shift}}).value();
  const auto registered = RegisterScan(scan, {});
  // The whole wall turns with the plate by the correction: at its upper edge, 0.7 m up, one degree
  // is 12 mm.
  EXPECT_GT(WorstDistance(*registered, kRegisteredWall), 0.01);
  const Eigen::Matrix3d turn = HeadFromBase(shift).Inverse().RotationMatrix();
  EXPECT_LT(WorstDistance(*registered, {turn * kRegisteredWall.normal, kRegisteredWall.offset}),
            0.00051);
}

TEST(RegisterScan, LeavesOutLinesWithoutAMotorAngle) {
  Scan scan = SweptPlane(kRegisteredWall, -5, 5, 20);
  std::vector<MotorSample> early;
  for (const auto& sample : scan.track.samples())
    if (sample.time_s < 0.25) early.push_back(sample);
  scan.track = MotorTrack::FromSamples(early).value();
  const auto registered = RegisterScan(scan, {});
  ASSERT_TRUE(registered);
  EXPECT_TRUE(registered->Valid(5, 540));
  EXPECT_FALSE(registered->Valid(15, 540));
}

TEST(RegisterScan, RefusesLinesOfAnotherLidar) {
  Scan scan = SweptPlane(kRegisteredWall, -1, 1, 20);
  scan.lines.Edit(1).range_mm.pop_back();
  const auto registered = RegisterScan(scan, {});
  ASSERT_FALSE(registered);
  EXPECT_EQ(registered.error().code, ErrorCode::kInvalidInput);
  EXPECT_NE(registered.error().message.find("line 1: 1080 beams"), std::string::npos);
}

TEST(RegisterScan, AnEmptyScanHasTooFewPoints) {
  Scan scan = SweptPlane(kRegisteredWall, -1, 1, 20);
  scan.lines.clear();
  EXPECT_EQ(RegisterScan(scan, {}).error().code, ErrorCode::kTooFewPoints);
}

TEST(RegisterScan, CanBeCancelled) {
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  EXPECT_EQ(RegisterScan(SweptPlane(kRegisteredWall, -1, 1, 20), context).error().code,
            ErrorCode::kCancelled);
}

}  // namespace
}  // namespace foresight
