#include "core/evaluation/terrain_distractors.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

void AddStairs(const TerrainLayout& layout, Random& random, Scene& scene) {
  const double rise = random.Uniform(0.14, 0.20), tread = random.Uniform(0.24, 0.32);
  const double width = random.Uniform(0.9, 1.6);
  const Material material = RandomConcrete(random);
  for (int i = 1; i <= 5; ++i)
    AddBox("stair", {tread, width, i * rise},
           layout.At({(i - 3) * tread, 0.0, 0.5 * i * rise}, 0.0), material, scene);
}

/// Sides that differ from a block's by at least a seventh.
double OtherSide(Random& random) {
  return random.Uniform() < 0.5 ? random.Uniform(0.20, 0.335) : random.Uniform(0.46, 0.75);
}

void AddOtherBoxes(const TerrainLayout& layout, Random& random, Scene& scene) {
  const int count = 3 + random.Index(4);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d size(OtherSide(random), random.Uniform(0.2, 0.7),
                               random.Uniform(0.10, 0.35));
    const Eigen::Vector3d place((i / 3 - 0.5) * 0.85, (i % 3 - 1) * 0.80, 0.5 * size.z());
    AddBox("box", size, layout.At(place, random.Uniform(0.0, 1.5)), RandomConcrete(random), scene);
  }
}

void AddRamp(const TerrainLayout& layout, Random& random, Scene& scene) {
  const double slope = RadiansFromDegrees(random.Uniform(6.0, 20.0));
  const auto foot = layout.At({0.0, 0.0, 0.5 * std::sin(slope) * 1.6}, 0.0);
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(-slope, Eigen::Vector3d::UnitY()));
  AddBox("ramp", {1.6, random.Uniform(0.9, 1.4), 0.04},
         {foot.rotation() * tilt, foot.translation()}, RandomConcrete(random), scene);
}

void AddRubble(const TerrainLayout& layout, Random& random, Scene& scene) {
  const int count = 25 + random.Index(25);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d size(random.Uniform(0.06, 0.32), random.Uniform(0.06, 0.28),
                               random.Uniform(0.04, 0.16));
    const Eigen::Vector3d place(random.Uniform(-0.8, 0.8), random.Uniform(-0.7, 0.7),
                                random.Uniform(0.02, 0.22));
    const auto at = layout.At(place, random.Uniform(0.0, 3.1));
    const Eigen::Vector3d axis =
        Eigen::Vector3d(random.Normal(), random.Normal(), 0.2 * random.Normal()).normalized();
    const Eigen::Quaterniond tilt(
        Eigen::AngleAxisd(RadiansFromDegrees(random.Uniform(0.0, 25.0)), axis));
    AddBox("rubble", size, {at.rotation() * tilt, at.translation()}, RandomConcrete(random), scene);
  }
}

void AddTable(const TerrainLayout& layout, Random& random, Scene& scene) {
  const double height = random.Uniform(0.45, 0.75);
  const Material material = RandomConcrete(random);
  AddBox("table", {0.8, 1.4, 0.04}, layout.At({0.45, 0.0, height}, 0.0), material, scene);
  for (const double y : {-0.6, 0.6})
    AddBox("leg", {0.05, 0.05, height}, layout.At({0.15, y, 0.5 * height}, 0.0), material, scene);
}

void AddWall(const TerrainLayout& layout, Random& random, Scene& scene) {
  AddBox("wall", {0.15, 2.5, 2.4}, layout.At({0.3, 0.0, 1.2}, random.Uniform(-0.3, 0.3)),
         RandomConcrete(random), scene);
}

}  // namespace

std::string AddTerrainDistractor(const TerrainLayout& layout, Random& random, Scene& scene) {
  switch (random.Index(7)) {
    case 0:
      return "flat ground";
    case 1:
      AddStairs(layout, random, scene);
      return "stairs";
    case 2:
      AddOtherBoxes(layout, random, scene);
      return "boxes of other sizes";
    case 3:
      AddRamp(layout, random, scene);
      return "ramp";
    case 4:
      AddRubble(layout, random, scene);
      return "rubble";
    case 5:
      AddTable(layout, random, scene);
      return "table";
    default:
      AddWall(layout, random, scene);
      return "wall";
  }
}

}  // namespace foresight
