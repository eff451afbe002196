#include "core/detection/image_of_region.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/fitting/solids/image_edges.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

CameraFrame Frame(double motor_deg, bool noisy) {
  const CameraModel camera = DefaultSensorRig().camera;
  CameraFrame frame;
  frame.motor_angle_rad = RadiansFromDegrees(motor_deg);
  frame.image = ColorImage(camera.width, camera.height);
  Random random(3);
  if (noisy)
    for (Rgb8& pixel : frame.image.values())
      pixel = {static_cast<std::uint8_t>(random.Index(256)), 0, 0};
  return frame;
}

/// Rays that end where the image at `motor_deg` has its middle.
RaySet RaysInTheMiddleAt(double motor_deg) {
  const SensorRig rig = DefaultSensorRig();
  const auto base_from_camera = rig.CameraFromBase(RadiansFromDegrees(motor_deg)).Inverse();
  RaySet rays;
  for (const double x : {-0.1, 0.0, 0.1})
    for (const double y : {-0.1, 0.0, 0.1}) {
      const Eigen::Vector3d at = base_from_camera * Eigen::Vector3d(x, y, 1.5);
      rays.rays.push_back({Eigen::Vector3d::Zero(), at.normalized(), at.norm()});
    }
  return rays;
}

/// Noise has gradients everywhere, a black image none.
bool IsOfNoise(const ImageEdges& edges, double motor_deg) {
  const SensorRig rig = DefaultSensorRig();
  const auto base_from_camera = rig.CameraFromBase(RadiansFromDegrees(motor_deg)).Inverse();
  SolidPart box;
  box.size_m = {0.1, 0.1, 0.1};
  const Rigid<frame::Base, frame::Object> pose(Eigen::Quaterniond::Identity(),
                                               base_from_camera * Eigen::Vector3d(0.0, 0.0, 1.5));
  const OutlineSupport support = edges.SupportOf({&box, 1}, pose);
  EXPECT_GT(support.length_px, 50.0);
  return support.NatsPerPixel() > 0.9 * ImageEdges::NatsOf(0.0);
}

TEST(ImageOfRegion, IsTheOneThatItWasDrawnOn) {
  const RaySet rays = RaysInTheMiddleAt(-10.0);
  for (const bool first : {true, false}) {
    const SharedList<CameraFrame> frames = {Frame(-14.0, first), Frame(-6.0, !first)};
    const ImageRoi roi = ImageRoi::Rectangle(RadiansFromDegrees(-14.0), {500, 400}, {700, 600});
    const auto image = ImageOfRegion(frames, DefaultSensorRig(), roi, rays, 1.0);
    ASSERT_NE(image, nullptr);
    EXPECT_EQ(IsOfNoise(*image, -10.0), first);
  }
}

TEST(ImageOfRegion, OfABoxIsTheOneThatShowsItNearestToItsMiddle) {
  const RaySet rays = RaysInTheMiddleAt(-10.0);
  const BoxRoi box{{Eigen::Quaterniond::Identity(), rays.rays.front().Point()},
                   Eigen::Vector3d::Constant(0.5)};
  for (const bool near : {true, false}) {
    const SharedList<CameraFrame> frames = {Frame(-35.0, !near), Frame(-12.0, near),
                                            Frame(80.0, !near)};
    const auto image = ImageOfRegion(frames, DefaultSensorRig(), box, rays, 1.0);
    ASSERT_NE(image, nullptr);
    EXPECT_EQ(IsOfNoise(*image, -10.0), near);
  }
}

TEST(ImageOfRegion, IsNoneWhereNoImageShowsIt) {
  const RaySet rays = RaysInTheMiddleAt(-10.0);
  const BoxRoi box{{Eigen::Quaterniond::Identity(), rays.rays.front().Point()},
                   Eigen::Vector3d::Constant(0.5)};
  CameraFrame empty;  // a frame whose image was lost
  CameraFrame small = Frame(-10.0, true);
  small.image = ColorImage(64, 48);
  EXPECT_EQ(ImageOfRegion({}, DefaultSensorRig(), box, rays, 1.0), nullptr);
  EXPECT_EQ(ImageOfRegion({empty, small}, DefaultSensorRig(), box, rays, 1.0), nullptr);
  EXPECT_EQ(ImageOfRegion({Frame(170.0, true)}, DefaultSensorRig(), box, rays, 1.0), nullptr);
}

}  // namespace
}  // namespace foresight
