#include "core/mapping/point_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace foresight {

Status PointPyramidOptions::Check() const {
  if (leaf_points < 1) return Fail(ErrorCode::kInvalidOptions, "leaf_points must be 1 or more");
  if (grid < 2 || grid > 256 || (grid & (grid - 1)) != 0)
    return Fail(ErrorCode::kInvalidOptions, "grid must be a power of 2 from 2 to 256, not {}",
                grid);
  if (most_levels < 1 || most_levels > 32)
    return Fail(ErrorCode::kInvalidOptions, "most_levels must be 1 to 32, not {}", most_levels);
  return {};
}

/// Parts the cubes one after the other; a cube's points are a row, and so are its children.
class PointPyramid::Builder {
 public:
  Builder(std::vector<TaggedPoint>& points, std::vector<Cube>& cubes,
          const PointPyramidOptions& options, const RunContext& context)
      : points_(points),
        cubes_(cubes),
        options_(options),
        context_(context),
        taken_((static_cast<std::size_t>(options.grid) * static_cast<std::size_t>(options.grid) *
                    static_cast<std::size_t>(options.grid) +
                63) /
               64) {}

  Status Run(const Eigen::AlignedBox3d& bounds) {
    if (points_.empty()) return {};
    Cube root;
    root.low = bounds.min().cast<float>();
    // A little more, so that rounding leaves the last point inside.
    root.size_m = std::max(1e-3f, static_cast<float>(bounds.sizes().maxCoeff() * (1.0 + 1e-6)));
    root.begin = 0;
    root.own_end = points_.size();
    cubes_.push_back(root);
    // Breadth first, so that the children of a cube stand in a row; until it is parted a cube's
    // own points are all of its points.
    for (std::size_t i = 0; i < cubes_.size(); ++i) {
      if (context_.Cancelled()) return Fail(ErrorCode::kCancelled, "the map was cancelled");
      FORESIGHT_CHECK(Part(i));
    }
    return {};
  }

 private:
  Status Part(std::size_t index) {
    const Cube cube = cubes_[index];
    const std::uint64_t count = cube.own_end - cube.begin;
    if (count <= options_.leaf_points || cube.level + 1 >= options_.most_levels) {
      done_ += count;
      context_.Report(static_cast<double>(done_) / static_cast<double>(points_.size()),
                      "sorting points");
      return {};
    }
    const std::uint64_t kept_end = TakeSample(cube);
    done_ += kept_end - cube.begin;
    const std::array<std::uint64_t, 9> ends = SortByOctant(cube, kept_end);
    cubes_[index].own_end = kept_end;
    cubes_[index].first_child = static_cast<std::uint32_t>(cubes_.size());
    for (int octant = 0; octant < 8; ++octant) {
      const auto o = static_cast<std::size_t>(octant);
      if (ends[o + 1] == ends[o]) continue;
      Cube child;
      child.size_m = 0.5f * cube.size_m;
      child.low = cube.low;
      for (int axis = 0; axis < 3; ++axis)
        if (octant & (1 << axis)) child.low[axis] += child.size_m;
      child.begin = ends[o];
      child.own_end = ends[o + 1];
      child.level = static_cast<std::uint8_t>(cube.level + 1);
      cubes_.push_back(child);
      ++cubes_[index].children;
    }
    if (cubes_[index].children == 0) cubes_[index].first_child = 0;
    return {};
  }

