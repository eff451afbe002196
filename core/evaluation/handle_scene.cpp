#include "core/evaluation/handle_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/evaluation/door_hardware.h"
#include "core/geometry/angles.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using DoorPose = Rigid<frame::Robot, frame::Object>;

constexpr std::uint64_t kSceneStream = 8484;
constexpr double kHeadHeight_m = 1.4;  // of DefaultSensorRig, and 0.1 m in front of robot
constexpr double kHeadForward_m = 0.1;
constexpr int kMostRedraws = 50;

Material RandomMaterial(Random& random) {
  using Pattern = Material::Pattern;
  constexpr Pattern kPatterns[] = {Pattern::kPlain, Pattern::kNoise, Pattern::kStripes};
  Material material;
  for (int i = 0; i < 3; ++i) material.color[i] = random.Uniform(0.05, 0.8);
  for (int i = 0; i < 3; ++i)
    material.color2[i] = std::clamp(material.color[i] + random.Uniform(-0.2, 0.2), 0.02, 0.9);
  material.pattern = random.Chance(0.6) ? Pattern::kPlain : kPatterns[random.Index(3)];
  material.pattern_size_m = random.Uniform(0.01, 0.15);
  material.lidar_reflectance = random.Uniform(0.2, 0.7);
  material.specular = random.Uniform(0.0, 0.08);
  return material;
}

Material Metal(Random& random) {
  Material metal = RandomMaterial(random);
  metal.pattern = Material::Pattern::kPlain;
  metal.specular = random.Uniform(0.0, 0.2);
  return metal;
}

constexpr double kFar_m = 1.1;  // half of the handles

/// The door's frame in robot: z = its normal, towards the viewer, y up, the origin at the pivot's
/// place on its face.
struct Place {
  DoorPose robot_from_door;
  double distance_m = 1.0;
  double elevation_rad = 0.0;
};

Place RandomPlace(Random& random) {
  const double azimuth = random.Uniform(-0.35, 0.35), ahead_m = random.Uniform(0.55, 1.5);
  const double height_m = random.Uniform(0.85, 1.15);
  const Eigen::Vector3d position(kHeadForward_m + ahead_m * std::cos(azimuth),
                                 ahead_m * std::sin(azimuth), height_m);
  // Half of the doors are faced within 15 deg, the others from the side.
  const double most_deg = random.Chance(0.5) ? 15.0 : 40.0;
  const double yaw = azimuth + RadiansFromDegrees(random.Uniform(-most_deg, most_deg));
  const double lean = RadiansFromDegrees(0.7 * random.Normal());
  Place place;
  place.robot_from_door = DoorFacing(position, yaw, lean);
  const double drop_m = kHeadHeight_m - height_m;
  place.distance_m = std::hypot(ahead_m, drop_m);
  place.elevation_rad = -std::atan2(drop_m, ahead_m);
  return place;
}

void AddBox(const char* name, const DoorPose& robot_from_door, const Eigen::Vector3d& low,
            const Eigen::Vector3d& high, const Material& material, Scene& scene) {
  SceneMesh mesh;
  mesh.name = name;
  mesh.material = material;
  mesh.robot_from_object =
      robot_from_door *
      Rigid<frame::Object, frame::Object>(Eigen::Quaterniond::Identity(), 0.5 * (low + high));
  AppendShape(BoxShape(high - low), mesh.robot_from_object, mesh);
  scene.meshes.push_back(std::move(mesh));
}

/// A leaf in its frame in a wall. `hand` = the way from the door's near edge into it: +1 right.
void AddDoor(const Place& place, double hand, Random& random, Scene& scene) {
  constexpr double kBelow_m = 1.2, kAbove_m = 1.2, kLeaf_m = 0.9;
  const double backset_m = random.Uniform(0.045, 0.085);
  const auto box = [&](const char* name, double from_x, double to_x, double front_m,
                       const Material& material) {
    AddBox(name, place.robot_from_door, {std::min(hand * from_x, hand * to_x), -kBelow_m, -0.06},
           {std::max(hand * from_x, hand * to_x), kAbove_m, front_m}, material, scene);
  };
  box("door", -backset_m, kLeaf_m - backset_m, 0.0, RandomMaterial(random));
  const Material frame = RandomMaterial(random), wall = RandomMaterial(random);
  // One leaf in four lies flush in its frame.
  const double frame_m = random.Chance(0.25) ? 0.0 : random.Uniform(-0.03, 0.025);
  const double width_m = random.Uniform(0.05, 0.12), wall_m = frame_m - random.Uniform(0.0, 0.03);
  box("frame", -backset_m - width_m, -backset_m - 0.003, frame_m, frame);
  box("wall", -backset_m - 2.5, -backset_m - width_m, wall_m, wall);
  box("frame", kLeaf_m - backset_m + 0.003, kLeaf_m - backset_m + width_m, frame_m, frame);
  box("wall", kLeaf_m - backset_m + width_m, kLeaf_m - backset_m + 2.5, wall_m, wall);
}

