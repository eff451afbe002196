#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"

namespace foresight {

/// A point of a large cloud with a number that says what it belongs to, or an intensity.
struct TaggedPoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  std::uint32_t tag = 0;
};
static_assert(sizeof(TaggedPoint) == 16);

struct PointPyramidOptions {
  /// A cube with no more points is not parted.
  std::uint32_t leaf_points = 16'384;
  /// Cells along a side of a cube's grid: a cube keeps one point a cell for who looks from afar.
  int grid = 64;
  int most_levels = 21;

  Status Check() const;  ///< Fails with kInvalidOptions.
};

/// How a cloud is looked at.
struct PyramidView {
  /// Homogeneous: x and y over w are in [-1, 1] where a point is seen; w is the distance along the
  /// line of sight. z is not used: a viewer's near and far planes follow what is drawn.
  Eigen::Matrix4d clip_from_map = Eigen::Matrix4d::Identity();
  int height_px = 1000;  ///< of the picture
  /// Pixels between points of a cube from which on it is not worth more of them.
  double finest_px = 1.0;
  std::size_t budget = 1'000'000;                ///< most points of the picture
  std::optional<Eigen::AlignedBox3d> keep = {};  ///< only what is inside, in map
};

/// A voxel pyramid (octree) over a cloud of any size: each cube holds an even sample of the points
/// in it, its eight children the rest, so that every point lies in exactly one cube. A picture
/// takes the cubes that look largest until its budget is spent: coarse from afar, every point when
/// near. Immutable; may be read by several threads. Memory: the points once, and 64 bytes a cube.
class PointPyramid {
 public:
  /// Sorts the points in their place. Points that are not finite are left out. Fails with
  /// kInvalidOptions and kCancelled. O(points levels).
  static Result<PointPyramid> Build(std::vector<TaggedPoint> points,
                                    const PointPyramidOptions& options, const RunContext& context);

  std::size_t size() const { return points_.size(); }
  std::size_t CubeCount() const { return cubes_.size(); }
  std::size_t Bytes() const;
  const Eigen::AlignedBox3d& Bounds() const { return bounds_; }
  std::span<const TaggedPoint> Points() const { return points_; }

  /// The points of a picture, those of the coarsest cubes first: any first n of them show all of it
  /// coarsely. O(points taken + cubes looked at).
  std::vector<TaggedPoint> Select(const PyramidView& view) const;
  /// Every point within an area of a picture, however many they are: `view`'s budget and finest_px
  /// are not used. Others may be among them. O(points taken + cubes looked at).
  std::vector<TaggedPoint> SelectAll(PyramidView view, const Eigen::AlignedBox2d& area) const;
  /// Every point in the box, in map. O(points taken + cubes).
  std::vector<TaggedPoint> Within(const Eigen::AlignedBox3d& box) const;
  /// The whole cloud coarsely, wherever it is looked at from.
  std::vector<TaggedPoint> Coarsest(std::size_t budget) const;

 private:
  struct Cube {
    Eigen::Vector3f low = Eigen::Vector3f::Zero();
    float size_m = 0.0f;
    std::uint64_t begin = 0;  ///< its own points: [begin, own_end)
    std::uint64_t own_end = 0;
    std::uint32_t first_child = 0;  ///< its children stand in a row; 0 = none
    std::uint8_t children = 0;
    std::uint8_t level = 0;
  };
  class Builder;

  PointPyramidOptions options_;
  std::vector<TaggedPoint> points_;
  std::vector<Cube> cubes_;
  Eigen::AlignedBox3d bounds_;
};

}  // namespace foresight
