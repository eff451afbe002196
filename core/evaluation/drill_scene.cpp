#include "core/evaluation/drill_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/evaluation/drill_distractors.h"
#include "core/evaluation/table_tools.h"
#include "core/evaluation/varied_drill.h"
#include "core/geometry/angles.h"
#include "core/simulation/scene_objects.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Robot, frame::Object>;

constexpr std::uint64_t kDrillStream = 4343;
constexpr std::uint64_t kVariedStream = 4344;  // of what was added later: the rest stays as it was
constexpr double kVaried = 0.5;                // of the drills
constexpr double kTools = 0.5;                 // of the negatives that are no half drills
constexpr double kHeadHeight_m = 1.4;          // of DefaultSensorRig, and 0.1 m in front of robot
constexpr double kHeadForward_m = 0.1;
constexpr double kFullTurn_rad = 2.0 * std::numbers::pi;
constexpr double kFocusHeight_m = 0.12;  // the middle of a drill over its table
constexpr double kFocusForward_m = 0.025;
constexpr double kFocusRadius_m = 0.17;

Material RandomMaterial(Random& random) {
  Material material;
  for (int i = 0; i < 3; ++i) material.color[i] = random.Uniform(0.05, 0.8);
  for (int i = 0; i < 3; ++i)
    material.color2[i] = std::clamp(material.color[i] + random.Uniform(-0.3, 0.3), 0.02, 0.9);
  // Half of all things are plain.
  material.pattern = random.Chance(0.5) ? Material::Pattern::kPlain : Material::Pattern::kNoise;
  material.pattern_size_m = random.Uniform(0.01, 0.10);
  material.lidar_reflectance = random.Uniform(0.15, 0.7);
  material.specular = random.Uniform(0.0, 0.08);
  return material;
}

/// About a tenth off each size: no drill is the template.
double Varied(double size, Random& random) {
  return size * random.Uniform(0.88, 1.12);
}

struct NamedShape {
  DrillShape shape;
  std::string name;
};

DrillShape CutOutTool(Random& random) {
  DrillShape shape;
  shape.kind = DrillShape::Kind::kCutOut;
  shape.foot_m = {Varied(0.117, random), Varied(0.076, random), random.Uniform(0.040, 0.055)};
  shape.foot_forward_m = random.Uniform(0.016, 0.028);
  shape.grip_radius_m = Varied(0.0287, random);
  shape.head_height_m = Varied(0.240, random);
  shape.head_radius_m = Varied(0.022, random);
  shape.bit_radius_m = 0.003;
  shape.bit_length_m = random.Uniform(0.02, 0.045);
  return shape;
}

NamedShape RandomShape(Random& random) {
  DrillShape shape;
  shape.foot_m = {Varied(0.115, random), Varied(0.073, random), random.Uniform(0.045, 0.075)};
  shape.foot_forward_m = random.Uniform(-0.006, 0.016);
  shape.grip_radius_m = Varied(0.0265, random);
  shape.grip_depth_m = random.Chance(0.5) ? random.Uniform(0.004, 0.014) : 0.0;
  shape.head_height_m = Varied(0.208, random);
  shape.head_radius_m = Varied(0.033, random);
  shape.head_back_m = random.Uniform(0.050, 0.080);
  shape.head_front_m = random.Uniform(0.070, 0.095);
  shape.chuck_radius_m = Varied(0.020, random);
  shape.chuck_length_m = random.Uniform(0.028, 0.045);
  shape.bit_length_m = random.Chance(0.3) ? 0.0 : random.Uniform(0.03, 0.12);
  shape.trigger = random.Chance(0.8);
  std::string name = "barrel drill";
  switch (random.Index(8)) {
    case 0:
    case 1:
      shape.kind = DrillShape::Kind::kBoxHead;
      name = "drill with a boxy head";
      break;
    case 2:
    case 3: {
      const double lean = RadiansFromDegrees(random.Uniform(4.0, 12.0));
      const double way = random.Uniform(0.0, kFullTurn_rad);
      shape.body_tilt_rad = {0.5 * lean * std::sin(way), lean * std::cos(way)};
      shape.foot_m.head<2>() *= random.Uniform(0.75, 0.9);
      name = "leaning drill";
      break;
    }
    case 4:
      shape.grip_radius_m = random.Uniform(0.030, 0.034);
      name = "drill with a thick grip";
      break;
    case 5:
      shape.side_handle = true;
      name = "drill with a side handle";
      break;
    case 6:
      if (random.Chance(0.6)) return {CutOutTool(random), "cut-out tool"};
      break;
    default:
      break;
  }
  return {shape, name};
}

void AddBox(const char* name, const Pose& pose, const Eigen::Vector3d& size,
            const Material& material, Scene& scene) {
  SceneMesh mesh;
  mesh.name = name;
  mesh.material = material;
  mesh.robot_from_object = pose;
  AppendShape(BoxShape(size), pose, mesh);
  scene.meshes.push_back(std::move(mesh));
}

