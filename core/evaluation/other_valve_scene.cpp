#include "core/evaluation/other_valve_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/evaluation/other_wheel.h"
#include "core/evaluation/other_world.h"
#include "core/geometry/angles.h"
#include "core/simulation/scene_objects.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Robot, frame::Object>;
using LocalPose = Rigid<frame::Object, frame::Object>;

constexpr std::uint64_t kOtherValveStream = 91001;

/// A bent strip of sheet with a rounded boss on its pivot.
ValveTruth AddFlatLever(const Pose& pose, Random& random, Scene& scene) {
  ValveTruth truth;
  truth.name = "lever";
  truth.robot_from_object = pose;
  truth.model.kind = ValveModel::Kind::kLever;
  truth.model.lever_length_m = random.Uniform(0.11, 0.28);
  truth.model.tube_radius_m = random.Uniform(0.010, 0.017);
  truth.model.hub_radius_m = random.Uniform(0.014, 0.026);
  const double half = truth.model.tube_radius_m, thick = random.Uniform(0.002, 0.005);
  const std::vector<Eigen::Vector2d> section = {
      {-half, -thick}, {half, -thick}, {half, thick}, {-half, thick}};
  const double bend = random.Uniform(-0.03, 0.03);
  std::vector<Eigen::Vector3d> path;
  for (const double t : {-0.04, 0.0, 0.25, 0.4, 0.7, 1.0})
    path.emplace_back(t * truth.model.lever_length_m, 0.0, t > 0.3 ? bend : 0.0);
  SceneMesh mesh = OtherMeshAt("lever", pose, OtherMaterial(random));
  AppendShape(SweptShape(section, path, Eigen::Vector3d::UnitZ()), pose, mesh);
  AppendShape(CylinderShape(truth.model.hub_radius_m, 0.02), pose, mesh);
  scene.meshes.push_back(std::move(mesh));
  return truth;
}

/// Stem, yoke and flanges between a wheel's hub and the pipe that the valve sits in.
void AddBody(const Pose& pose, double hub_z, double wall_m, double radius_m, Random& random,
             Scene& scene) {
  SceneMesh body = OtherMeshAt("valve body", pose, OtherMaterial(random));
  const auto bar = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
    AppendShape(CylinderShape(radius, (to - from).norm()), pose * PoseAlong(from, to), body);
  };
  const double back = -wall_m, bonnet = hub_z + 0.45 * (back - hub_z);
  bar({0.0, 0.0, back}, {0.0, 0.0, hub_z}, random.Uniform(0.006, 0.016));
  bar({0.0, 0.0, back}, {0.0, 0.0, bonnet}, random.Uniform(0.02, 0.05));
  if (random.Chance(0.4))
    for (const double side : {-1.0, 1.0})
      bar({side * 0.4 * radius_m, 0.0, back},
          {side * 0.03, 0.0, std::min(hub_z - 0.01, 0.5 * hub_z + 0.5 * bonnet)}, 0.008);
  const double turn = random.Uniform(-std::numbers::pi, std::numbers::pi),
               pipe = random.Uniform(0.02, 0.06);
  const Eigen::Vector3d along(std::cos(turn), std::sin(turn), 0.0);
  const Eigen::Vector3d middle(0.0, 0.0, back + 0.5 * pipe);
  if (random.Chance(0.6)) {
    bar(middle - 1.5 * along, middle + 1.5 * along, pipe);
    for (const double side : {-1.0, 1.0})
      bar(middle + side * 0.10 * along, middle + side * 0.12 * along, 1.7 * pipe);
  }
  scene.meshes.push_back(std::move(body));
}

Eigen::Vector3d TiltedFrom(const Eigen::Vector3d& direction, double angle, Random& random) {
  const Eigen::AngleAxisd side(random.Uniform(-std::numbers::pi, std::numbers::pi), direction);
  return Eigen::AngleAxisd(angle, side * direction.unitOrthogonal()) * direction;
}

