#include "core/evaluation/other_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/angles.h"
#include "core/geometry/rotation_between.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Robot, frame::Object>;

/// Shapes of one material, placed in robot.
SceneMesh MeshOf(const char* name, const Material& material) {
  SceneMesh mesh;
  mesh.name = name;
  mesh.material = material;
  return mesh;
}

void AddBall(const Eigen::Vector3d& at, double radius, SceneMesh& mesh) {
  AppendShape(SphereShape(radius), {Eigen::Quaterniond::Identity(), at}, mesh);
}

void AddBar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
            SceneMesh& mesh) {
  AppendShape(CapsuleShape(radius, (to - from).norm()), Pose() * PoseAlong(from, to), mesh);
}

std::vector<Eigen::Vector2d> Round(double radius, int corners) {
  std::vector<Eigen::Vector2d> section;
  for (int i = 0; i < corners; ++i)
    section.emplace_back(radius * std::cos(2.0 * std::numbers::pi * i / corners),
                         radius * std::sin(2.0 * std::numbers::pi * i / corners));
  return section;
}

/// Directions across the sight of a place: right and up for the head.
struct Across {
  explicit Across(const Eigen::Vector3d& place)
      : towards((OtherHead() - place).normalized()),
        right(Eigen::Vector3d::UnitZ().cross(towards).normalized()),
        up(towards.cross(right)) {}
  Eigen::Vector3d towards, right, up;
};

/// It hangs between two points beside the view and sags.
void AddCable(const Eigen::Vector3d& place, double radius_m, Random& random, Scene& scene) {
  constexpr int kPoints = 24;
  const Across across(place);
  const double turn = random.Uniform(-std::numbers::pi, std::numbers::pi);
  const Eigen::Vector3d along = std::cos(turn) * across.right + std::sin(turn) * across.up;
  const Eigen::Vector3d beside = -std::sin(turn) * across.right + std::cos(turn) * across.up;
  const double reach = random.Uniform(0.4, 0.8);
  const Eigen::Vector3d middle = place + random.Uniform(0.05, 0.35) * across.towards +
                                 random.Uniform(-0.8, 0.8) * radius_m * beside;
  const double sag = random.Uniform(0.0, 0.15);
  std::vector<Eigen::Vector3d> path;
  for (int i = 0; i < kPoints; ++i) {
    const double t = 2.0 * i / (kPoints - 1) - 1.0;
    path.push_back(middle + reach * t * along - sag * (1.0 - t * t) * Eigen::Vector3d::UnitZ() +
                   0.02 * std::sin(5.0 * t + turn) * across.towards);
  }
  SceneMesh cable = MeshOf("cable", OtherMaterial(random));
  AppendShape(SweptShape(Round(random.Uniform(0.0025, 0.008), 16), path, across.towards), Pose(),
              cable);
  scene.meshes.push_back(std::move(cable));
}

/// Palm, thumb, four bent fingers and a forearm, at the edge of the thing.
void AddHand(const Eigen::Vector3d& place, double radius_m, Random& random, Scene& scene) {
  const Across across(place);
  const double turn = random.Uniform(-std::numbers::pi, std::numbers::pi);
  const Eigen::Vector3d out = std::cos(turn) * across.right + std::sin(turn) * across.up;
  const Eigen::Vector3d side = -std::sin(turn) * across.right + std::cos(turn) * across.up;
  const Eigen::Vector3d wrist = place + (random.Uniform(0.9, 1.2) * radius_m + 0.09) * out +
                                random.Uniform(0.02, 0.12) * across.towards;
  Material skin;
  skin.color = {random.Uniform(0.2, 0.8), 0.4, 0.3};
  skin.lidar_reflectance = random.Uniform(0.25, 0.6);
  skin.penetration_m = random.Uniform(0.0, 0.003);
  SceneMesh hand = MeshOf("hand", skin);
  AddBar(wrist, wrist + 0.35 * (out + 0.4 * across.towards).normalized(), 0.036, hand);
  const Eigen::Vector3d knuckles = wrist - 0.085 * out;
  for (int i = 0; i < 4; ++i) {
    const double beside = 0.021 * (i - 1.5);
    AddBar(wrist + 0.6 * beside * side, knuckles + beside * side, 0.014, hand);
    const Eigen::Vector3d bend = knuckles + beside * side - 0.045 * out;
    AddBar(knuckles + beside * side, bend, 0.009, hand);
    AddBar(bend, bend - 0.018 * out - random.Uniform(0.01, 0.03) * across.towards, 0.008, hand);
  }
  AddBar(wrist + 0.02 * side, wrist - 0.05 * out + 0.055 * side, 0.011, hand);
  AddBall(wrist, 0.033, hand);
  scene.meshes.push_back(std::move(hand));
}

}  // namespace

SceneMesh OtherMeshAt(const char* name, const Rigid<frame::Robot, frame::Object>& robot_from_object,
                      const Material& material) {
  SceneMesh mesh;
  mesh.name = name;
  mesh.material = material;
  mesh.robot_from_object = robot_from_object;
  return mesh;
}

ScanPlan OtherPlan(double elevation_rad, double half_rad, double least_margin_deg, Random& random) {
  constexpr double kLinesPerSecond = 40.0;
  ScanPlan plan;
  const double margin_rad = RadiansFromDegrees(random.Uniform(least_margin_deg, 14.0));
  plan.from_rad = elevation_rad - half_rad - margin_rad;
  plan.to_rad = elevation_rad + half_rad + margin_rad;
  plan.speed_rad_s = RadiansFromDegrees(kLinesPerSecond * random.Uniform(0.2, 0.9));
  plan.image_angles_rad = {elevation_rad};
  return plan;
}