/// Where the thing stands and how the head looks at it.
struct Place {
  Eigen::Vector3d foot;  ///< in robot, on the table
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;  ///< of its middle, seen from the head
  double distance_m = 1.0;
};

Place RandomPlace(bool far, Random& random) {
  Place place;
  place.distance_m = far ? random.Uniform(2.0, 2.5) : random.Uniform(0.7, 2.0);
  place.azimuth_rad = random.Uniform(-0.35, 0.35);
  place.elevation_rad = -RadiansFromDegrees(random.Uniform(5.0, far ? 25.0 : 40.0));
  const Eigen::Vector3d sight(std::cos(place.elevation_rad) * std::cos(place.azimuth_rad),
                              std::cos(place.elevation_rad) * std::sin(place.azimuth_rad),
                              std::sin(place.elevation_rad));
  place.foot = Eigen::Vector3d(kHeadForward_m, 0.0, kHeadHeight_m) + place.distance_m * sight -
               kFocusHeight_m * Eigen::Vector3d::UnitZ();
  return place;
}

Pose Upright(const Eigen::Vector3d& position, double yaw_rad) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())), position};
}

/// A point `away_m` behind and `left_m` beside a place, seen from the head.
Eigen::Vector3d Beside(const Place& place, double away_m, double left_m) {
  const Eigen::Vector3d away(std::cos(place.azimuth_rad), std::sin(place.azimuth_rad), 0.0);
  return place.foot + away_m * away + left_m * Eigen::Vector3d(-away.y(), away.x(), 0.0);
}

void AddTable(const Place& place, double front_m, double depth_m, Random& random, Scene& scene) {
  constexpr double kThickness_m = 0.04;
  const Eigen::Vector3d size(depth_m, random.Uniform(0.9, 1.6), kThickness_m);
  const Eigen::Vector3d middle = Beside(place, 0.5 * depth_m - front_m, random.Uniform(-0.1, 0.1)) -
                                 0.5 * kThickness_m * Eigen::Vector3d::UnitZ();
  AddBox("table", Upright(middle, place.azimuth_rad + random.Uniform(-0.2, 0.2)), size,
         RandomMaterial(random), scene);
}

void AddWall(const Place& place, double behind_m, Random& random, Scene& scene) {
  constexpr double kThickness_m = 0.05;
  const double turn = random.Chance(0.3) ? random.Uniform(-0.3, 0.3) : 0.0;
  AddBox("wall",
         Upright(Beside(place, behind_m + 0.5 * kThickness_m, 0.0), place.azimuth_rad + turn),
         {kThickness_m, 6.0, 6.0}, RandomMaterial(random), scene);
}

void AddRoom(const Place& place, Random& random, Scene& scene) {
  AddBox("floor", Upright({0.0, 0.0, -0.05}, 0.0), {12.0, 12.0, 0.1}, RandomMaterial(random),
         scene);
  AddWall(place, random.Uniform(2.5, 4.0), random, scene);
}

/// Things beside and behind, never between head and drill.
void AddClutter(const Place& place, Random& random, Scene& scene) {
  const int count = 1 + random.Index(3);
  for (int i = 0; i < count; ++i) {
    const double side = random.Chance(0.5) ? 1.0 : -1.0;
    const Eigen::Vector3d at =
        Beside(place, random.Uniform(-0.05, 0.25), side * random.Uniform(0.17, 0.36));
    SceneMesh mesh;
    mesh.name = "clutter";
    mesh.material = RandomMaterial(random);
    mesh.robot_from_object = Upright(at, random.Uniform(0.0, kFullTurn_rad));
    const double height = random.Uniform(0.04, 0.24);
    const Rigid<frame::Object, frame::Object> up(Eigen::Quaterniond::Identity(),
                                                 {0.0, 0.0, 0.5 * height});
    const double radius = random.Uniform(0.02, 0.045);
    if (random.Chance(0.5))
      AppendShape(CylinderShape(radius, height), mesh.robot_from_object * up, mesh);
    else
      AppendShape(BoxShape({2.0 * radius, random.Uniform(0.03, 0.12), height}),
                  mesh.robot_from_object * up, mesh);
    scene.meshes.push_back(std::move(mesh));
  }
}

Pose AddRandomDrill(const Place& place, const DrillShape& shape, Random& random, Scene& scene) {
  DrillObject drill;
  drill.name = "drill";
  drill.shape = shape;
  drill.scale = random.Uniform(0.92, 1.08);
  drill.robot_from_object = Upright(place.foot, random.Uniform(0.0, kFullTurn_rad));
  drill.shell_material = RandomMaterial(random);
  drill.grip_material = RandomMaterial(random);
  drill.metal_material = RandomMaterial(random);
  drill.metal_material.specular = random.Uniform(0.1, 0.4);
  AddDrill(drill, scene);
  return drill.robot_from_object;
}