/// Adds the wheel, measured; its truth where it is a handwheel.
void AddWheel(const OtherWheel& drawn, const Pose& pose, Random& random, FitTrialScene& trial,
              Scene& scene) {
  const Shape shape = ShapeOf(drawn);
  const WheelMeasures measures = MeasureWheel(shape);
  SceneMesh mesh = OtherMeshAt("wheel", pose, OtherMaterial(random));
  AppendShape(shape, pose, mesh);
  scene.meshes.push_back(std::move(mesh));
  trial.positive = measures.IsHandwheel();
  trial.what = drawn.name;
  if (!trial.positive) return;
  ValveTruth truth;
  truth.name = drawn.name;
  truth.robot_from_object =
      pose * LocalPose(Eigen::Quaterniond(
                           Eigen::AngleAxisd(measures.first_spoke_rad, Eigen::Vector3d::UnitZ())),
                       Eigen::Vector3d::Zero());
  truth.model.rim_radius_m = measures.radius_m;
  truth.model.tube_radius_m = 0.5 * std::min(drawn.rim_m.x(), drawn.rim_m.y());
  truth.model.spokes = measures.spokes;
  truth.model.hub_radius_m = drawn.hub_radius_m;
  truth.model.dish_m = drawn.dish_m;
  const bool flat =
      drawn.rim == OtherWheel::Section::kFlatBar || drawn.rim == OtherWheel::Section::kUprightBar;
  trial.what =
      fmt::format("{} of {} spokes{}", drawn.name, measures.spokes, flat ? ", flat rim" : "");
  scene.valves.push_back(std::move(truth));
}

}  // namespace

FitTrialScene OtherValveScene(std::uint64_t seed) {
  Random random(seed, kOtherValveStream);
  FitTrialScene trial;
  const double kind = random.Uniform();
  const OtherWheel drawn = kind < 0.25 ? DrawRoundThing(random) : DrawWheel(random);
  const bool lever = kind > 0.93;
  const double azimuth = random.Uniform(-0.4, 0.4), elevation = random.Uniform(-0.4, 0.3);
  const Eigen::Vector3d sight(std::cos(elevation) * std::cos(azimuth),
                              std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const double nearest = 0.6, farthest = drawn.radius_m < 0.095 ? 1.3 : 2.3;
  const double distance = random.Uniform(nearest, farthest);
  const Eigen::Vector3d place = OtherHead() + distance * sight;
  const Eigen::Vector3d axis =
      TiltedFrom(-sight, RadiansFromDegrees(random.Uniform(0.0, 45.0)), random);
  const Pose pose = ValvePose(place, axis, random.Uniform(-std::numbers::pi, std::numbers::pi));
  const double hub_z = lever ? 0.0 : -drawn.dish_m;
  const double wall_m = std::max(0.03 - hub_z, random.Uniform(0.05, 0.40));

  auto scene = std::make_shared<Scene>();
  scene->lights.push_back(
      {{random.Uniform(-0.5, 0.8), random.Uniform(-2.0, 2.0), 2.8}, random.Uniform(0.5, 2.0)});
  scene->ambient = random.Uniform(0.15, 0.6);
  const double radius = lever ? 0.2 : drawn.radius_m;
  AddOtherWall(place + 3.5 * sight, -sight, 0.0, random, *scene);
  if (random.Chance(0.8))
    AddOtherWall(place - wall_m * axis,
                 TiltedFrom(axis, RadiansFromDegrees(std::abs(8.0 * random.Normal())), random),
                 radius, random, *scene);
  AddBody(pose, hub_z, wall_m, radius, random, *scene);
  const std::size_t first = scene->meshes.size();
  trial.focus_m = place;
  trial.focus_radius_m = radius;
  if (lever) {
    scene->valves.push_back(AddFlatLever(pose, random, *scene));
    trial.what = "flat lever";
    const double length = scene->valves.front().model.lever_length_m;
    trial.focus_m = pose * Eigen::Vector3d(0.5 * length, 0.0, 0.0);
    trial.focus_radius_m = 0.5 * length + 0.02;
  } else {
    AddWheel(drawn, pose, random, trial, *scene);
  }
  AddObjectPoints(*scene, first, trial);
  AddOccluders(trial.focus_m, trial.focus_radius_m, random, *scene);
  SetOtherConditions(random, trial);
  scene->name = trial.what;
  trial.scene = scene;
  trial.plan = OtherPlan(elevation, trial.focus_radius_m / distance, 4.0, random);
  return trial;
}

}  // namespace foresight
