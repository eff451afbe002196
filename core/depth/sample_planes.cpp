#include "core/depth/sample_planes.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/parallel.h"

namespace foresight {
namespace {

constexpr std::size_t kBlockSamples = 4096;

/// Calls body(q) for every sample of the map, on the context's threads.
void ForEachSample(const SparseDepthMap& map, const RunContext& context,
                   const std::function<void(std::size_t)>& body) {
  const std::size_t blocks = (map.size() + kBlockSamples - 1) / kBlockSamples;
  ParallelFor(static_cast<int>(blocks), context, [&](int block) {
    const std::size_t first = static_cast<std::size_t>(block) * kBlockSamples;
    const std::size_t last = std::min(first + kBlockSamples, map.size());
    for (std::size_t q = first; q < last; ++q) body(q);
  });
}

/// Change of inverse depth from one sample to another.
struct Step {
  float dx, dy, drho;
};

/// Collects slopes; unused places repeat the first, which is level.
class SlopeCollector {
 public:
  /// The slopes that explain both steps; left out where these are nearly parallel.
  void Add(const Step& p, const Step& q, float unit) {
    const float determinant = p.dx * q.dy - q.dx * p.dy;
    if (!(std::abs(determinant) > unit * unit)) return;
    slopes_.x[count_] = (p.drho * q.dy - q.drho * p.dy) / determinant;
    slopes_.y[count_] = (p.dx * q.drho - q.dx * p.drho) / determinant;
    ++count_;
  }
  const SlopeCandidates& slopes() const { return slopes_; }

 private:
  SlopeCandidates slopes_;
  std::size_t count_ = 1;
};

/// A sample's neighbours on the grid: index into the map, -1 = none.
class GridNeighbours {
 public:
  GridNeighbours(const SparseDepthMap& map, std::span<const SamplePlane> planes,
                 const Image<std::int32_t>& grid)
      : map_(map), planes_(planes), grid_(grid) {}

  std::int32_t At(int line, int beam) const {
    return grid_.Contains(beam, line) ? grid_(beam, line) : -1;
  }
  /// Along a line the second neighbour, if there is one: twice the way, half the noise.
  std::int32_t Along(int line, int beam, int direction) const {
    const std::int32_t second = At(line, beam + 2 * direction);
    return second >= 0 ? second : At(line, beam + direction);
  }
  Step Between(std::int32_t from, std::int32_t to) const {
    const auto a = static_cast<std::size_t>(from);
    const auto b = static_cast<std::size_t>(to);
    return {planes_[b].x - planes_[a].x, planes_[b].y - planes_[a].y,
            1.0f / map_.depths_m()[b] - 1.0f / map_.depths_m()[a]};
  }

 private:
  const SparseDepthMap& map_;
  std::span<const SamplePlane> planes_;
  const Image<std::int32_t>& grid_;
};

SlopeCandidates SlopesAt(const GridNeighbours& neighbours, std::int32_t q, int line, int beam,
                         float unit) {
  const std::int32_t along[] = {neighbours.Along(line, beam, -1), neighbours.Along(line, beam, 1)};
  const std::int32_t across[] = {neighbours.At(line - 1, beam), neighbours.At(line + 1, beam)};
  SlopeCollector collector;
  for (const std::int32_t a : along)
    for (const std::int32_t b : across)
      if (a >= 0 && b >= 0) collector.Add(neighbours.Between(q, a), neighbours.Between(q, b), unit);
  for (const std::int32_t b : across)
    if (along[0] >= 0 && along[1] >= 0 && b >= 0)
      collector.Add(neighbours.Between(along[0], along[1]), neighbours.Between(q, b), unit);
  return collector.slopes();
}

/// How many coordinates of the rays a pixel is at (x, y).
float UnitAt(const RayField& rays, int x, int y) {
  const int left = std::max(0, x - 1);
  const int right = std::min(rays.x.width() - 1, x + 1);
  const float unit = (rays.x(right, y) - rays.x(left, y)) / static_cast<float>(right - left);
  if (unit > 0.0f) return unit;
  // One column, or a neighbour beyond 90 deg: the y axis has about the same scale.
  const int above = std::max(0, y - 1);
  const int below = std::min(rays.y.height() - 1, y + 1);
  const float other = (rays.y(x, below) - rays.y(x, above)) / static_cast<float>(below - above);
  return other > 0.0f ? other : 1.0f;
}

}  // namespace

Image<std::int32_t> MapGrid(const SparseDepthMap& map, const AlignedSamples& samples) {
  Image<std::int32_t> grid(samples.beams, samples.lines, -1);
  for (std::size_t q = 0; q < map.size(); ++q) {
    const AlignedSample& s = samples.samples[static_cast<std::size_t>(map.sources()[q])];
    grid(s.beam, s.line) = static_cast<std::int32_t>(q);
  }
  return grid;
}

std::vector<SamplePlane> LevelPlanes(const SparseDepthMap& map, const AlignedSamples& samples,
                                     const RunContext& context) {
  std::vector<SamplePlane> planes(map.size());
  ForEachSample(map, context, [&](std::size_t q) {
    const AlignedSample& s = samples.samples[static_cast<std::size_t>(map.sources()[q])];
    SamplePlane& plane = planes[q];
    plane.x = samples.rays ? s.point.x() / s.point.z() : s.u;
    plane.y = samples.rays ? s.point.y() / s.point.z() : s.v;
    plane.unit = samples.rays ? UnitAt(*samples.rays, map.columns()[q], map.rows()[q]) : 1.0f;
    plane.inverse_depth = 1.0f / s.depth_m;
  });
  return planes;
}

std::vector<SlopeCandidates> SlopesOnGrid(const SparseDepthMap& map, const AlignedSamples& samples,
                                          std::span<const SamplePlane> planes,
                                          const RunContext& context) {
  const Image<std::int32_t> grid = MapGrid(map, samples);
  const GridNeighbours neighbours(map, planes, grid);
  std::vector<SlopeCandidates> slopes(map.size());
  ForEachSample(map, context, [&](std::size_t q) {
    const AlignedSample& s = samples.samples[static_cast<std::size_t>(map.sources()[q])];
    slopes[q] = SlopesAt(neighbours, static_cast<std::int32_t>(q), s.line, s.beam, planes[q].unit);
  });
  return slopes;
}

}  // namespace foresight
