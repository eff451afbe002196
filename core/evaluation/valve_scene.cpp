#include "core/evaluation/valve_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/evaluation/valve_distractors.h"
#include "core/evaluation/varied_wheel.h"
#include "core/geometry/angles.h"
#include "core/geometry/rotation_between.h"
#include "core/simulation/scene_objects.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

constexpr std::uint64_t kValveStream = 4242;
constexpr double kHeadHeight_m = 1.4;  // of DefaultSensorRig, and 0.1 m in front of robot
constexpr double kHeadForward_m = 0.1;
constexpr double kFarRoom_m = 4.0;
constexpr double kFlange_m = 0.016;
constexpr std::uint64_t kMadeStream = 4243;

Material RandomMaterial(Random& random) {
  using Pattern = Material::Pattern;
  constexpr Pattern kPatterns[] = {Pattern::kPlain, Pattern::kNoise, Pattern::kBrick,
                                   Pattern::kStripes, Pattern::kChecker};
  Material material;
  for (int i = 0; i < 3; ++i) material.color[i] = random.Uniform(0.05, 0.8);
  for (int i = 0; i < 3; ++i)
    material.color2[i] = std::clamp(material.color[i] + random.Uniform(-0.3, 0.3), 0.02, 0.9);
  // Half of all things are plain.
  material.pattern = random.Chance(0.5) ? Pattern::kPlain : kPatterns[random.Index(5)];
  material.pattern_size_m = random.Uniform(0.01, 0.15);
  material.lidar_reflectance = random.Uniform(0.2, 0.7);
  material.specular = random.Uniform(0.0, 0.08);
  return material;
}

ValveModel RandomWheel(Random& random) {
  ValveModel model;
  const bool small = random.Chance(0.08);
  model.rim_radius_m = small ? random.Uniform(0.045, 0.095) : random.Uniform(0.095, 0.240);
  model.tube_radius_m = small ? random.Uniform(0.006, 0.009) : random.Uniform(0.009, 0.016);
  model.spoke_radius_m = small ? random.Uniform(0.005, 0.007) : random.Uniform(0.006, 0.011);
  model.hub_radius_m = std::max(0.018, random.Uniform(0.15, 0.30) * model.rim_radius_m);
  model.dish_m = std::min(random.Uniform(0.0, 0.050), 0.35 * model.rim_radius_m);
  model.spokes = random.Chance(0.06) ? 0 : 2 + random.Index(5);
  return model;
}

ValveModel RandomLever(Random& random) {
  ValveModel model;
  model.kind = ValveModel::Kind::kLever;
  model.lever_length_m = random.Uniform(0.12, 0.30);
  model.tube_radius_m = random.Uniform(0.009, 0.016);
  model.hub_radius_m = random.Uniform(0.018, 0.032);
  return model;
}

double DistanceFor(const ValveModel& model, bool& far, Random& random) {
  far = random.Chance(0.15) && model.rim_radius_m >= 0.095;
  if (far) return random.Uniform(2.0, 3.0);
  return random.Uniform(0.7, model.rim_radius_m < 0.095 ? 1.2 : 2.0);
}

/// A direction at an angle from another, to a random side.
Eigen::Vector3d Tilted(const Eigen::Vector3d& direction, double angle, Random& random) {
  const Eigen::AngleAxisd side(random.Uniform(0.0, 2.0 * std::numbers::pi), direction);
  return Eigen::AngleAxisd(angle, side * direction.unitOrthogonal()) * direction;
}

/// Where the head is and where the thing hangs.
struct Place {
  Eigen::Vector3d center;  ///< in robot
  Eigen::Vector3d axis;    ///< towards the viewer
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
  double wall_m = 0.12;  ///< from the rim's plane back to the wall
};

Place RandomPlace(double distance_m, Random& random) {
  Place place;
  place.azimuth_rad = random.Uniform(-0.35, 0.35);
  place.elevation_rad = random.Uniform(-0.30, 0.30);
  const Eigen::Vector3d sight(std::cos(place.elevation_rad) * std::cos(place.azimuth_rad),
                              std::cos(place.elevation_rad) * std::sin(place.azimuth_rad),
                              std::sin(place.elevation_rad));
  place.center = Eigen::Vector3d(kHeadForward_m, 0.0, kHeadHeight_m) + distance_m * sight;
  place.axis = Tilted(-sight, RadiansFromDegrees(random.Uniform(0.0, 40.0)), random);
  place.wall_m = random.Uniform(0.08, 0.20);
  return place;
}

