#include "core/fitting/solids/part_edges.h"

#include <array>
#include <cmath>
#include <numbers>

namespace foresight {
namespace {

constexpr std::size_t kChords = 16;
constexpr std::size_t kMostEdges = 2 + 2 * kChords;

/// Corners of a circle of radius 1, the last one the first again, and between them their middles.
struct Circle {
  std::array<Eigen::Vector2d, kChords + 1> corner;
  std::array<Eigen::Vector2d, kChords> middle;
};

const Circle& UnitCircle() {
  static const Circle circle = [] {
    const auto at = [](double chords) {
      const double angle = 2.0 * std::numbers::pi * chords / kChords;
      return Eigen::Vector2d(std::cos(angle), std::sin(angle));
    };
    Circle made;
    for (std::size_t i = 0; i < kChords; ++i) {
      made.corner[i] = at(static_cast<double>(i));
      made.middle[i] = at(static_cast<double>(i) + 0.5);
    }
    made.corner[kChords] = made.corner[0];
    return made;
  }();
  return circle;
}

void AddBox(const Eigen::Vector3d& half, const Eigen::Vector3d& eye, std::vector<PartEdge>& edges) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const double side_u : {-1.0, 1.0})
      for (const double side_v : {-1.0, 1.0}) {
        const bool seen_u = side_u * eye[u] > half[u], seen_v = side_v * eye[v] > half[v];
        if (seen_u == seen_v) continue;
        Eigen::Vector3d from;
        from[axis] = -half[axis];
        from[u] = side_u * half[u];
        from[v] = side_v * half[v];
        Eigen::Vector3d to = from;
        to[axis] = half[axis];
        edges.push_back({from, to});
      }
  }
}

void AddSides(const Eigen::Vector3d& half, const Eigen::Vector3d& eye,
              std::vector<PartEdge>& edges) {
  const double distance = eye.head<2>().norm(), radius = half.x();
  if (!(distance > radius && half.z() > 0.0)) return;
  const double towards = std::atan2(eye.y(), eye.x()), open = std::acos(radius / distance);
  for (const double angle : {towards - open, towards + open}) {
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    edges.push_back({{x, y, -half.z()}, {x, y, half.z()}});
  }
}

/// Where of a cap and the side next to it one is seen.
void AddRims(const Eigen::Vector3d& half, const Eigen::Vector3d& eye,
             std::vector<PartEdge>& edges) {
  const Circle& circle = UnitCircle();
  const double radius = half.x();
  for (const double end : {-1.0, 1.0}) {
    const bool cap_seen = end * eye.z() > half.z();
    const double z = end * half.z();
    for (std::size_t i = 0; i < kChords; ++i) {
      const bool side_seen = eye.head<2>().dot(circle.middle[i]) > radius;
      if (cap_seen == side_seen) continue;
      const Eigen::Vector2d from = radius * circle.corner[i], to = radius * circle.corner[i + 1];
      edges.push_back({{from.x(), from.y(), z}, {to.x(), to.y(), z}});
    }
  }
}

/// The outlines of the balls at ends where nothing goes on, outside of the cylinder between them.
void AddBalls(const SolidPart& part, const Eigen::Vector3d& eye, std::vector<PartEdge>& edges) {
  const Eigen::Vector3d half = 0.5 * part.size_m;
  const Circle& circle = UnitCircle();
  const double radius = half.x();
  for (const double end : {-1.0, 1.0}) {
    if (part.joined[end > 0.0 ? 1 : 0]) continue;
    const Eigen::Vector3d middle(0.0, 0.0, end * half.z());
    const Eigen::Vector3d to_eye = (eye - middle).normalized();
    const Eigen::Vector3d x = to_eye.unitOrthogonal(), y = to_eye.cross(x);
    const auto at = [&](std::size_t i) -> Eigen::Vector3d {
      return middle + radius * (circle.corner[i].x() * x + circle.corner[i].y() * y);
    };
    for (std::size_t i = 0; i < kChords; ++i) {
      const Eigen::Vector3d from = at(i), to = at(i + 1);
      if (end * (from.z() + to.z()) > 2.0 * half.z()) edges.push_back({from, to});
    }
  }
}

}  // namespace

std::vector<PartEdge> EdgesSeenFrom(const SolidPart& part, const Eigen::Vector3d& eye) {
  const Eigen::Vector3d half = 0.5 * part.size_m;
  std::vector<PartEdge> edges;
  edges.reserve(kMostEdges);
  switch (part.shape) {
    case SolidPart::Shape::kBox:
      AddBox(half, eye, edges);
      break;
    case SolidPart::Shape::kCylinder:
      AddSides(half, eye, edges);
      AddRims(half, eye, edges);
      break;
    case SolidPart::Shape::kCapsule:
      AddSides(half, eye, edges);
      AddBalls(part, eye, edges);
      break;
  }
  return edges;
}

}  // namespace foresight
