#include "core/evaluation/other_handle_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/evaluation/other_door_thing.h"
#include "core/evaluation/other_world.h"
#include "core/geometry/angles.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Robot, frame::Object>;
using LocalPose = Rigid<frame::Object, frame::Object>;

constexpr std::uint64_t kSceneStream = 91004;
constexpr int kMostRedraws = 50;

void AddBox(const char* name, const Pose& door, const Eigen::Vector3d& low,
            const Eigen::Vector3d& high, const Material& material, Scene& scene) {
  SceneMesh mesh;
  mesh.name = name;
  mesh.material = material;
  mesh.robot_from_object = door * LocalPose(Eigen::Quaterniond::Identity(), 0.5 * (low + high));
  AppendShape(BoxShape(high - low), mesh.robot_from_object, mesh);
  scene.meshes.push_back(std::move(mesh));
}

/// A leaf with raised or sunk panels, its frame, and a wall with things on it further away.
void AddDoor(const Pose& door, double hand, Random& random, Scene& scene) {
  const double edge_m = random.Uniform(0.035, 0.11), leaf_m = random.Uniform(0.6, 1.1);
  const auto box = [&](const char* name, double from, double to, double low, double high,
                       double front_m, const Material& material) {
    AddBox(name, door, {std::min(hand * from, hand * to), low, front_m - 0.05},
           {std::max(hand * from, hand * to), high, front_m}, material, scene);
  };
  box("leaf", -edge_m, leaf_m - edge_m, -1.1, 1.1, 0.0, OtherMaterial(random));
  if (random.Chance(0.5)) {
    const double from = random.Uniform(0.08, 0.22), front_m = random.Uniform(0.004, 0.014);
    box("panel", from, leaf_m - edge_m - 0.12, 0.10, 0.9, front_m, OtherMaterial(random));
    box("panel", from, leaf_m - edge_m - 0.12, -0.9, -0.14, front_m, OtherMaterial(random));
  }
  const double frame_m = random.Uniform(-0.06, 0.05), width_m = random.Uniform(0.03, 0.14);
  const Material frame = OtherMaterial(random), wall = OtherMaterial(random);
  box("frame", -edge_m - width_m, -edge_m - 0.004, -1.1, 1.1, frame_m, frame);
  box("wall", -edge_m - 3.0, -edge_m - width_m, -1.1, 1.1, frame_m - random.Uniform(0.0, 0.05),
      wall);
  box("wall", leaf_m - edge_m, leaf_m - edge_m + 3.0, -1.1, 1.1, frame_m, wall);
}

Pose RandomDoor(const Eigen::Vector3d& position, double azimuth, Random& random) {
  const double yaw = azimuth + RadiansFromDegrees(random.Uniform(-45.0, 45.0));
  const double lean = RadiansFromDegrees(1.5 * random.Normal());
  return DoorFacing(position, yaw, lean);
}

}  // namespace

FitTrialScene OtherHandleScene(std::uint64_t seed) {
  Random random(seed, kSceneStream);
  FitTrialScene trial;
  DoorHardware thing;
  if (random.Chance(0.85)) {
    thing = DrawOtherBar(random);
    trial.positive = MeasureDoorThing(thing).IsLeverHandle();
  } else {
    trial.positive = false;
    thing = DrawOtherFitting(random);
    for (int i = 0; i < kMostRedraws && MeasureDoorThing(thing).IsLeverHandle(); ++i)
      thing = DrawOtherFitting(random);
  }
  trial.what = thing.name + (trial.positive ? ", by its shape a lever" : "");
  const double distance = random.Uniform(0.5, 1.6), azimuth = random.Uniform(-0.4, 0.4);
  const double elevation = -RadiansFromDegrees(random.Uniform(5.0, 38.0));
  const Eigen::Vector3d sight(std::cos(elevation) * std::cos(azimuth),
                              std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const Pose door = RandomDoor(OtherHead() + distance * sight, azimuth, random);

  auto scene = std::make_shared<Scene>();
  scene->lights.push_back(
      {{random.Uniform(-0.5, 0.8), random.Uniform(-2.0, 2.0), 2.8}, random.Uniform(0.5, 2.0)});
  scene->ambient = random.Uniform(0.15, 0.6);
  const double hand =
      thing.door_from_handle.Rotate(Eigen::Vector3d::UnitX()).x() < 0.0 ? -1.0 : 1.0;
  AddDoor(door, hand, random, *scene);
  const std::size_t first = scene->meshes.size();
  Hang(thing.parts, door, *scene);
  AddObjectPoints(*scene, first, trial);
  trial.focus_m =
      door * (thing.door_from_handle * Eigen::Vector3d(0.5 * thing.model.length_m, 0, 0));
  trial.focus_radius_m = 0.5 * thing.model.length_m + 0.03;
  if (trial.positive)
    scene->handles.push_back({thing.name, door * thing.door_from_handle, thing.model});
  AddOccluders(trial.focus_m, trial.focus_radius_m, random, *scene);
  SetOtherConditions(random, trial);
  scene->name = trial.what;
  trial.scene = scene;
  trial.plan = OtherPlan(elevation, trial.focus_radius_m / distance, 5.0, random);
  return trial;
}

}  // namespace foresight