  /// Moves the first point of each cell of the grid to the front; returns where they end.
  std::uint64_t TakeSample(const Cube& cube) {
    std::fill(taken_.begin(), taken_.end(), 0);
    const auto side = static_cast<float>(options_.grid);
    const float cells_per_m = side / cube.size_m;
    const int last = options_.grid - 1;
    std::uint64_t front = cube.begin;
    for (std::uint64_t i = cube.begin; i < cube.own_end; ++i) {
      const Eigen::Array3f at = (points_[i].position - cube.low).array() * cells_per_m;
      const auto cell = [&](int axis) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>(at[axis]), 0, last));
      };
      const std::size_t key = (cell(2) * static_cast<std::size_t>(options_.grid) + cell(1)) *
                                  static_cast<std::size_t>(options_.grid) +
                              cell(0);
      std::uint64_t& word = taken_[key / 64];
      const std::uint64_t bit = std::uint64_t{1} << (key % 64);
      if (word & bit) continue;
      word |= bit;
      std::swap(points_[front++], points_[i]);
    }
    return front;
  }

  /// American flag sort of [begin, cube's end) by octant; returns where each begins.
  std::array<std::uint64_t, 9> SortByOctant(const Cube& cube, std::uint64_t begin) {
    const Eigen::Vector3f middle = cube.low + Eigen::Vector3f::Constant(0.5f * cube.size_m);
    const auto octant_of = [&middle](const TaggedPoint& point) {
      return static_cast<std::size_t>((point.position.x() >= middle.x() ? 1 : 0) |
                                      (point.position.y() >= middle.y() ? 2 : 0) |
                                      (point.position.z() >= middle.z() ? 4 : 0));
    };
    std::array<std::uint64_t, 8> counts{};
    for (std::uint64_t i = begin; i < cube.own_end; ++i) ++counts[octant_of(points_[i])];
    std::array<std::uint64_t, 9> starts{};
    starts[0] = begin;
    for (std::size_t o = 0; o < 8; ++o) starts[o + 1] = starts[o] + counts[o];
    std::array<std::uint64_t, 8> next{};
    std::copy_n(starts.begin(), 8, next.begin());
    for (std::size_t o = 0; o < 8; ++o)
      while (next[o] < starts[o + 1]) {
        const std::size_t belongs = octant_of(points_[next[o]]);
        if (belongs == o)
          ++next[o];
        else
          std::swap(points_[next[o]], points_[next[belongs]++]);
      }
    return starts;
  }

  std::vector<TaggedPoint>& points_;
  std::vector<Cube>& cubes_;
  const PointPyramidOptions& options_;
  const RunContext& context_;
  std::vector<std::uint64_t> taken_;  ///< a bit a cell
  std::uint64_t done_ = 0;
};

Result<PointPyramid> PointPyramid::Build(std::vector<TaggedPoint> points,
                                         const PointPyramidOptions& options,
                                         const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  PointPyramid pyramid;
  pyramid.options_ = options;
  pyramid.points_ = std::move(points);
  std::erase_if(pyramid.points_,
                [](const TaggedPoint& point) { return !point.position.allFinite(); });
  Eigen::AlignedBox3f bounds;
  for (const TaggedPoint& point : pyramid.points_) bounds.extend(point.position);
  pyramid.bounds_ = bounds.cast<double>();
  FORESIGHT_CHECK(Builder(pyramid.points_, pyramid.cubes_, options, context).Run(pyramid.bounds_));
  return pyramid;
}

std::size_t PointPyramid::Bytes() const {
  return points_.capacity() * sizeof(TaggedPoint) + cubes_.capacity() * sizeof(Cube);
}

namespace {

/// How far a cube reaches over the picture.
struct CubeSight {
  bool seen = false;
  double distance_m = 0.0;  ///< of its nearest corner, along the line of sight
};

CubeSight SightOf(const Eigen::Matrix4d& clip_from_map, const Eigen::AlignedBox3d& box) {
  CubeSight sight;
  std::array<int, 5> outside{};
  sight.distance_m = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d at((corner & 1 ? box.max() : box.min()).x(),
                             (corner & 2 ? box.max() : box.min()).y(),
                             (corner & 4 ? box.max() : box.min()).z());
    const Eigen::Vector4d clip = clip_from_map * at.homogeneous();
    for (int axis = 0; axis < 2; ++axis) {
      outside[static_cast<std::size_t>(2 * axis)] += clip[axis] < -clip.w() ? 1 : 0;
      outside[static_cast<std::size_t>(2 * axis + 1)] += clip[axis] > clip.w() ? 1 : 0;
    }
    outside[4] += clip.w() <= 0.0 ? 1 : 0;
    sight.distance_m = std::min(sight.distance_m, clip.w());
  }
  sight.seen = std::none_of(outside.begin(), outside.end(), [](int count) { return count == 8; });
  return sight;
}

}  // namespace

