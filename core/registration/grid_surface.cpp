#include "core/registration/grid_surface.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"

namespace foresight {
namespace {

using Triangle = std::array<std::int32_t, 3>;

class Surface {
 public:
  Surface(const RegisteredScan& cloud, const GridSurfaceOptions& options)
      : cloud_(cloud), options_(options) {
    std::int32_t next = 0;
    for (int line = 0; line < cloud.lines; ++line)
      for (int beam = 0; beam < cloud.beams; ++beam)
        index_.push_back(cloud.Valid(line, beam) ? next++ : -1);
  }

  std::vector<Triangle> Build() {
    for (int line = 0; line + 1 < cloud_.lines; ++line) {
      // Between beams of a line, or between the lines: whichever is wider.
      const double spacing = std::max(MedianAngle(line, line, 1), MedianAngle(line, line + 1, 0));
      for (int beam = 0; beam + 1 < cloud_.beams; ++beam) AddCell(line, beam, spacing);
    }
    return std::move(triangles_);
  }

 private:
  const Eigen::Vector3f& Point(int line, int beam) const {
    return cloud_.points[cloud_.Index(line, beam)];
  }
  Eigen::Vector3f Direction(int line, int beam) const {
    return (Point(line, beam) - cloud_.origins[static_cast<std::size_t>(line)]).normalized();
  }

  /// The median angle between the beams of a line and those `step` further on of another one.
  double MedianAngle(int line, int other, int step) const {
    std::vector<double> angles;
    for (int beam = 0; beam + step < cloud_.beams; beam += 8)
      if (cloud_.Valid(line, beam) && cloud_.Valid(other, beam + step))
        angles.push_back(std::acos(std::clamp(
            static_cast<double>(Direction(line, beam).dot(Direction(other, beam + step))), -1.0,
            1.0)));
    return angles.empty() ? 0.0 : UpperMedian(std::move(angles));
  }

  /// The corners a b of one line, c d of the next one.
  void AddCell(int line, int beam, double spacing) {
    const std::array<std::pair<int, int>, 4> corners = {
        {{line, beam}, {line, beam + 1}, {line + 1, beam}, {line + 1, beam + 1}}};
    // Either diagonal: where one corner is missing, the other three still make a triangle.
    const std::array<Triangle, 4> choices = {{{0, 2, 1}, {1, 2, 3}, {0, 2, 3}, {0, 3, 1}}};
    const bool first = Holds(corners, choices[0], spacing),
               second = Holds(corners, choices[1], spacing);
    const bool third = Holds(corners, choices[2], spacing),
               fourth = Holds(corners, choices[3], spacing);
    const bool other_diagonal = static_cast<int>(third) + fourth > static_cast<int>(first) + second;
    if (!other_diagonal && first) Add(corners, choices[0]);
    if (!other_diagonal && second) Add(corners, choices[1]);
    if (other_diagonal && third) Add(corners, choices[2]);
    if (other_diagonal && fourth) Add(corners, choices[3]);
  }

  bool Holds(const std::array<std::pair<int, int>, 4>& corners, const Triangle& triangle,
             double spacing) const {
    double nearest_m = 1e9, longest_m = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [line, beam] = corners[static_cast<std::size_t>(triangle[i])];
      if (!cloud_.Valid(line, beam)) return false;
      nearest_m = std::min<double>(nearest_m, cloud_.range_m[cloud_.Index(line, beam)]);
      const auto [next_line, next_beam] = corners[static_cast<std::size_t>(triangle[(i + 1) % 3])];
      if (!cloud_.Valid(next_line, next_beam)) return false;
      longest_m =
          std::max<double>(longest_m, (Point(line, beam) - Point(next_line, next_beam)).norm());
    }
    return longest_m <=
           std::max(options_.min_side_m, options_.max_side_ratio * spacing * nearest_m);
  }

  /// Counter-clockwise for who looks from the lidar, whichever way the head turned.
  void Add(const std::array<std::pair<int, int>, 4>& corners, Triangle triangle) {
    std::array<Eigen::Vector3f, 3> points;
    Triangle indices{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [line, beam] = corners[static_cast<std::size_t>(triangle[i])];
      points[i] = Point(line, beam);
      indices[i] = index_[cloud_.Index(line, beam)];
    }
    const Eigen::Vector3f normal = (points[1] - points[0]).cross(points[2] - points[0]);
    const Eigen::Vector3f& eye = cloud_.origins[static_cast<std::size_t>(corners[0].first)];
    if (normal.dot(eye - points[0]) < 0.0f) std::swap(indices[1], indices[2]);
    triangles_.push_back(indices);
  }

  const RegisteredScan& cloud_;
  const GridSurfaceOptions& options_;
  std::vector<std::int32_t> index_;
  std::vector<Triangle> triangles_;
};

}  // namespace

Status GridSurfaceOptions::Check() const {
  if (!(max_side_ratio > 0.0) || !std::isfinite(max_side_ratio))
    return Fail(ErrorCode::kInvalidOptions, "GridSurfaceOptions::max_side_ratio {} is not positive",
                max_side_ratio);
  if (!(min_side_m >= 0.0) || !std::isfinite(min_side_m))
    return Fail(ErrorCode::kInvalidOptions, "GridSurfaceOptions::min_side_m {} is negative",
                min_side_m);
  return {};
}

Result<std::vector<Triangle>> GridSurface(const RegisteredScan& cloud,
                                          const GridSurfaceOptions& options) {
  FORESIGHT_CHECK(options.Check());
  std::vector<Triangle> triangles = Surface(cloud, options).Build();
  if (triangles.empty())
    return Fail(ErrorCode::kTooFewPoints, "{} lines of {} beams make no surface", cloud.lines,
                cloud.beams);
  return triangles;
}

}  // namespace foresight
