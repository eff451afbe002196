#include "core/simulation/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/contract.h"
#include "core/geometry/rotation_between.h"

namespace foresight {
namespace {

constexpr int kCornersPerTurn = 128;
constexpr int kTubeCorners = 32;
constexpr int kArcCorners = 24;  ///< of a quarter circle from pole to equator

/// Points (radius, z) of an outline; turning them around z makes a surface.
using Outline = std::vector<Eigen::Vector2d>;

void AddQuad(int a, int b, int c, int d, Shape& shape) {
  shape.triangles.emplace_back(a, b, c);
  shape.triangles.emplace_back(a, c, d);
}

Shape Revolve(std::span<const Eigen::Vector2d> outline, bool closed) {
  Shape shape;
  const int points = static_cast<int>(outline.size());
  for (int i = 0; i < kCornersPerTurn; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCornersPerTurn;
    for (const Eigen::Vector2d& p : outline)
      shape.vertices.push_back(
          Eigen::Vector3d(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y()).cast<float>());
  }
  for (int i = 0; i < kCornersPerTurn; ++i) {
    const int here = i * points;
    const int next = (i + 1) % kCornersPerTurn * points;
    for (int j = 0; j < (closed ? points : points - 1); ++j) {
      const int k = (j + 1) % points;
      // A pole has no width: one of the two triangles would have no area.
      if (outline[static_cast<std::size_t>(j)].x() > 0.0)
        shape.triangles.emplace_back(here + j, next + j, next + k);
      if (outline[static_cast<std::size_t>(k)].x() > 0.0)
        shape.triangles.emplace_back(here + j, next + k, here + k);
    }
  }
  return shape;
}

/// A quarter circle in the outline plane around (0, center_z), from `from_rad` on.
void AddArc(double radius, double center_z, double from_rad, Outline& outline) {
  for (int i = 0; i <= kArcCorners; ++i) {
    const double angle = from_rad + 0.5 * std::numbers::pi * i / kArcCorners;
    // Exactly on the axis at the poles, where cos leaves 6e-17.
    const double r = radius * std::cos(angle);
    outline.emplace_back(r < 1e-12 ? 0.0 : r, center_z + radius * std::sin(angle));
  }
}

}  // namespace

Shape BoxShape(const Eigen::Vector3d& size_m) {
  Shape shape;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
    shape.vertices.push_back(corner.cwiseProduct(size_m).cast<float>());
  }
  AddQuad(0, 2, 3, 1, shape);  // z-
  AddQuad(4, 5, 7, 6, shape);  // z+
  AddQuad(0, 1, 5, 4, shape);  // y-
  AddQuad(2, 6, 7, 3, shape);  // y+
  AddQuad(0, 4, 6, 2, shape);  // x-
  AddQuad(1, 3, 7, 5, shape);  // x+
  return shape;
}

Shape RectangleShape(double width_m, double height_m) {
  Shape shape;
  const auto x = static_cast<float>(0.5 * width_m);
  const auto y = static_cast<float>(0.5 * height_m);
  shape.vertices = {{-x, -y, 0.0f}, {x, -y, 0.0f}, {x, y, 0.0f}, {-x, y, 0.0f}};
  AddQuad(0, 1, 2, 3, shape);
  return shape;
}

Shape CylinderShape(double radius_m, double length_m) {
  const double half = 0.5 * length_m;
  const Outline outline = {{0.0, -half}, {radius_m, -half}, {radius_m, half}, {0.0, half}};
  return Revolve(outline, false);
}

Shape SphereShape(double radius_m) {
  return CapsuleShape(radius_m, 0.0);
}

Shape TorusShape(double radius_m, double tube_radius_m) {
  Outline outline;
  for (int i = 0; i < kTubeCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kTubeCorners;
    outline.emplace_back(radius_m + tube_radius_m * std::cos(angle),
                         tube_radius_m * std::sin(angle));
  }
  return Revolve(outline, true);
}

Shape CapsuleShape(double radius_m, double length_m) {
  Outline outline;
  AddArc(radius_m, -0.5 * length_m, -0.5 * std::numbers::pi, outline);
  // A sphere's two arcs meet at the equator: without length its point stands there only once.
  if (length_m == 0.0) outline.pop_back();
  AddArc(radius_m, 0.5 * length_m, 0.0, outline);
  return Revolve(outline, false);
}

Shape DishShape(double radius_m, double dish_m, double thickness_m) {
  const Eigen::Vector2d along = Eigen::Vector2d(radius_m, dish_m).normalized();
  const Eigen::Vector2d half = 0.5 * thickness_m * Eigen::Vector2d(-along.y(), along.x());
  const Eigen::Vector2d hub(0.0, -dish_m);
  const Eigen::Vector2d rim(radius_m, 0.0);
  const double half_at_axis = 0.5 * thickness_m / along.x();
  const Outline outline = {hub - Eigen::Vector2d(0.0, half_at_axis), rim - half, rim + half,
                           hub + Eigen::Vector2d(0.0, half_at_axis)};
  return Revolve(outline, false);
}

Shape RevolvedShape(std::span<const Eigen::Vector2d> outline, bool closed) {
  FORESIGHT_EXPECTS(outline.size() >= 2, "an outline has two points");
  return Revolve(outline, closed);
}

Shape SweptShape(std::span<const Eigen::Vector2d> section, std::span<const Eigen::Vector3d> path,
                 const Eigen::Vector3d& up, std::span<const double> scales) {
  FORESIGHT_EXPECTS(section.size() >= 3 && path.size() >= 2, "a section moves along a path");
  FORESIGHT_EXPECTS(scales.empty() || scales.size() == path.size(), "a scale for each point");
  Shape shape;
  const int corners = static_cast<int>(section.size());
  const int points = static_cast<int>(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Eigen::Vector3d along =
        (path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0]).normalized();
    const Eigen::Vector3d x = up.cross(along).normalized();
    const Eigen::Vector3d y = along.cross(x);
    const double scale = scales.empty() ? 1.0 : scales[i];
    for (const Eigen::Vector2d& corner : section)
      shape.vertices.push_back((path[i] + scale * (corner.x() * x + corner.y() * y)).cast<float>());
  }
  for (int i = 0; i + 1 < points; ++i)
    for (int j = 0; j < corners; ++j) {
      const int here = i * corners, next = here + corners, k = (j + 1) % corners;
      AddQuad(here + j, here + k, next + k, next + j, shape);
    }
  for (int j = 1; j + 1 < corners; ++j) {
    const int last = (points - 1) * corners;
    shape.triangles.emplace_back(0, j + 1, j);
    shape.triangles.emplace_back(last, last + j, last + j + 1);
  }
  return shape;
}

void AppendShape(const Shape& shape, const Rigid<frame::Robot, frame::Object>& robot_from_shape,
                 SceneMesh& mesh) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (const Eigen::Vector3f& vertex : shape.vertices)
    mesh.vertices.push_back((robot_from_shape * vertex.cast<double>()).cast<float>());
  for (const Eigen::Vector3i& triangle : shape.triangles)
    mesh.triangles.push_back(triangle + Eigen::Vector3i::Constant(first));
}

Rigid<frame::Object, frame::Object> PoseAlong(const Eigen::Vector3d& from,
                                              const Eigen::Vector3d& to) {
  FORESIGHT_EXPECTS((to - from).norm() > 0.0, "two equal points make no direction");
  return {RotationBetween(Eigen::Vector3d::UnitZ(), to - from), 0.5 * (from + to)};
}

}  // namespace foresight