std::vector<TaggedPoint> PointPyramid::Select(const PyramidView& view) const {
  std::vector<TaggedPoint> taken;
  if (cubes_.empty()) return taken;
  // How many pixels a metre across is at a distance of one metre, with square pixels: from the y
  // row.
  const double scale_px = 0.5 * view.height_px * view.clip_from_map.block<1, 3>(1, 0).norm();
  const auto box_of = [](const Cube& cube) {
    const Eigen::Vector3d low = cube.low.cast<double>();
    return Eigen::AlignedBox3d(low, (low.array() + static_cast<double>(cube.size_m)).matrix());
  };
  using Entry = std::pair<double, std::uint32_t>;  // pixels between its points, cube
  std::priority_queue<Entry> waiting;
  const auto look_at = [&](std::uint32_t index) {
    const Cube& cube = cubes_[index];
    const Eigen::AlignedBox3d box = box_of(cube);
    if (view.keep && !view.keep->intersects(box)) return;
    const CubeSight sight = SightOf(view.clip_from_map, box);
    if (!sight.seen) return;
    const double spacing_m = static_cast<double>(cube.size_m) / options_.grid;
    waiting.emplace(scale_px * spacing_m / std::max(1e-3, sight.distance_m), index);
  };
  look_at(0);
  while (!waiting.empty()) {
    const auto [spacing_px, index] = waiting.top();
    waiting.pop();
    const Cube& cube = cubes_[index];
    const bool all_inside = !view.keep || view.keep->contains(box_of(cube));
    for (std::uint64_t i = cube.begin; i < cube.own_end; ++i)
      if (all_inside || view.keep->contains(points_[i].position.cast<double>()))
        taken.push_back(points_[i]);
    if (taken.size() >= view.budget) {
      taken.resize(view.budget);
      break;
    }
    if (spacing_px < view.finest_px) continue;
    for (std::uint32_t child = 0; child < cube.children; ++child) look_at(cube.first_child + child);
  }
  return taken;
}

std::vector<TaggedPoint> PointPyramid::SelectAll(PyramidView view,
                                                 const Eigen::AlignedBox2d& area) const {
  // The area becomes the whole picture.
  const Eigen::Vector2d middle = area.center(), half = 0.5 * area.sizes();
  for (int axis = 0; axis < 2; ++axis)
    view.clip_from_map.row(axis) =
        ((view.clip_from_map.row(axis) - middle[axis] * view.clip_from_map.row(3)) / half[axis])
            .eval();
  view.budget = points_.size() + 1;
  view.finest_px = 0.0;
  return Select(view);
}

std::vector<TaggedPoint> PointPyramid::Within(const Eigen::AlignedBox3d& box) const {
  PyramidView view;
  view.clip_from_map.setZero();
  view.clip_from_map(3, 3) = 1.0;  // everything is seen
  view.budget = points_.size() + 1;
  view.finest_px = 0.0;
  view.keep = box;
  return Select(view);
}

std::vector<TaggedPoint> PointPyramid::Coarsest(std::size_t budget) const {
  std::vector<TaggedPoint> taken;
  for (const Cube& cube : cubes_) {  // level by level
    const std::size_t room = budget - taken.size();
    const auto begin = points_.begin() + static_cast<std::ptrdiff_t>(cube.begin);
    const std::size_t own = std::min<std::size_t>(room, cube.own_end - cube.begin);
    taken.insert(taken.end(), begin, begin + static_cast<std::ptrdiff_t>(own));
    if (taken.size() == budget) break;
  }
  return taken;
}

}  // namespace foresight