/// Things that turn out to be levers are drawn again.
DoorHardware DrawNoLever(Random& random, const Material& material, const Material& other) {
  DoorHardware thing = DrawOtherDoorThing(random, material, other);
  for (int i = 0; i < kMostRedraws && MeasureDoorThing(thing).IsLeverHandle(); ++i)
    thing = DrawOtherDoorThing(random, material, other);
  return thing;
}

/// The middle and the size of what a region is drawn round, of a thing that is no lever; a pipe
/// goes on beyond it.
void SetFocus(const DoorHardware& thing, const DoorPose& robot_from_door, FitTrialScene& trial) {
  constexpr float kMost_m = 0.12F;
  Eigen::Vector3f low = Eigen::Vector3f::Constant(kMost_m), high = -low;
  for (const SceneMesh& part : thing.parts)
    for (const Eigen::Vector3f& vertex : part.vertices) {
      const Eigen::Vector3f at = vertex.cwiseMax(-kMost_m).cwiseMin(kMost_m);
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
  trial.focus_m = robot_from_door * Eigen::Vector3d(0.5 * (low + high).cast<double>());
  trial.focus_radius_m =
      std::clamp(0.5 * static_cast<double>((high - low).head<2>().norm()) + 0.02, 0.07, 0.13);
}

/// Lines 0.2 to 0.7 deg apart over the thing and some degrees round it.
ScanPlan PlanFor(const Place& place, double angular_radius_rad, Random& random) {
  const double line_rate_hz = 40.0, margin_rad = RadiansFromDegrees(7.0);
  const double spacing_rad = RadiansFromDegrees(random.Uniform(0.2, 0.7));
  ScanPlan plan;
  plan.from_rad = place.elevation_rad - angular_radius_rad - margin_rad;
  plan.to_rad = place.elevation_rad + angular_radius_rad + margin_rad;
  plan.speed_rad_s = spacing_rad * line_rate_hz;
  plan.image_angles_rad = {place.elevation_rad};
  return plan;
}

void AddLever(const DoorHardware& lever, const DoorPose& robot_from_door, FitTrialScene& trial,
              Scene& scene) {
  HandleTruth truth;
  truth.name = lever.name;
  truth.robot_from_object = robot_from_door * lever.door_from_handle;
  truth.model = lever.model;
  const double length_m = lever.model.length_m, behind_m = lever.model.behind_m;
  trial.focus_m = truth.robot_from_object * Eigen::Vector3d(0.5 * (length_m - behind_m), 0.0, 0.0);
  trial.focus_radius_m = 0.5 * (length_m + behind_m) + 0.025;
  trial.what = std::string(lever.model.plate == HandleModel::Plate::kLong ? "lever on a long plate"
                                                                          : "lever on a rosette") +
               (lever.model.returned ? ", end bent back" : "");
  scene.handles.push_back(std::move(truth));
}

}  // namespace

FitTrialScene RandomHandleScene(std::uint64_t seed) {
  Random random(seed, kSceneStream);
  FitTrialScene trial;
  const bool wanted = !random.Chance(1.0 / 6.0);
  const Place place = RandomPlace(random);
  const Material metal = Metal(random), other = Metal(random);
  auto scene = std::make_shared<Scene>();
  scene->lights.push_back({{0.3, random.Uniform(-1.5, 1.5), 2.6}, random.Uniform(0.8, 1.4)});
  double hand = random.Chance(0.5) ? 1.0 : -1.0;
  if (wanted) {
    const DoorHardware lever = DrawLever(random, metal, other);
    trial.positive = MeasureDoorThing(lever).IsLeverHandle();
    // It points from the door's edge into the leaf.
    hand = lever.door_from_handle.Rotate(Eigen::Vector3d::UnitX()).x() < 0.0 ? -1.0 : 1.0;
    if (trial.positive)
      AddLever(lever, place.robot_from_door, trial, *scene);
    else
      SetFocus(lever, place.robot_from_door, trial);
    if (!trial.positive)
      trial.what = "a lever by its drawing alone";
    else if (place.distance_m > kFar_m)
      trial.what += ", beyond 1.1 m";
    Hang(lever.parts, place.robot_from_door, *scene);
    Hang(lever.beside, place.robot_from_door, *scene);
  } else {
    trial.positive = false;
    const double kind = random.Uniform();
    trial.focus_m = place.robot_from_door.translation();
    trial.focus_radius_m = random.Uniform(0.07, 0.12);
    trial.what = "a bare door";
    if (kind > 0.12) {
      const DoorHardware thing = DrawNoLever(random, metal, other);
      trial.what = "a " + thing.name;
      SetFocus(thing, place.robot_from_door, trial);
      Hang(thing.parts, place.robot_from_door, *scene);
      Hang(thing.beside, place.robot_from_door, *scene);
    }
  }
  AddDoor(place, hand, random, *scene);
  scene->name = trial.what;
  trial.scene = scene;
  trial.plan = PlanFor(place, trial.focus_radius_m / place.distance_m, random);
  trial.world.lidar.sigma_base_m = random.Uniform(0.004, 0.020);
  return trial;
}

}  // namespace foresight
