#include "core/evaluation/other_drill_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/evaluation/other_tool.h"
#include "core/evaluation/other_world.h"
#include "core/geometry/angles.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Robot, frame::Object>;

constexpr std::uint64_t kOtherDrillStream = 91002;

Pose UprightPose(const Eigen::Vector3d& position, double yaw_rad) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())), position};
}

void AddSolid(const char* name, const Shape& shape, const Pose& pose, Random& random,
              Scene& scene) {
  SceneMesh mesh;
  mesh.name = name;
  mesh.material = OtherMaterial(random);
  mesh.robot_from_object = pose;
  AppendShape(shape, pose, mesh);
  scene.meshes.push_back(std::move(mesh));
}

/// A bench or a table, a floor, and what else lies there, beside and behind the tool.
void AddBench(const Eigen::Vector3d& foot, double azimuth_rad, Random& random, Scene& scene) {
  const Eigen::Vector3d away(std::cos(azimuth_rad), std::sin(azimuth_rad), 0.0);
  const Eigen::Vector3d left(-away.y(), away.x(), 0.0);
  const double front = random.Uniform(0.08, 0.5), depth = front + random.Uniform(0.2, 0.9);
  const double thick = random.Uniform(0.015, 0.08);
  AddSolid("bench", BoxShape({depth, random.Uniform(0.6, 2.5), thick}),
           UprightPose(foot + (0.5 * depth - front) * away - 0.5 * thick * Eigen::Vector3d::UnitZ(),
                       azimuth_rad + random.Uniform(-0.5, 0.5)),
           random, scene);
  // At z = 0, or under the bench where that is lower.
  const double floor_m = std::min(0.0, foot.z() - thick);
  AddSolid("floor", BoxShape({14.0, 14.0, 0.1}), UprightPose({0.0, 0.0, floor_m - 0.05}, 0.0),
           random, scene);
  const int count = random.Index(5);
  for (int i = 0; i < count; ++i) {
    const double side = random.Chance(0.5) ? 1.0 : -1.0;
    const Eigen::Vector3d at =
        foot + random.Uniform(-0.10, 0.35) * away + side * random.Uniform(0.18, 0.45) * left;
    const double high = random.Uniform(0.01, 0.30), radius = random.Uniform(0.01, 0.06);
    const Pose pose = UprightPose(at + 0.5 * high * Eigen::Vector3d::UnitZ(),
                                  random.Uniform(-std::numbers::pi, std::numbers::pi));
    if (random.Chance(0.5))
      AddSolid("clutter", CylinderShape(radius, high), pose, random, scene);
    else
      AddSolid("clutter", BoxShape({2.0 * radius, random.Uniform(0.02, 0.25), high}), pose, random,
               scene);
  }
}

/// Stands the tool where its grip's axis meets `foot`; returns the truth that it would be as a
/// drill.
DrillTruth Stand(const OtherTool& tool, const Eigen::Vector3d& foot, double yaw_rad, Scene& scene) {
  const Eigen::Vector3d along = (tool.grip_high_m - tool.grip_low_m).normalized();
  const double origin_x = tool.grip_low_m.x() - tool.grip_low_m.z() * along.x() / along.z();
  DrillTruth truth;
  truth.name = tool.name;
  truth.robot_from_object = UprightPose(foot, yaw_rad);
  truth.body_tilt_rad = {0.0, std::atan2(along.x(), along.z())};
  truth.grip_height_m = 0.5 * (tool.grip_low_m + tool.grip_high_m).z() / along.z();
  const Pose robot_from_tool =
      truth.robot_from_object *
      Rigid<frame::Object, frame::Object>(Eigen::Quaterniond::Identity(), {-origin_x, 0.0, 0.0});
  for (SceneMesh part : tool.parts) {
    for (Eigen::Vector3f& vertex : part.vertices)
      vertex = (robot_from_tool * vertex.cast<double>()).cast<float>();
    part.robot_from_object = robot_from_tool;
    scene.meshes.push_back(std::move(part));
  }
  return truth;
}

}  // namespace

FitTrialScene OtherDrillScene(std::uint64_t seed) {
  constexpr double kMiddle_m = 0.12;
  Random random(seed, kOtherDrillStream);
  FitTrialScene trial;
  const bool meant = random.Chance(0.78);
  const OtherTool tool = meant ? DrawDrill(random) : DrawOtherTool(random);
  trial.positive = MeasureTool(tool).IsDrill();
  trial.what = tool.name;
  if (meant != trial.positive)
    trial.what += trial.positive ? ", by its shape a drill" : ", by its shape no drill";
  const double distance = random.Uniform(0.6, 2.2), azimuth = random.Uniform(-0.4, 0.4);
  const double elevation = -RadiansFromDegrees(random.Uniform(3.0, 45.0));
  const Eigen::Vector3d sight(std::cos(elevation) * std::cos(azimuth),
                              std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const Eigen::Vector3d middle = OtherHead() + distance * sight;
  const Eigen::Vector3d foot = middle - kMiddle_m * Eigen::Vector3d::UnitZ();

  auto scene = std::make_shared<Scene>();
  scene->lights.push_back(
      {{random.Uniform(-0.5, 0.8), random.Uniform(-2.0, 2.0), 2.8}, random.Uniform(0.5, 2.0)});
  scene->ambient = random.Uniform(0.15, 0.6);
  AddBench(foot, azimuth, random, *scene);
  const Eigen::Vector3d away(std::cos(azimuth), std::sin(azimuth), 0.0);
  const double behind = random.Chance(0.6) ? random.Uniform(0.2, 0.9) : random.Uniform(2.0, 4.0);
  AddOtherWall(middle + behind * away,
               Eigen::AngleAxisd(random.Uniform(-0.5, 0.5), Eigen::Vector3d::UnitZ()) * -away, 0.25,
               random, *scene);
  const std::size_t first = scene->meshes.size();
  const DrillTruth truth =
      Stand(tool, foot, random.Uniform(-std::numbers::pi, std::numbers::pi), *scene);
  if (trial.positive) scene->drills.push_back(truth);
  AddObjectPoints(*scene, first, trial);
  trial.focus_m = middle;
  trial.focus_radius_m = 0.17;
  AddOccluders(middle, trial.focus_radius_m, random, *scene);
  SetOtherConditions(random, trial);
  scene->name = trial.what;
  trial.scene = scene;
  trial.plan = OtherPlan(elevation, trial.focus_radius_m / distance, 5.0, random);
  return trial;
}

}  // namespace foresight
