#include "core/evaluation/drawn_region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/simulation/noise_stream.h"

namespace foresight {
namespace {

Result<Roi> Checked(ImageRoi roi) {
  FORESIGHT_CHECK(roi.Check());
  return roi;
}

/// A circle: a little wider than the thing and not quite centred.
Result<Roi> Circle(const FitTrialScene& scene, const World& world, double motor_rad,
                   Random& random) {
  constexpr int kCorners = 24;
  constexpr double kLeastWider = 1.10, kMostWider = 1.35, kOffCentre = 0.08;
  const SensorRig& rig = world.true_rig();
  const Eigen::Vector3d focus =
      rig.CameraFromBase(motor_rad) * (world.BaseFromRobot() * scene.focus_m);
  const double radius = scene.focus_radius_m * random.Uniform(kLeastWider, kMostWider);
  const Eigen::Vector3d shift(scene.focus_radius_m * random.Uniform(-kOffCentre, kOffCentre),
                              scene.focus_radius_m * random.Uniform(-kOffCentre, kOffCentre), 0.0);
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(focus).normalized();
  const Eigen::Vector3d down = focus.cross(right).normalized();
  ImageRoi roi{motor_rad, {}};
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    const Eigen::Vector3d at =
        focus + shift + radius * (std::cos(angle) * right + std::sin(angle) * down);
    if (const auto pixel = rig.camera.Project(at); pixel && at.z() > 0.0)
      roi.polygon.push_back(*pixel);
  }
  return Checked(std::move(roi));
}

/// The corners of a cube stand for a thing that is not there.
std::vector<Eigen::Vector3d> PointsOf(const FitTrialScene& scene) {
  if (!scene.object_points.empty()) return scene.object_points;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 8; ++i)
    points.push_back(scene.focus_m + scene.focus_radius_m * Eigen::Vector3d(i & 1 ? 0.7 : -0.7,
                                                                            i & 2 ? 0.7 : -0.7,
                                                                            i & 4 ? 0.7 : -0.7));
  return points;
}

/// 1.0 to 2.2 times as wide and high as what is seen of the thing, its middle off by up to a
/// quarter of that.
Result<Roi> Rectangle(const FitTrialScene& scene, const World& world, double motor_rad,
                      Random& random) {
  const SensorRig& rig = world.true_rig();
  const auto camera_from_robot = rig.CameraFromBase(motor_rad) * world.BaseFromRobot();
  Eigen::AlignedBox2d seen;
  for (const Eigen::Vector3d& point : PointsOf(scene)) {
    const Eigen::Vector3d at = camera_from_robot * point;
    if (at.z() <= 0.0) continue;
    if (const auto pixel = rig.camera.Project(at)) seen.extend(*pixel);
  }
  if (seen.isEmpty())
    return Fail(ErrorCode::kInvalidInput, "{}: nothing of it is in the image", scene.what);
  const double wider = random.Uniform(1.0, 2.2);
  const Eigen::Vector2d half(
      0.5 * seen.sizes().x() * wider,
      0.5 * seen.sizes().y() * std::max(1.0, wider * random.Uniform(0.85, 1.15)));
  const Eigen::Vector2d shift(random.Uniform(-0.25, 0.25), random.Uniform(-0.25, 0.25));
  const Eigen::Vector2d middle = seen.center() + shift.cwiseProduct(seen.sizes());
  const Eigen::Vector2d last(rig.camera.width - 1, rig.camera.height - 1);
  return Checked(ImageRoi::Rectangle(
      motor_rad, (middle - half).cwiseMax(Eigen::Vector2d::Zero()).cwiseMin(last),
      (middle + half).cwiseMax(Eigen::Vector2d::Zero()).cwiseMin(last)));
}

/// A box along robot's axes, tightly round the thing.
Result<Roi> TightBox(const FitTrialScene& scene, const World& world, Random& random) {
  Eigen::AlignedBox3d around;
  for (const Eigen::Vector3d& point : PointsOf(scene)) around.extend(point);
  const double wider = random.Uniform(1.02, 1.20);
  const Eigen::Vector3d off(random.Uniform(-0.02, 0.02), random.Uniform(-0.02, 0.02),
                            random.Uniform(-0.02, 0.02));
  const Eigen::Vector3d center = around.center() + off.cwiseProduct(around.sizes());
  const auto base_from_box = world.BaseFromRobot() * Rigid<frame::Robot, frame::Object>(
                                                         Eigen::Quaterniond::Identity(), center);
  BoxRoi roi{base_from_box, (wider * around.sizes()).cwiseMax(0.02)};
  FORESIGHT_CHECK(roi.Check());
  return roi;
}

}  // namespace

Result<Roi> DrawnRegion(const FitTrialScene& scene, const World& world, double motor_rad,
                        std::uint64_t seed) {
  Random random = NoiseStream(seed, NoisePurpose::kDrawnRegion);
  switch (scene.region) {
    case FitTrialScene::Region::kCircle:
      return Circle(scene, world, motor_rad, random);
    case FitTrialScene::Region::kRectangle:
      return Rectangle(scene, world, motor_rad, random);
    case FitTrialScene::Region::kTightBox:
      return TightBox(scene, world, random);
  }
  return Circle(scene, world, motor_rad, random);
}

}  // namespace foresight
