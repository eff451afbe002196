#include "core/evaluation/other_terrain_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/evaluation/other_world.h"
#include "core/geometry/angles.h"
#include "core/simulation/scene_objects.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Robot, frame::Object>;
using LocalPose = Rigid<frame::Object, frame::Object>;

constexpr std::uint64_t kOtherTerrainStream = 91003;
constexpr double kSizeOk_m = 0.015;
constexpr double kMostOff_m = 0.012;

/// Stone, timber, rubber mats, wet metal: the walls of OtherMaterial, but duller.
Material Stone(Random& random) {
  Material material = OtherMaterial(random);
  material.specular *= 0.3;
  material.translucency = 0.0;
  return material;
}

/// Ground with a slope and bumps.
void AddGround(double ground_m, Random& random, Scene& scene) {
  constexpr int kAlong = 60, kAcross = 60;
  constexpr double kPitch_m = 0.13;
  const double rough_m = random.Uniform(0.0, 0.006), wave_m = random.Uniform(0.0, 0.015);
  const double phase = random.Uniform(-std::numbers::pi, std::numbers::pi);
  const Eigen::Vector2d slope(0.02 * random.Normal(), 0.02 * random.Normal());
  SceneMesh mesh = OtherMeshAt("ground", Pose(), Stone(random));
  for (int i = 0; i <= kAlong; ++i)
    for (int j = 0; j <= kAcross; ++j) {
      const Eigen::Vector2d at(-1.0 + kPitch_m * i, kPitch_m * (j - kAcross / 2));
      const double z = ground_m + slope.dot(at - Eigen::Vector2d(1.5, 0.0)) +
                       wave_m * std::sin(2.0 * at.x() + 1.3 * at.y() + phase) +
                       rough_m * random.Normal();
      mesh.vertices.push_back(Eigen::Vector3d(at.x(), at.y(), z).cast<float>());
    }
  for (int i = 0; i < kAlong; ++i)
    for (int j = 0; j < kAcross; ++j) {
      const int here = i * (kAcross + 1) + j, next = here + kAcross + 1;
      mesh.triangles.emplace_back(here, next, next + 1);
      mesh.triangles.emplace_back(here, next + 1, here + 1);
    }
  scene.meshes.push_back(std::move(mesh));
}

/// A box with a corner knocked off its top: its outline is an octagon with uneven cuts.
Shape ChippedBox(const Eigen::Vector3d& size, Random& random) {
  const double x = 0.5 * size.x(), y = 0.5 * size.y();
  const auto cut = [&] { return random.Chance(0.3) ? random.Uniform(0.005, 0.03) : 0.002; };
  const double a = cut(), b = cut(), c = cut(), d = cut();
  const std::vector<Eigen::Vector2d> outline = {{x - a, -y},  {x, -y + a}, {x, y - b},
                                                {x - b, y},   {-x + c, y}, {-x, y - c},
                                                {-x, -y + d}, {-x + d, -y}};
  const std::vector<Eigen::Vector3d> path = {{0.0, 0.0, -size.z()}, {0.0, 0.0, 0.0}};
  return SweptShape(outline, path, Eigen::Vector3d::UnitY());
}

/// Two halves with a gap, its top's middle at the pose.
void AddStone(const Eigen::Vector3d& size, const Pose& pose, const Material& material,
              Random& random, Scene& scene) {
  SceneMesh mesh = OtherMeshAt("stone", pose, material);
  const double gap = random.Chance(0.6) ? random.Uniform(0.001, 0.010) : 0.0;
  const Eigen::Vector3d half(size.x(), 0.5 * (size.y() - gap), size.z());
  for (const double side : {-1.0, 1.0})
    AppendShape(ChippedBox(half, random),
                pose * LocalPose(Eigen::Quaterniond::Identity(),
                                 {0.0, side * 0.25 * (size.y() + gap), 0.0}),
                mesh);
  scene.meshes.push_back(std::move(mesh));
  if (HasBlockSize(size)) scene.blocks.push_back({"block", pose, size});
}