Eigen::Vector3d OtherHead() {
  return {0.1, 0.0, 1.4};
}

Material OtherMaterial(Random& random) {
  using Pattern = Material::Pattern;
  constexpr Pattern kPatterns[] = {Pattern::kPlain, Pattern::kNoise, Pattern::kStripes};
  Material material;
  const double kind = random.Uniform();
  for (int i = 0; i < 3; ++i) {
    material.color[i] = random.Uniform(0.02, 0.95);
    material.color2[i] = random.Uniform(0.02, 0.95);
  }
  material.pattern = kPatterns[random.Index(3)];
  material.pattern_size_m = random.Uniform(0.004, 0.3);
  material.lidar_reflectance = random.Uniform(0.12, 0.9);
  material.specular = random.Uniform(0.0, 0.15);
  if (kind < 0.125) {  // rubber, black paint
    material.color *= 0.08;
    material.lidar_reflectance = random.Uniform(0.02, 0.08);
  } else if (kind < 0.25) {  // bare or polished metal
    material.specular = random.Uniform(0.4, 0.85);
  } else if (kind < 0.333) {  // moulded plastic
    material.translucency = random.Uniform(0.05, 0.35);
    material.penetration_m = random.Uniform(0.0, 0.008);
  }
  return material;
}

void SetOtherConditions(Random& random, FitTrialScene& trial) {
  LidarNoise& lidar = trial.world.lidar;
  lidar.sigma_base_m = random.Uniform(0.003, 0.025);
  lidar.sigma_per_metre = random.Uniform(0.0, 0.003);
  lidar.sigma_at_threshold_m = random.Uniform(0.005, 0.05);
  lidar.walk_at_threshold_m = random.Uniform(0.0, 0.02);
  lidar.footprint_horizontal_rad = random.Uniform(0.002, 0.010);
  lidar.footprint_vertical_rad = random.Uniform(0.004, 0.020);
  lidar.footprint_side = 4;
  lidar.footprint =
      random.Chance(0.5) ? LidarNoise::Footprint::kGaussian : LidarNoise::Footprint::kEven;
  lidar.pulse_length_m = 0.08 * std::pow(1.5 / 0.08, random.Uniform());
  lidar.leading_edge = random.Uniform(0.0, 0.5);
  lidar.spurious_fraction = random.Uniform(0.0, 0.004);
  lidar.tail_degrees = 3 + random.Index(4);
  lidar.walk_of_black_m = random.Uniform(0.0, 0.020);
  MotorNoise& motor = trial.world.motor;
  motor.amplitude1_rad *= random.Uniform(0.0, 2.0);
  motor.amplitude2_rad *= random.Uniform(0.0, 2.0);
  motor.amplitude50_rad *= random.Uniform(0.0, 2.0);
  motor.backlash_rad *= random.Uniform(0.0, 2.0);
  trial.rig_error =
      CalibrationError{RadiansFromDegrees(random.Uniform(0.0, 0.2)), random.Uniform(0.0, 0.005)};
  if (random.Chance(0.125)) trial.scanned = random.Uniform(0.55, 0.90);
  trial.region = random.Chance(2.0 / 3.0) ? FitTrialScene::Region::kRectangle
                                          : FitTrialScene::Region::kTightBox;
}

void AddObjectPoints(const Scene& scene, std::size_t first_mesh, FitTrialScene& trial) {
  for (std::size_t i = first_mesh; i < scene.meshes.size(); ++i)
    for (const Eigen::Vector3f& vertex : scene.meshes[i].vertices)
      trial.object_points.push_back(vertex.cast<double>());
}

void AddOccluders(const Eigen::Vector3d& place, double radius_m, Random& random, Scene& scene) {
  if (random.Chance(0.4)) AddCable(place, radius_m, random, scene);
  if (random.Chance(0.2)) AddHand(place, radius_m, random, scene);
}

void AddOtherWall(const Eigen::Vector3d& foot, const Eigen::Vector3d& normal, double clear_m,
                  Random& random, Scene& scene) {
  const Pose pose(RotationBetween(Eigen::Vector3d::UnitZ(), normal), foot);
  SceneMesh wall = MeshOf("wall", OtherMaterial(random));
  AppendShape(RectangleShape(6.0, 6.0), pose, wall);
  scene.meshes.push_back(std::move(wall));
  const int count = random.Index(5);
  for (int i = 0; i < count; ++i) {
    SceneMesh thing = MeshOf("fitting on the wall", OtherMaterial(random));
    const double angle = random.Uniform(-std::numbers::pi, std::numbers::pi),
                 away = clear_m + random.Uniform(0.03, 0.4);
    const double high = random.Uniform(0.02, 0.12);
    const Eigen::Vector3d at(away * std::cos(angle), away * std::sin(angle), 0.5 * high);
    const Rigid<frame::Object, frame::Object> place(
        Eigen::Quaterniond(Eigen::AngleAxisd(random.Uniform(-std::numbers::pi, std::numbers::pi),
                                             Eigen::Vector3d::UnitZ())),
        at);
    if (random.Chance(0.5)) {
      AppendShape(BoxShape({random.Uniform(0.02, 0.25), random.Uniform(0.02, 0.25), high}),
                  pose * place, thing);
    } else {
      const double radius = 0.5 * high;
      const Eigen::Vector3d along(std::cos(angle + 0.5 * std::numbers::pi),
                                  std::sin(angle + 0.5 * std::numbers::pi), 0.0);
      AppendShape(CylinderShape(radius, 4.0), pose * PoseAlong(at - 2.0 * along, at + 2.0 * along),
                  thing);
    }
    scene.meshes.push_back(std::move(thing));
  }
}

}  // namespace foresight