void AddRectangle(const char* name, const Eigen::Vector3d& center, const Eigen::Vector3d& normal,
                  double size_m, const Material& material, Scene& scene) {
  SceneMesh mesh;
  mesh.name = name;
  mesh.material = material;
  mesh.robot_from_object = {RotationBetween(Eigen::Vector3d::UnitZ(), normal), center};
  AppendShape(RectangleShape(size_m, size_m), mesh.robot_from_object, mesh);
  scene.meshes.push_back(std::move(mesh));
}

void AddRoom(const Place& place, bool with_wall, Random& random, Scene& scene) {
  const Eigen::Vector3d to_head =
      (Eigen::Vector3d(kHeadForward_m, 0.0, kHeadHeight_m) - place.center).normalized();
  AddRectangle("far wall", place.center - kFarRoom_m * to_head, to_head, 20.0,
               RandomMaterial(random), scene);
  if (!with_wall) return;
  const Eigen::Vector3d foot = place.center - place.wall_m * place.axis;
  // In a quarter of the scenes the wheel was not built parallel to the wall.
  const bool skewed = random.Chance(0.25);
  const double angle = skewed ? RadiansFromDegrees(random.Uniform(5.0, 20.0)) : 0.0;
  AddRectangle("wall", foot, Tilted(place.axis, angle, random), 4.0, RandomMaterial(random), scene);
  if (!random.Chance(0.7)) return;
  const double pipe_radius = random.Uniform(0.015, 0.03);
  const double off = random.Uniform(0.10, 0.25);
  SceneMesh pipe;
  pipe.name = "pipe";
  pipe.material = RandomMaterial(random);
  const Eigen::Vector3d across =
      Eigen::AngleAxisd(random.Uniform(0.0, 2.0 * std::numbers::pi), place.axis) *
      place.axis.unitOrthogonal();
  const Eigen::Vector3d along = place.axis.cross(across);
  const Eigen::Vector3d middle = foot + off * across + pipe_radius * place.axis;
  const auto part = PoseAlong(middle - 1.5 * along, middle + 1.5 * along);
  const Rigid<frame::Robot, frame::Object> robot_from_pipe(part.rotation(), part.translation());
  AppendShape(CylinderShape(pipe_radius, 3.0), robot_from_pipe, pipe);
  scene.meshes.push_back(std::move(pipe));
}

/// What sits on the hub of many wheels, whose front is that far before where the spokes meet.
void AddNut(const ValveObject& valve, double front_m, Random& random, Scene& scene) {
  if (valve.model.IsLever() || random.Chance(0.5)) return;
  SceneMesh nut;
  nut.name = "nut";
  nut.material = valve.body_material;
  const double hub_z = -valve.model.dish_m;
  const double length_m = std::max(front_m + 0.010, 0.002);
  const auto part = PoseAlong({0.0, 0.0, hub_z}, {0.0, 0.0, hub_z + length_m});
  AppendShape(CylinderShape(0.010, length_m), valve.robot_from_object * part, nut);
  scene.meshes.push_back(std::move(nut));
}

/// A varied wheel instead of the template where there is one.
double AddRandomValve(const ValveModel& model, const std::optional<VariedWheel>& varied,
                      const Place& place, Random& random, Scene& scene) {
  ValveObject valve;
  valve.name = "valve";
  valve.model = varied ? ModelOf(*varied) : model;
  valve.robot_from_object =
      ValvePose(place.center, place.axis, random.Uniform(0.0, 2.0 * std::numbers::pi));
  const double hub_depth_m = model.IsLever() ? 0.0 : valve.model.dish_m;
  valve.stem_length_m = std::max(0.02, place.wall_m - hub_depth_m - kFlange_m);
  valve.stem_radius_m = random.Uniform(0.009, 0.014);
  valve.flange_radius_m = random.Uniform(0.03, 0.06);
  valve.wheel_material = RandomMaterial(random);
  valve.body_material = RandomMaterial(random);
  if (varied) {
    AddVariedWheel(*varied, valve, scene);
    AddValveBody(valve, scene);
    scene.valves.push_back({valve.name, valve.robot_from_object, valve.model});
    AddNut(valve, varied->hub_forward_m + 0.5 * varied->hub_length_m, random, scene);
  } else {
    AddValve(valve, scene);
    AddNut(valve, model.hub_radius_m, random, scene);
  }
  return model.IsLever() ? 0.5 * model.lever_length_m + model.tube_radius_m
                         : model.rim_radius_m + model.tube_radius_m;
}