Eigen::Vector3d OffSize(Random& random) {
  Eigen::Vector3d size = BlockObject().size_m;
  for (int axis = 0; axis < 3; ++axis) size[axis] += random.Uniform(-kMostOff_m, kMostOff_m);
  return size;
}

/// Half blocks, pavers, sleepers, crates.
Eigen::Vector3d OtherSize(Random& random) {
  switch (random.Index(4)) {
    case 0:
      return {0.397, random.Uniform(0.18, 0.21), 0.19};
    case 1:
      return {random.Uniform(0.28, 0.33), random.Uniform(0.28, 0.33), 0.06};
    case 2:
      return {random.Uniform(0.6, 0.9), random.Uniform(0.16, 0.26), 0.15};
    default:
      return {random.Uniform(0.44, 0.6), random.Uniform(0.34, 0.6), random.Uniform(0.1, 0.3)};
  }
}

/// How far the lowest corner lies below the middle of the top.
double DepthOf(const Eigen::Vector3d& size, const Eigen::Quaterniond& tilt) {
  double depth = 0.0;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      depth = std::max(depth, -(tilt * Eigen::Vector3d(x * size.x(), y * size.y(), -size.z())).z());
  return depth;
}

struct Ground {
  double height_m = 0.0;
  double yaw_rad = 0.0;
  Eigen::Vector2d middle_m = Eigen::Vector2d::Zero();
};

void AddOne(const Ground& ground, const Eigen::Vector2d& at, double yaw_rad, double base_m,
            const Eigen::Vector3d& size, const Material& material, Random& random, Scene& scene) {
  const Eigen::Quaterniond tilt(
      Eigen::AngleAxisd(RadiansFromDegrees(random.Uniform(0.0, 20.0)),
                        Eigen::AngleAxisd(random.Uniform(-std::numbers::pi, std::numbers::pi),
                                          Eigen::Vector3d::UnitZ()) *
                            Eigen::Vector3d::UnitX()));
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(ground.yaw_rad + yaw_rad, Eigen::Vector3d::UnitZ()));
  const Eigen::Vector2d place = ground.middle_m + Eigen::Rotation2Dd(ground.yaw_rad) * at;
  const double z = ground.height_m + base_m;
  if (base_m > 0.0) {
    const Pose base(turn, {place.x(), place.y(), z - 0.5 * base_m});
    SceneMesh mesh = OtherMeshAt("base", base, material);
    AppendShape(BoxShape({0.9 * size.x(), 0.9 * size.y(), base_m}), base, mesh);
    scene.meshes.push_back(std::move(mesh));
  }
  AddStone(size, {turn * tilt, {place.x(), place.y(), z + DepthOf(size, tilt)}}, material, random,
           scene);
}

/// A hose or a cable that lies across.
void AddHose(const Ground& ground, Random& random, Scene& scene) {
  const double radius = random.Uniform(0.004, 0.02),
               turn = random.Uniform(-std::numbers::pi, std::numbers::pi);
  const Eigen::Vector3d along(std::cos(turn), std::sin(turn), 0.0);
  const Eigen::Vector3d beside(-along.y(), along.x(), 0.0);
  const Eigen::Vector3d middle(ground.middle_m.x(), ground.middle_m.y(),
                               ground.height_m + random.Uniform(0.15, 0.5));
  std::vector<Eigen::Vector2d> section;
  for (int i = 0; i < 14; ++i)
    section.emplace_back(radius * std::cos(2.0 * std::numbers::pi * i / 14),
                         radius * std::sin(2.0 * std::numbers::pi * i / 14));
  const double off = random.Uniform(-0.4, 0.4);
  std::vector<Eigen::Vector3d> path;
  for (int i = 0; i <= 30; ++i) {
    const double t = i / 15.0 - 1.0;
    path.push_back(middle + 1.2 * t * along + (off + 0.12 * std::sin(4.0 * t)) * beside);
  }
  SceneMesh mesh = OtherMeshAt("hose", Pose(), OtherMaterial(random));
  AppendShape(SweptShape(section, path, Eigen::Vector3d::UnitZ()), Pose(), mesh);
  scene.meshes.push_back(std::move(mesh));
}

