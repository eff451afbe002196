#include "core/evaluation/table_thing.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace foresight {
namespace {

using LocalPose = Rigid<frame::Object, frame::Object>;

/// The frame at a point whose z runs towards another and whose x is level.
LocalPose AlongFrom(const Eigen::Vector3d& from_m, const Eigen::Vector3d& towards_m) {
  const Eigen::Vector3d z = (towards_m - from_m).normalized();
  const Eigen::Vector3d level = Eigen::Vector3d::UnitZ().cross(z);
  const Eigen::Vector3d x =
      level.norm() > 1e-6 ? Eigen::Vector3d(level.normalized()) : Eigen::Vector3d::UnitY();
  Eigen::Matrix3d rotation;
  rotation << x, z.cross(x), z;
  return {Eigen::Quaterniond(rotation), from_m};
}

}  // namespace

TableThing::TableThing(std::string name, const Rigid<frame::Robot, frame::Object>& robot_from_place,
                       const Material& material) {
  mesh_.name = std::move(name);
  mesh_.material = material;
  mesh_.robot_from_object = robot_from_place;
}

void TableThing::Add(const Shape& shape, const LocalPose& place_from_shape) {
  AppendShape(shape, mesh_.robot_from_object * place_from_shape, mesh_);
}

void TableThing::AddBox(const Eigen::Vector3d& size_m, const Eigen::Vector3d& middle_m,
                        double yaw_rad) {
  Add(BoxShape(size_m),
      {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())), middle_m});
}

void TableThing::AddCylinder(double radius_m, const Eigen::Vector3d& from_m,
                             const Eigen::Vector3d& to_m) {
  Add(CylinderShape(radius_m, (to_m - from_m).norm()), PoseAlong(from_m, to_m));
}

void TableThing::AddRevolved(std::span<const Eigen::Vector2d> outline,
                             const Eigen::Vector3d& from_m, const Eigen::Vector3d& towards_m,
                             double flattened) {
  Shape shape = RevolvedShape(outline, false);
  for (Eigen::Vector3f& vertex : shape.vertices) vertex.x() *= static_cast<float>(flattened);
  Add(shape, AlongFrom(from_m, towards_m));
}

void TableThing::AddRevolved(std::initializer_list<Eigen::Vector2d> outline,
                             const Eigen::Vector3d& from_m, const Eigen::Vector3d& towards_m,
                             double flattened) {
  AddRevolved(std::vector<Eigen::Vector2d>(outline), from_m, towards_m, flattened);
}

void TableThing::AddGrip(const Eigen::Vector2d& half_m, std::span<const Eigen::Vector3d> path) {
  constexpr int kCorners = 24;
  // SweptShape's x is its `up` cross the path: y of the place.
  std::vector<Eigen::Vector2d> section;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    section.emplace_back(half_m.y() * std::cos(angle), half_m.x() * std::sin(angle));
  }
  Add(SweptShape(section, path, -Eigen::Vector3d::UnitX()),
      LocalPose(Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero()));
}

void TableThing::MoveTo(Scene& scene) {
  scene.meshes.push_back(std::move(mesh_));
}

}  // namespace foresight