std::string NameOf(const ValveModel& model) {
  if (model.IsLever()) return "lever";
  const std::string size = model.rim_radius_m < 0.095 ? "small " : "";
  return model.spokes == 0 ? size + "disc"
                           : fmt::format("{}wheel of {} spokes", size, model.spokes);
}

/// A wheel that is none, on a stem before the wall.
std::string AddAlmostWheel(const ValveModel& like, const Place& place, const Material& material,
                           Random& random, Scene& scene) {
  ValveObject thing;
  thing.robot_from_object =
      ValvePose(place.center, place.axis, random.Uniform(0.0, 2.0 * std::numbers::pi));
  thing.wheel_material = material;
  thing.body_material = RandomMaterial(random);
  const VariedWheel wheel = RandomAlmostWheel(like, random, thing.name);
  AddVariedWheel(wheel, thing, scene);
  thing.model = ModelOf(wheel);
  thing.stem_length_m = std::max(0.02, place.wall_m - wheel.dish_m - kFlange_m);
  if (wheel.hub_length_m > 0.0) AddValveBody(thing, scene);
  return thing.name;
}

/// Lines 0.25 to 1 deg apart over the thing and some degrees around it.
ScanPlan PlanFor(const Place& place, double angular_radius_rad, Random& random) {
  const double line_rate_hz = 40.0;
  const double margin_rad = RadiansFromDegrees(9.0);
  const double spacing_rad = RadiansFromDegrees(random.Uniform(0.25, 1.0));
  ScanPlan plan;
  plan.from_rad = place.elevation_rad - angular_radius_rad - margin_rad;
  plan.to_rad = place.elevation_rad + angular_radius_rad + margin_rad;
  plan.speed_rad_s = spacing_rad * line_rate_hz;
  plan.image_angles_rad = {place.elevation_rad};
  return plan;
}

}  // namespace

FitTrialScene RandomValveScene(std::uint64_t seed) {
  Random random(seed, kValveStream);
  FitTrialScene trial;
  trial.positive = !random.Chance(1.0 / 6.0);
  const ValveModel model = random.Chance(0.1) ? RandomLever(random) : RandomWheel(random);
  bool far = false;
  const double distance_m = DistanceFor(model, far, random);
  Place place = RandomPlace(distance_m, random);
  auto scene = std::make_shared<Scene>();
  scene->lights.push_back({{0.3, random.Uniform(-1.5, 1.5), 2.6}, random.Uniform(0.8, 1.4)});
  const Distractor thing =
      Distractors()[static_cast<std::size_t>(random.Index(static_cast<int>(Distractors().size())))];
  // Half of the wheels with spokes and of the negatives are made another way, by numbers of their
  // own: all else of a scene is as it was without.
  Random made(seed, kMadeStream);
  const bool otherwise = made.Uniform() < 0.5;
  const bool empty = !trial.positive && thing == Distractor::kEmptyRegion && !otherwise;
  // A tenth hang free, the room's far wall behind them.
  AddRoom(place, !empty && !random.Chance(0.1), random, *scene);
  if (trial.positive) {
    std::optional<VariedWheel> varied;
    if (otherwise && !model.IsLever() && model.spokes >= 2) varied = RandomVariedWheel(model, made);
    trial.what = (varied ? varied->made + " " : "") + NameOf(model) + (far ? ", beyond 2 m" : "");
    trial.focus_radius_m = AddRandomValve(model, varied, place, random, *scene);
    trial.focus_m = place.center;
    if (model.IsLever())
      trial.focus_m = scene->valves.front().robot_from_object *
                      Eigen::Vector3d(0.5 * model.lever_length_m, 0.0, 0.0);
  } else if (otherwise) {
    const ValveModel like = model.IsLever() ? RandomWheel(made) : model;
    trial.what = AddAlmostWheel(like, place, RandomMaterial(random), made, *scene);
    trial.focus_m = place.center;
    trial.focus_radius_m = like.rim_radius_m;
  } else {
    trial.what = foresight::NameOf(thing);
    const DistractorPlace at{
        ValvePose(place.center, place.axis, random.Uniform(0.0, 2.0 * std::numbers::pi)),
        std::clamp(model.rim_radius_m, 0.1, 0.24), place.wall_m};
    AddDistractor(thing, at, RandomMaterial(random), random, *scene);
    trial.focus_m = place.center;
    trial.focus_radius_m = at.radius_m;
  }
  scene->name = trial.what;
  trial.scene = scene;
  trial.plan = PlanFor(place, trial.focus_radius_m / distance_m, random);
  trial.world.lidar.sigma_base_m = random.Uniform(0.004, 0.020);
  return trial;
}

}  // namespace foresight
