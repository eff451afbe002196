#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "core/base/random.h"
#include "core/fitting/ray_set.h"
#include "core/simulation/ray_caster.h"
#include "core/simulation/scene_objects.h"
#include "core/simulation/shapes.h"

namespace foresight::samples {

/// A table with something on it as a lidar sees it: the simulator's meshes, cast by Embree.
struct DrillView {
  enum class Object { kDrill, kNothing, kBox, kBottle, kBoxOnCylinder };
  Object object = Object::kDrill;
  DrillShape shape;
  double yaw_rad = 0.6;
  double distance_m = 1.1;
  double above_m = 0.45;  ///< of the head over the table
  double wall_m = 0.5;    ///< behind; 0 = none
  bool table = true;
  bool clutter = false;  ///< other things stand beside it
  double spacing_rad = 0.0065;
  double sigma_m = 0.008;
  std::uint64_t seed = 1;
};

struct DrillRays {
  RaySet rays;
  Rigid<frame::Base, frame::Object> base_from_object;
};

inline void AddSolid(const Shape& shape, const Rigid<frame::Robot, frame::Object>& at,
                     Scene& scene) {
  SceneMesh mesh;
  mesh.robot_from_object = at;
  AppendShape(shape, at, mesh);
  scene.meshes.push_back(std::move(mesh));
}

/// The rays of a region round the object; base is at the head, x right, y down, z forward.
inline DrillRays MakeDrillRays(const DrillView& view) {
  using Pose = Rigid<frame::Robot, frame::Object>;
  const auto at = [](double x, double y, double z, double yaw = 0.0) {
    return Pose(Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())), {x, y, z});
  };
  auto scene = std::make_shared<Scene>();
  const double table_z = -view.above_m;
  const Pose stand = at(view.distance_m, 0.0, table_z, view.yaw_rad);
  if (view.table)
    AddSolid(BoxShape({0.9, 1.2, 0.04}), at(view.distance_m + 0.2, 0.0, table_z - 0.02), *scene);
  if (view.wall_m > 0.0)
    AddSolid(BoxShape({0.05, 5.0, 5.0}), at(view.distance_m + view.wall_m + 0.025, 0.0, 0.0),
             *scene);
  if (view.clutter)
    for (const double side : {0.16, -0.17})
      AddSolid(BoxShape({0.08, 0.08, 0.19}), at(view.distance_m + 0.05, side, table_z + 0.095, 0.3),
               *scene);
  const auto add = [&](const Shape& shape, double z) {
    AddSolid(
        shape,
        stand * Rigid<frame::Object, frame::Object>(Eigen::Quaterniond::Identity(), {0.0, 0.0, z}),
        *scene);
  };
  switch (view.object) {
    case DrillView::Object::kDrill: {
      DrillObject drill;
      drill.robot_from_object = stand;
      drill.shape = view.shape;
      AddDrill(drill, *scene);
      break;
    }
    case DrillView::Object::kBox:
      add(BoxShape({0.12, 0.08, 0.22}), 0.11);
      break;
    case DrillView::Object::kBottle:
      add(CylinderShape(0.035, 0.24), 0.12);
      break;
    case DrillView::Object::kBoxOnCylinder:
      add(CylinderShape(0.028, 0.17), 0.085);
      add(BoxShape({0.16, 0.06, 0.06}), 0.20);
      break;
    case DrillView::Object::kNothing:
      break;
  }
  Eigen::Matrix3d base_from_robot_turn;
  base_from_robot_turn << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  const Rigid<frame::Base, frame::Robot> base_from_robot(base_from_robot_turn,
                                                         Eigen::Vector3d::Zero());
  DrillRays made;
  made.base_from_object = base_from_robot * stand;
  made.rays.sigma_m = view.sigma_m;
  made.rays.footprint_rad = 0.0044;
  const RayCaster caster(scene);
  Random random(view.seed, 78);
  const double middle = std::atan2(view.above_m - 0.12, view.distance_m);
  const double half = 0.21 / std::hypot(view.distance_m, view.above_m - 0.12);
  for (double down = middle - half; down < middle + half; down += view.spacing_rad)
    for (double left = -half; left < half; left += 0.7 * view.spacing_rad) {
      const Eigen::Vector3d direction(std::cos(down) * std::cos(left),
                                      std::cos(down) * std::sin(left), -std::sin(down));
      const SceneHit hit =
          caster.Cast({Eigen::Vector3f::Zero(), direction.cast<float>().normalized()});
      if (!(hit.distance_m > 0.0f)) continue;
      made.rays.rays.push_back({Eigen::Vector3d::Zero(), base_from_robot.Rotate(direction),
                                hit.distance_m + view.sigma_m * random.Normal()});
    }
  return made;
}

}  // namespace foresight::samples
