#include "core/evaluation/terrain_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/evaluation/terrain_distractors.h"
#include "core/evaluation/terrain_layout.h"
#include "core/geometry/angles.h"
#include "core/simulation/scene_objects.h"

namespace foresight {
namespace {

constexpr std::uint64_t kTerrainStream = 4343;
constexpr int kBlockColumns = 3;
constexpr double kLayer_m = 0.19;
constexpr int kLayers = 3;
constexpr double kTilt_rad = RadiansFromDegrees(15.0);
constexpr double kFlatFraction = 0.15;
constexpr double kJitter_m = 0.008;
constexpr int kNegativeEvery = 6;
constexpr std::uint64_t kScatterStream = 4344;
constexpr std::uint64_t kCartonStream = 4547;
constexpr int kCartonsEvery = 3;  // of the negatives
constexpr std::uint64_t kMixedStream = 4549;
constexpr int kMixedEvery = 4;      // of the positives
constexpr int kScatteredEvery = 6;  // of the positives
constexpr double kApart_m = 0.60;   // between the middles of scattered blocks
constexpr double kBlockSide_m = 0.39;
constexpr double kLeastOff = 0.10, kMostOff = 0.33;  // of a carton's side
constexpr double kLongestCarton_m = (1.0 + kMostOff) * kBlockSide_m;

/// Stands on its lowest edge: tilted about x (towards y or away) or y, or flat.
Eigen::Quaterniond BlockTilt(int row, int column, Random& random) {
  if (random.Uniform() < kFlatFraction) return Eigen::Quaterniond::Identity();
  const double tilt = kTilt_rad * random.Uniform(0.9, 1.1);
  const int way = (2 * row + column + (row % 2)) % 4;
  const Eigen::Vector3d axis = way % 2 == 0 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  return Eigen::Quaterniond(Eigen::AngleAxisd(way < 2 ? tilt : -tilt, axis));
}

/// What stands in a cell: a block, or a carton that a fit may take for one.
struct CellThing {
  Eigen::Vector3d size_m = BlockObject().size_m;
  bool block = true;
};

void AddCell(const CellThing& thing, const TerrainLayout& layout, const Eigen::Vector2d& at,
             double yaw_rad, int layer, const Eigen::Quaterniond& tilt, const Material& material,
             Random& random, Scene& scene) {
  const double base_m = layer * kLayer_m;
  if (layer > 0)
    AddBox("base", {0.38, 0.38, base_m}, layout.At({at.x(), at.y(), 0.5 * base_m}, yaw_rad),
           material, scene);
  // How far the top's middle is above the lowest corner of the block.
  double height_m = 0.0;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      height_m = std::max(
          height_m,
          -(tilt * Eigen::Vector3d(x * thing.size_m.x(), y * thing.size_m.y(), -thing.size_m.z()))
               .z());
  const Eigen::Vector3d shift(random.Uniform(-kJitter_m, kJitter_m),
                              random.Uniform(-kJitter_m, kJitter_m), 0.0);
  const auto cell = layout.At(Eigen::Vector3d(at.x(), at.y(), base_m + height_m) + shift,
                              yaw_rad + RadiansFromDegrees(random.Uniform(-1.5, 1.5)));
  const Rigid<frame::Robot, frame::Object> top(cell.rotation() * tilt, cell.translation());
  if (!thing.block) {
    AddBox("carton", thing.size_m,
           {top.rotation(), top * Eigen::Vector3d(0.0, 0.0, -0.5 * thing.size_m.z())}, material,
           scene);
    return;
  }
  BlockObject block;
  block.name = "block";
  block.material = material;
  block.size_m = thing.size_m;
  block.robot_from_object = top;
  AddBlock(block, scene);
}

/// Gives what stands in the next cell.
using NextThing = std::function<CellThing()>;

/// A field that rises away from the robot; the longest side of what stands in it is `longest_m`.
void AddField(const NextThing& next, double longest_m, const TerrainLayout& layout, int rows,
              Random& random, Scene& scene) {
  const double wider_m = longest_m - BlockObject().size_m.head<2>().maxCoeff();
  const double pitch_m = random.Uniform(0.405, 0.440) + std::max(0.0, wider_m);
  const Material one = RandomConcrete(random), other = RandomConcrete(random);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < kBlockColumns; ++column) {
      const double rise = static_cast<double>(row) / rows * kLayers + random.Uniform(-1.0, 0.6);
      const int layer = std::clamp(static_cast<int>(std::floor(rise)), 0, kLayers - 1);
      const Eigen::Vector2d at((row - 0.5 * (rows - 1)) * pitch_m,
                               (column - 0.5 * (kBlockColumns - 1)) * pitch_m);
      const Eigen::Quaterniond tilt = BlockTilt(row, column, random);
      AddCell(next(), layout, at, 0.0, layer, tilt, random.Uniform() < 0.7 ? one : other, random,
              scene);
    }
}

/// A few that stand as they fell, in no rows.
void AddScattered(const NextThing& next, const TerrainLayout& layout, int rows, Random& random,
                  Scene& scene) {
  const Material material = RandomConcrete(random);
  const int count = 2 + random.Index(5);
  std::vector<Eigen::Vector2d> places;
  for (int tries = 0; tries < 200 && std::ssize(places) < count; ++tries) {
    const Eigen::Vector2d at(random.Uniform(-0.21, 0.21) * rows, random.Uniform(-0.65, 0.65));
    if (std::any_of(places.begin(), places.end(),
                    [&](const Eigen::Vector2d& other) { return (at - other).norm() < kApart_m; }))
      continue;
    places.push_back(at);
    const Eigen::Quaterniond tilt = BlockTilt(random.Index(4), random.Index(4), random);
    AddCell(next(), layout, at, random.Uniform(-std::numbers::pi, std::numbers::pi),
            random.Index(2), tilt, material, random, scene);
  }
}

/// One side is a block's, the other a tenth to a third longer or shorter; shorter alone where
/// there is no room.
CellThing RandomCarton(Random& random, bool room = true) {
  const double off = random.Uniform(kLeastOff, kMostOff);
  CellThing carton{.size_m = {kBlockSide_m * (random.Chance(0.6) && room ? 1.0 + off : 1.0 - off),
                              random.Uniform(0.385, 0.402), random.Uniform(0.12, 0.25)},
                   .block = false};
  if (random.Chance(0.5)) std::swap(carton.size_m.x(), carton.size_m.y());
  return carton;
}

/// As blocks stand, so that nothing but their size tells them from blocks.
void AddCartons(const TerrainLayout& layout, int rows, Random& random, Scene& scene) {
  const CellThing carton = RandomCarton(random);
  const auto next = [&carton] { return carton; };
  if (random.Chance(0.5))
    AddField(next, carton.size_m.head<2>().maxCoeff(), layout, rows, random, scene);
  else
    AddScattered(next, layout, rows, random, scene);
}

CellThing JustBlocks() {
  return {};
}

/// What stands among blocks in a mixed region: a carton, or half a block and less.
CellThing RandomAmongBlocks(bool room, Random& random) {
  if (random.Chance(0.6)) return RandomCarton(random, room);
  CellThing piece{.size_m = {random.Uniform(0.15, 0.30), random.Uniform(0.15, 0.40),
                             random.Uniform(0.08, 0.25)},
                  .block = false};
  if (random.Chance(0.5)) std::swap(piece.size_m.x(), piece.size_m.y());
  return piece;
}

/// Blocks, and other things among them as often as `fraction` says.
NextThing Mixed(double fraction, bool room, Random& random) {
  return [fraction, room, &random] {
    return random.Chance(fraction) ? RandomAmongBlocks(room, random) : CellThing();
  };
}

/// What holds at least some blocks. Returns what.
std::string AddBlocks(std::uint64_t seed, const TerrainLayout& layout, int rows, Random& random,
                      Scene& scene) {
  Random scatter(seed, kScatterStream), mix(seed, kMixedStream);
  const bool mixed = mix.Index(kMixedEvery) == 0, room = mix.Chance(0.5);
  const double fraction = mix.Uniform(0.1, 0.6);
  const NextThing next = mixed ? Mixed(fraction, room, mix) : NextThing(JustBlocks);
  const std::string among = mixed ? ", other things among them" : "";
  if (scatter.Index(kScatteredEvery) == 0) {
    AddScattered(next, layout, rows, scatter, scene);
    return "scattered blocks" + among;
  }
  const double longest_m =
      mixed && room ? kLongestCarton_m : BlockObject().size_m.head<2>().maxCoeff();
  AddField(next, longest_m, layout, rows, random, scene);
  return fmt::format("field of {} x {} blocks", rows, kBlockColumns) + among;
}

ScanPlan RandomPlan(Random& random) {
  constexpr double kLinesPerSecond = 40.0;
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(-75.0);
  plan.to_rad = RadiansFromDegrees(0.0);
  plan.speed_rad_s = RadiansFromDegrees(kLinesPerSecond * random.Uniform(0.25, 1.0));
  plan.image_angles_rad = {RadiansFromDegrees(random.Uniform(-42.0, -34.0))};
  return plan;
}

}  // namespace

