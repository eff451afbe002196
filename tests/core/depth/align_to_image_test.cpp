#include <gtest/gtest.h>

#include "core/depth/aligned_samples.h"
#include "tests/support/swept_plane.h"

namespace foresight {
namespace {

TEST(AlignToImage, DepthIsAlongTheCamerasAxis) {
  // A wall square to the camera at motor angle 0 has one depth everywhere, however far aside a
  // pixel is.
  const Scan scan = SweptPlane({Eigen::Vector3d::UnitZ(), 2.0}, -20, 20, 40);
  const auto registered = RegisterScan(scan, {});
  const auto aligned = AlignToImage(*registered, scan.rig, 0.0, {});
  ASSERT_TRUE(aligned);
  // The camera sits 40 mm in front of the axis.
  for (const auto& sample : aligned->samples) ASSERT_NEAR(sample.depth_m, 1.96, 0.001);
}

TEST(AlignToImage, EverySampleProjectsToItsPixel) {
  const Scan scan = SweptPlane({Eigen::Vector3d(0, 0.3, 1).normalized(), 1.5}, -20, 20, 80);
  const auto registered = RegisterScan(scan, {});
  const auto aligned = AlignToImage(*registered, scan.rig, RadiansFromDegrees(10), {});
  ASSERT_TRUE(aligned);
  ASSERT_TRUE(aligned->Check());
  for (const auto& sample : aligned->samples) {
    const auto pixel = scan.rig.camera.Project(sample.point.cast<double>());
    ASSERT_NEAR(pixel->x(), sample.u, 1e-3);
    ASSERT_NEAR(pixel->y(), sample.v, 1e-3);
  }
}

TEST(AlignToImage, ASampleThatRoundsOntoTheEdgeIsLeftOut) {
  const Scan scan = SweptPlane({Eigen::Vector3d::UnitZ(), 2.0}, -20, 20, 40);
  const auto registered = RegisterScan(scan, {});
  SensorRig rig = scan.rig;
  const auto before = AlignToImage(*registered, rig, 0.0, {});
  ASSERT_TRUE(before);
  const auto pixel = rig.camera.Project(before->samples.front().point.cast<double>());
  // A float next to 1287.5 is 0.0001 px away: this one rounds to the edge itself.
  rig.camera.cx += rig.camera.width - 0.5 - 1e-5 - pixel->x();
  const auto aligned = AlignToImage(*registered, rig, 0.0, {});
  ASSERT_TRUE(aligned);
  EXPECT_TRUE(aligned->Check());
}

TEST(AlignToImage, HandsOutTheCamerasRays) {
  const Scan scan = SweptPlane({Eigen::Vector3d(0, 0.3, 1).normalized(), 1.5}, -20, 20, 80);
  const auto registered = RegisterScan(scan, {});
  const auto aligned = AlignToImage(*registered, scan.rig, 0.0, {});
  ASSERT_TRUE(aligned);
  EXPECT_EQ(aligned->rays, RaysOf(scan.rig.camera));
}

TEST(AlignToImage, TheImageLooksUpWithThePlate) {
  const Scan scan = SweptPlane({Eigen::Vector3d::UnitZ(), 2.0}, -20, 20, 40);
  const auto registered = RegisterScan(scan, {});
  const auto mean_v = [&](double motor_deg) {
    const auto aligned = AlignToImage(*registered, scan.rig, RadiansFromDegrees(motor_deg), {});
    double sum = 0.0;
    for (const auto& sample : aligned->samples) sum += sample.v;
    return sum / static_cast<double>(aligned->samples.size());
  };
  // Looking up, the same wall lies lower in the image: v grows downwards.
  EXPECT_GT(mean_v(15), mean_v(0) + 100);
}

TEST(AlignToImage, SaysWhenTheImageSeesNothing) {
  const Scan scan = SweptPlane({Eigen::Vector3d::UnitZ(), 2.0}, -2, 2, 40);
  const auto registered = RegisterScan(scan, {});
  const auto aligned = AlignToImage(*registered, scan.rig, RadiansFromDegrees(-89), {});
  ASSERT_FALSE(aligned);
  EXPECT_EQ(aligned.error().code, ErrorCode::kTooFewPoints);
}

}  // namespace
}  // namespace foresight
