#include "core/fitting/line_normals.h"

#include <Eigen/Geometry>
#include <map>

namespace foresight {
namespace {

/// Two beams of a line span its plane; the two that are furthest apart do it best.
std::map<int, Eigen::Vector3d> WidestOfEachLine(const RaySet& set) {
  std::map<int, const RangeRay*> first;
  std::map<int, Eigen::Vector3d> widest;
  for (const RangeRay& ray : set.rays) {
    const auto [entry, is_first] = first.emplace(ray.cell.y(), &ray);
    if (is_first) continue;
    const RangeRay& other = *entry->second;
    const double side = ray.cell.x() > other.cell.x() ? 1.0 : -1.0;
    const Eigen::Vector3d normal = side * other.direction.cross(ray.direction);
    Eigen::Vector3d& best = widest.try_emplace(ray.cell.y(), Eigen::Vector3d::Zero()).first->second;
    if (normal.squaredNorm() > best.squaredNorm()) best = normal;
  }
  return widest;
}

}  // namespace

std::vector<Eigen::Vector3d> LineNormalsOf(const RaySet& rays) {
  std::vector<Eigen::Vector3d> normals(rays.rays.size(), Eigen::Vector3d::Zero());
  if (!(rays.footprint_height_rad > 0.0) || rays.rays.empty() || rays.rays.front().cell.x() < 0)
    return normals;
  const std::map<int, Eigen::Vector3d> of_line = WidestOfEachLine(rays);
  Eigen::Vector3d usual = Eigen::Vector3d::Zero();
  for (const auto& [line, normal] : of_line) usual += normal;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const auto own = of_line.find(rays.rays[i].cell.y());
    const Eigen::Vector3d normal = own != of_line.end() ? own->second : usual;
    if (normal.norm() > 0.0) normals[i] = normal.normalized();
  }
  return normals;
}

}  // namespace foresight
