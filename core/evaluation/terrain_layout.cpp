#include "core/evaluation/terrain_layout.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/simulation/shapes.h"

namespace foresight {
namespace {

/// Ground that is nowhere quite flat: heights on a lattice.
void AddGround(const TerrainLayout& layout, Random& random, Scene& scene) {
  constexpr double kPitch_m = 0.12, kFrom_m = -1.0, kTo_m = 6.2, kHalfWidth_m = 3.6;
  const double roughness_m = random.Uniform(0.0, 0.003);
  SceneMesh mesh;
  mesh.name = "ground";
  mesh.material = RandomConcrete(random);
  const int along = static_cast<int>((kTo_m - kFrom_m) / kPitch_m);
  const int across = static_cast<int>(2.0 * kHalfWidth_m / kPitch_m);
  for (int i = 0; i <= along; ++i)
    for (int j = 0; j <= across; ++j)
      mesh.vertices.push_back(Eigen::Vector3d(kFrom_m + i * kPitch_m, -kHalfWidth_m + j * kPitch_m,
                                              layout.ground_m + roughness_m * random.Normal())
                                  .cast<float>());
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) {
      const int here = i * (across + 1) + j, next = here + across + 1;
      mesh.triangles.emplace_back(here, next, next + 1);
      mesh.triangles.emplace_back(here, next + 1, here + 1);
    }
  scene.meshes.push_back(std::move(mesh));
}

}  // namespace

Rigid<frame::Robot, frame::Object> TerrainLayout::At(const Eigen::Vector3d& place,
                                                     double turn_rad) const {
  const Eigen::AngleAxisd turn(yaw_rad, Eigen::Vector3d::UnitZ());
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad + turn_rad, Eigen::Vector3d::UnitZ())),
          turn * place + Eigen::Vector3d(middle_m.x(), middle_m.y(), ground_m)};
}

Material RandomConcrete(Random& random) {
  Material material;
  const double grey = random.Uniform(0.15, 0.65);
  for (int i = 0; i < 3; ++i) material.color[i] = grey * random.Uniform(0.92, 1.08);
  material.color2 = random.Uniform(0.6, 0.9) * material.color;
  material.pattern = random.Uniform() < 0.5 ? Material::Pattern::kNoise : Material::Pattern::kPlain;
  material.pattern_size_m = random.Uniform(0.008, 0.030);
  material.lidar_reflectance = random.Uniform(0.2, 0.6);
  return material;
}

void AddBox(const std::string& name, const Eigen::Vector3d& size_m,
            const Rigid<frame::Robot, frame::Object>& robot_from_box, const Material& material,
            Scene& scene) {
  SceneMesh mesh;
  mesh.name = name;
  mesh.material = material;
  mesh.robot_from_object = robot_from_box;
  AppendShape(BoxShape(size_m), robot_from_box, mesh);
  scene.meshes.push_back(std::move(mesh));
}

void AddHall(const TerrainLayout& layout, Random& random, Scene& scene) {
  AddGround(layout, random, scene);
  const Material wall = RandomConcrete(random);
  const auto at = [](double x, double y) {
    return Rigid<frame::Robot, frame::Object>(Eigen::Quaterniond::Identity(), {x, y, 1.5});
  };
  AddBox("back wall", {0.1, 8.0, 4.5}, at(5.5, 0.0), wall, scene);
  AddBox("left wall", {8.0, 0.1, 4.5}, at(2.0, 3.3), wall, scene);
  AddBox("right wall", {8.0, 0.1, 4.5}, at(2.0, -3.3), wall, scene);
  scene.ambient = random.Uniform(0.25, 0.45);
  scene.lights.push_back({{random.Uniform(0.0, 1.0), 2.0, 3.2}, random.Uniform(1.5, 2.8)});
  scene.lights.push_back({{random.Uniform(2.0, 3.0), -2.0, 3.4}, random.Uniform(1.0, 2.0)});
}

}  // namespace foresight
