#include "core/simulation/surface_color.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace foresight {
namespace {

constexpr float kBrickAspect = 3.0f;      ///< length of a brick in rows
constexpr float kMortarFraction = 0.12f;  ///< of a row's height
constexpr float kBrickVariation = 0.3f;   ///< of brightness from brick to brick

/// A fixed random number in [0, 1) for a lattice cell.
float CellValue(int x, int y, int z) {
  auto h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^
           static_cast<std::uint32_t>(y) * 0xd8163841u ^
           static_cast<std::uint32_t>(z) * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) * 0x1.0p-24f;
}

/// std::lerp for numbers of one sign and t in [0, 1], in every bit, without its branches.
float Between(float a, float b, float t) {
  const float mixed = a + t * (b - a);
  return b > a ? std::min(mixed, b) : std::max(mixed, b);
}

/// Smooth noise between the values of the eight corners of the lattice's cell around a point.
float ValueNoise(const Eigen::Vector3f& p, SurfaceColor::Neighbourhood::Cell* cell) {
  const int x = static_cast<int>(std::floor(p.x()));
  const int y = static_cast<int>(std::floor(p.y()));
  const int z = static_cast<int>(std::floor(p.z()));
  const Eigen::Vector3f f(p.x() - static_cast<float>(x), p.y() - static_cast<float>(y),
                          p.z() - static_cast<float>(z));
  const Eigen::Vector3f s =
      f.cwiseProduct(f).cwiseProduct(Eigen::Vector3f::Constant(3.0f) - 2.0f * f);
  const std::array<int, 3>& at = cell->corner;
  if (!cell->filled || at[0] != x || at[1] != y || at[2] != z) {
    cell->filled = true;
    cell->corner = {x, y, z};
    for (int corner = 0; corner < 8; ++corner)
      cell->values[static_cast<std::size_t>(corner)] =
          CellValue(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2));
  }
  const auto along_x = [&](std::size_t dy, std::size_t dz) {
    const std::size_t first = 2 * dy + 4 * dz;
    return Between(cell->values[first], cell->values[first + 1], s.x());
  };
  return Between(Between(along_x(0, 0), along_x(1, 0), s.y()),
                 Between(along_x(0, 1), along_x(1, 1), s.y()), s.z());
}

/// The two coordinates of a point on the side of a box that its normal comes nearest to.
Eigen::Vector2f OnFace(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  if (axis == 0) return {p.y(), p.z()};
  if (axis == 1) return {p.x(), p.z()};
  return {p.x(), p.y()};
}

bool Odd(float value) {
  return (static_cast<int>(std::floor(value)) & 1) != 0;
}

/// How much of the second colour a brick wall shows, and how bright its brick is.
struct BrickLook {
  bool mortar;
  float brightness;
};

BrickLook BrickAt(const Eigen::Vector2f& uv) {
  const float row = std::floor(uv.y());
  const float along = uv.x() / kBrickAspect + (Odd(row) ? 0.5f : 0.0f);
  const float column = std::floor(along);
  const bool mortar =
      uv.y() - row < kMortarFraction || (along - column) * kBrickAspect < kMortarFraction;
  const float value = CellValue(static_cast<int>(column), static_cast<int>(row), 7);
  return {mortar, 1.0f + kBrickVariation * (value - 0.5f)};
}

}  // namespace

SurfaceColor::SurfaceColor(const Scene& scene) {
  for (const SceneMesh& mesh : scene.meshes) {
    const Material& material = mesh.material;
    paints_.push_back({material.pattern, material.color.cast<float>(),
                       material.color2.cast<float>(),
                       static_cast<float>(1.0 / material.pattern_size_m),
                       mesh.robot_from_object.RotationMatrix().transpose().cast<float>(),
                       mesh.robot_from_object.translation().cast<float>(), mesh.face.get()});
  }
}

bool SurfaceColor::IsPrinted(int mesh, const Eigen::Vector3f& normal) const {
  const Paint& paint = paints_[static_cast<std::size_t>(mesh)];
  return paint.face != nullptr && paint.object_from_robot.row(2).dot(normal) < 0.0f;
}

Eigen::Vector3f SurfaceColor::MeanOfPrint(int mesh,
                                          const std::array<Eigen::Vector3f, 4>& points) const {
  const Paint& paint = paints_[static_cast<std::size_t>(mesh)];
  const float white = paint.face->WhiteIn({paint.OnFace(points[0]), paint.OnFace(points[1]),
                                           paint.OnFace(points[2]), paint.OnFace(points[3])});
  return white * paint.color + (1.0f - white) * paint.color2;
}

Eigen::Vector3f SurfaceColor::At(int mesh, const Eigen::Vector3f& point,
                                 const Eigen::Vector3f& normal, Neighbourhood* near) const {
  const Paint& paint = paints_[static_cast<std::size_t>(mesh)];
  if (IsPrinted(mesh, normal))
    return paint.face->WhiteAt(paint.OnFace(point)) ? paint.color : paint.color2;
  if (paint.face != nullptr || paint.pattern == Material::Pattern::kPlain) return paint.color;
  // Half a millimetre off the lattice: faces on a cell's border would flicker between both colours.
  const Eigen::Vector3f p = paint.per_metre * (paint.object_from_robot * (point - paint.origin) +
                                               Eigen::Vector3f::Constant(0.0005f));
  if (paint.pattern == Material::Pattern::kNoise) {
    const float noise =
        0.6f * ValueNoise(p, &near->octaves[0]) + 0.4f * ValueNoise(4.1f * p, &near->octaves[1]);
    return paint.color + noise * (paint.color2 - paint.color);
  }
  const Eigen::Vector2f uv = OnFace(p, paint.object_from_robot * normal);
  if (paint.pattern == Material::Pattern::kStripes) return Odd(uv.x()) ? paint.color2 : paint.color;
  if (paint.pattern == Material::Pattern::kChecker)
    return Odd(uv.x()) != Odd(uv.y()) ? paint.color2 : paint.color;
  const BrickLook brick = BrickAt(uv);
  return brick.mortar ? paint.color2 : Eigen::Vector3f(brick.brightness * paint.color);
}

}  // namespace foresight