/// A drill of other proportions; returns where it stands.
Pose AddRandomVariedDrill(const Place& place, Random& random, Scene& scene) {
  const VariedDrill shape = RandomVariedDrill(random);
  DrillMaterials materials = {RandomMaterial(random), RandomMaterial(random),
                              RandomMaterial(random)};
  materials.metal.specular = random.Uniform(0.1, 0.4);
  const Pose pose = Upright(place.foot, random.Uniform(0.0, kFullTurn_rad));
  AddVariedDrill(shape, materials, pose, scene);
  return pose;
}

/// Lines 0.25 to 1 deg apart over the thing and some degrees around it.
ScanPlan PlanFor(const Place& place, double radius_m, Random& random) {
  constexpr double kLineRate_hz = 40.0;
  const double margin_rad = RadiansFromDegrees(9.0);
  const double spacing_rad = RadiansFromDegrees(random.Uniform(0.25, 1.0));
  const double half_rad = radius_m / place.distance_m + margin_rad;
  ScanPlan plan;
  plan.from_rad = place.elevation_rad - half_rad;
  plan.to_rad = place.elevation_rad + half_rad;
  plan.speed_rad_s = spacing_rad * kLineRate_hz;
  plan.image_angles_rad = {place.elevation_rad};
  return plan;
}

/// A region that shows a drill's foot, or its end, alone.
void CutInHalf(const Pose& drill, Random& random, FitTrialScene& trial) {
  const bool foot = random.Chance(0.5);
  trial.focus_m =
      drill * (foot ? Eigen::Vector3d(0.0, 0.0, 0.02) : Eigen::Vector3d(0.19, 0.0, 0.21));
  trial.focus_radius_m = foot ? 0.075 : 0.09;
  trial.what = foot ? "a drill's foot" : "a drill's end";
}

}  // namespace

FitTrialScene RandomDrillScene(std::uint64_t seed) {
  Random random(seed, kDrillStream);
  FitTrialScene trial;
  trial.positive = !random.Chance(1.0 / 6.0);
  const bool half = !trial.positive && random.Chance(0.15);
  const bool far = trial.positive && random.Chance(0.2);
  const auto all = DrillDistractors();
  const DrillDistractor thing =
      all[static_cast<std::size_t>(random.Index(static_cast<int>(all.size())))];
  const bool drill = trial.positive || half;
  const Place place = RandomPlace(far, random);
  auto scene = std::make_shared<Scene>();
  scene->lights.push_back({{0.3, random.Uniform(-1.5, 1.5), 2.6}, random.Uniform(0.8, 1.4)});
  AddRoom(place, random, *scene);

  const bool edge = !drill && thing == DrillDistractor::kTableEdge;
  const bool bare = !drill && thing == DrillDistractor::kWall;
  const double front_m = edge ? random.Uniform(-0.05, 0.05) : random.Uniform(0.10, 0.30);
  const double depth_m = front_m + random.Uniform(0.35, 0.7);
  if (!bare) AddTable(place, front_m, depth_m, random, *scene);
  if (bare || random.Chance(0.6))
    AddWall(place, bare ? random.Uniform(-0.05, 0.1) : random.Uniform(0.18, 0.8), random, *scene);
  if (!bare && !edge && random.Chance(0.6)) AddClutter(place, random, *scene);

  NamedShape shape = RandomShape(random);
  const double yaw = random.Uniform(0.0, kFullTurn_rad);
  Pose pose = Upright(place.foot, yaw);
  Random later(seed, kVariedStream);
  const bool varied = drill && !half && later.Chance(kVaried);
  const auto tools = TableTools();
  const TableTool tool =
      tools[static_cast<std::size_t>(later.Index(static_cast<int>(tools.size())))];
  const bool is_tool = !drill && !bare && !edge && later.Chance(kTools);
  if (varied) {
    pose = AddRandomVariedDrill(place, later, *scene);
    shape = {{}, "drill of other proportions"};
  } else if (drill) {
    pose = AddRandomDrill(place, shape.shape, random, *scene);
  } else if (is_tool) {
    AddTableTool(tool, pose, RandomMaterial(random), later, *scene);
  } else {
    AddDrillDistractor(thing, pose, RandomMaterial(random), random, *scene);
  }
  const double forward =
      drill && shape.shape.kind != DrillShape::Kind::kCutOut ? kFocusForward_m : 0.0;
  trial.what = drill     ? shape.name + (far ? ", beyond 2 m" : "")
               : is_tool ? NameOf(tool)
                         : NameOf(thing);
  trial.focus_m = pose * Eigen::Vector3d(forward, 0.0, kFocusHeight_m);
  trial.focus_radius_m = kFocusRadius_m;
  if (half) CutInHalf(pose, random, trial);
  scene->name = trial.what;
  trial.scene = scene;
  trial.plan = PlanFor(place, trial.focus_radius_m, random);
  trial.world.lidar.sigma_base_m = random.Uniform(0.004, 0.020);
  return trial;
}

}  // namespace foresight
