#include "core/objects/solid_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/objects/solid_distance.h"

namespace foresight {
namespace {

Wireframe BoxLines(const Eigen::Vector3d& half) {
  const auto corner = [&half](int x, int y, int z) -> Eigen::Vector3d {
    return half.cwiseProduct(Eigen::Vector3d(x, y, z));
  };
  Wireframe lines;
  for (const int z : {-1, 1})
    lines.push_back({corner(-1, -1, z), corner(1, -1, z), corner(1, 1, z), corner(-1, 1, z),
                     corner(-1, -1, z)});
  for (const int x : {-1, 1})
    for (const int y : {-1, 1}) lines.push_back({corner(x, y, -1), corner(x, y, 1)});
  return lines;
}

Wireframe CylinderLines(double radius, double half_length) {
  Wireframe lines = {CircleAroundZ(radius, -half_length), CircleAroundZ(radius, half_length)};
  for (int i = 0; i < 4; ++i) {
    const double angle = 0.5 * std::numbers::pi * i;
    const Eigen::Vector3d side(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    lines.push_back({side - half_length * Eigen::Vector3d::UnitZ(),
                     side + half_length * Eigen::Vector3d::UnitZ()});
  }
  return lines;
}

}  // namespace

std::vector<Eigen::Vector3d> CircleAroundZ(double radius, double z) {
  constexpr int kCorners = 64;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return points;
}

Status SolidPart::Check() const {
  if (!(size_m.minCoeff() > 0.0) || !size_m.allFinite())
    return Fail(ErrorCode::kInvalidOptions, "part '{}': size {} x {} x {} m is not above 0", name,
                size_m.x(), size_m.y(), size_m.z());
  if (!object_from_part.translation().allFinite() ||
      !object_from_part.rotation().coeffs().allFinite())
    return Fail(ErrorCode::kInvalidOptions, "part '{}': its pose is not finite", name);
  if (shape != Shape::kBox && size_m.x() != size_m.y())
    return Fail(ErrorCode::kInvalidOptions, "part '{}': {} m by {} m is not round", name,
                size_m.x(), size_m.y());
  return {};
}

double DistanceToSolid(SolidPart::Shape shape, const Eigen::Vector3d& point,
                       const Eigen::Vector3d& half) {
  if (shape == SolidPart::Shape::kBox) {
    const Eigen::Vector3d beyond = point.cwiseAbs() - half;
    return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
  }
  const double radial = point.head<2>().norm();
  const double beyond_end = std::abs(point.z()) - half.z();
  if (shape == SolidPart::Shape::kCapsule) {
    const double end = std::max(beyond_end, 0.0);
    return std::sqrt(radial * radial + end * end) - half.x();
  }
  const Eigen::Vector2d beyond(radial - half.x(), beyond_end);
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

double SolidPart::Distance(const Eigen::Vector3d& point) const {
  return DistanceToSolid(shape, object_from_part.Inverse() * point, 0.5 * size_m);
}

Wireframe WireframeOf(const SolidPart& part) {
  Wireframe lines;
  switch (part.shape) {
    case SolidPart::Shape::kBox:
      lines = BoxLines(0.5 * part.size_m);
      break;
    case SolidPart::Shape::kCylinder:
    case SolidPart::Shape::kCapsule:
      lines = CylinderLines(0.5 * part.size_m.x(), 0.5 * part.size_m.z());
      break;
  }
  for (auto& line : lines)
    for (Eigen::Vector3d& point : line) point = part.object_from_part * point;
  return lines;
}

}  // namespace foresight