FitTrialScene RandomTerrainScene(std::uint64_t seed) {
  Random random(seed, kTerrainStream);
  const int rows = 3 + random.Index(3);
  TerrainLayout layout;
  layout.ground_m = random.Uniform(-0.20, 0.30);  // 1.6 to 1.1 m below the head
  layout.yaw_rad = RadiansFromDegrees(random.Uniform(-20.0, 20.0));
  const double near_m = random.Uniform(0.75, 1.05);
  layout.middle_m = {near_m + 0.21 * rows, random.Uniform(-0.15, 0.15)};

  auto scene = std::make_shared<Scene>();
  FitTrialScene trial;
  AddHall(layout, random, *scene);
  trial.positive = random.Index(kNegativeEvery) != 0;
  if (trial.positive) {
    trial.what = AddBlocks(seed, layout, rows, random, *scene);
  } else if (Random cartons(seed, kCartonStream); cartons.Index(kCartonsEvery) == 0) {
    AddCartons(layout, rows, cartons, *scene);
    trial.what = "cartons of nearly a block's size";
  } else {
    trial.what = AddTerrainDistractor(layout, random, *scene);
  }
  scene->name = trial.what;
  trial.scene = scene;
  trial.plan = RandomPlan(random);
  trial.world.lidar.sigma_base_m = random.Uniform(0.004, 0.020);
  trial.focus_m = {layout.middle_m.x(), layout.middle_m.y(), layout.ground_m + 0.2};
  trial.focus_radius_m = 0.5 * std::hypot(0.42 * rows, 0.42 * kBlockColumns);
  return trial;
}

}  // namespace foresight