ScanPlan OtherPlan(Random& random) {
  constexpr double kLinesPerSecond = 40.0;
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(random.Uniform(-80.0, -65.0));
  plan.to_rad = RadiansFromDegrees(random.Uniform(-8.0, 5.0));
  plan.speed_rad_s = RadiansFromDegrees(kLinesPerSecond * random.Uniform(0.2, 0.9));
  plan.image_angles_rad = {RadiansFromDegrees(random.Uniform(-45.0, -32.0))};
  return plan;
}

}  // namespace

bool HasBlockSize(const Eigen::Vector3d& size_m) {
  return ((size_m - BlockObject().size_m).head<2>().cwiseAbs().array() <= kSizeOk_m).all();
}

FitTrialScene OtherTerrainScene(std::uint64_t seed) {
  Random random(seed, kOtherTerrainStream);
  FitTrialScene trial;
  const double kind = random.Uniform();
  const bool of_blocks = kind > 1.0 / 5.0, heap = kind < 0.45;
  const double mixed = random.Chance(0.5) ? random.Uniform(0.1, 0.4) : 0.0;
  const int rows = 2 + random.Index(4), columns = 2 + random.Index(3);
  Ground ground;
  ground.height_m = random.Uniform(-0.30, 0.35);
  ground.yaw_rad = random.Uniform(-0.6, 0.6);
  ground.middle_m = {random.Uniform(1.1, 1.5) + 0.16 * rows, random.Uniform(-0.3, 0.3)};

  auto scene = std::make_shared<Scene>();
  scene->ambient = random.Uniform(0.2, 0.6);
  scene->lights.push_back(
      {{random.Uniform(-0.5, 2.0), random.Uniform(-2.0, 2.0), 3.0}, random.Uniform(0.8, 3.0)});
  AddGround(ground.height_m, random, *scene);
  AddOtherWall({6.0, 0.0, 1.0}, -Eigen::Vector3d::UnitX(), 0.3, random, *scene);
  const std::size_t first = scene->meshes.size();
  const Material one = Stone(random), two = Stone(random);
  const double pitch = random.Uniform(0.43, 0.52);
  const double layer = random.Uniform(0.10, 0.26);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const bool block = of_blocks && !random.Chance(mixed);
      const Eigen::Vector3d size = block ? OffSize(random) : OtherSize(random);
      const double step = heap ? 0.80 : pitch + (of_blocks ? 0.0 : 0.3);
      Eigen::Vector2d at((row - 0.5 * (rows - 1)) * step, (column - 0.5 * (columns - 1)) * step);
      at += Eigen::Vector2d(random.Uniform(-0.015, 0.015), random.Uniform(-0.015, 0.015));
      const double yaw = heap ? random.Uniform(-std::numbers::pi, std::numbers::pi)
                              : RadiansFromDegrees(3.0 * random.Normal());
      AddOne(ground, at, yaw, layer * random.Index(3), size, random.Chance(0.5) ? one : two, random,
             *scene);
    }
  AddObjectPoints(*scene, first, trial);
  if (random.Chance(0.4)) AddHose(ground, random, *scene);
  trial.positive = !scene->blocks.empty();
  trial.what = fmt::format("{} of {}", heap ? "heap" : "rows",
                           !trial.positive ? "other boxes"
                           : mixed > 0.0   ? "blocks and other boxes"
                                           : "blocks");
  SetOtherConditions(random, trial);
  scene->name = trial.what;
  trial.scene = scene;
  trial.plan = OtherPlan(random);
  trial.focus_m = {ground.middle_m.x(), ground.middle_m.y(), ground.height_m + 0.2};
  trial.focus_radius_m = 0.25 * std::hypot(rows, columns);
  return trial;
}

}  // namespace foresight
