#include "core/registration/cloud_distance.h"

#include <algorithm>
#include <cmath>

#include "core/base/contract.h"
#include "core/base/parallel.h"
#include "core/base/quantile.h"

namespace foresight {
namespace {

std::vector<Eigen::Vector3f> Finite(std::span<const Eigen::Vector3f> cloud) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(cloud.size());
  for (const Eigen::Vector3f& point : cloud)
    if (point.allFinite()) points.push_back(point);
  return points;
}

double SquaredDistance(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return (a.cast<double>() - b.cast<double>()).squaredNorm();
}

/// A k-d tree in the order of its points: the middle of each range parts it along its widest axis.
class PointTree {
 public:
  explicit PointTree(std::vector<Eigen::Vector3f> points)
      : points_(std::move(points)), axis_(points_.size(), 0) {
    Build(0, points_.size());
  }

  double NearestSquared(const Eigen::Vector3f& point) const {
    double best = std::numeric_limits<double>::infinity();
    Search(0, points_.size(), point, best);
    return best;
  }

 private:
  static constexpr std::size_t kLeaf = 12;

  void Build(std::size_t begin, std::size_t end) {
    if (end - begin <= kLeaf) return;
    Eigen::Vector3f low = points_[begin], high = low;
    for (std::size_t i = begin; i < end; ++i) {
      low = low.cwiseMin(points_[i]);
      high = high.cwiseMax(points_[i]);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [this](std::size_t i) {
      return points_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(begin), at(middle), at(end),
                     [axis](const auto& a, const auto& b) { return a[axis] < b[axis]; });
    axis_[middle] = static_cast<unsigned char>(axis);
    Build(begin, middle);
    Build(middle + 1, end);
  }

  void Search(std::size_t begin, std::size_t end, const Eigen::Vector3f& point,
              double& best) const {
    if (end - begin <= kLeaf) {
      for (std::size_t i = begin; i < end; ++i)
        best = std::min(best, SquaredDistance(points_[i], point));
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    best = std::min(best, SquaredDistance(points_[middle], point));
    const int axis = axis_[middle];
    const double beyond = static_cast<double>(point[axis]) - points_[middle][axis];
    const bool below = beyond < 0.0;
    Search(below ? begin : middle + 1, below ? middle : end, point, best);
    if (beyond * beyond < best)
      Search(below ? middle + 1 : begin, below ? end : middle, point, best);
  }

  std::vector<Eigen::Vector3f> points_;
  std::vector<unsigned char> axis_;
};

}  // namespace

Result<std::vector<float>> NearestDistances(std::span<const Eigen::Vector3f> from,
                                            std::span<const Eigen::Vector3f> to,
                                            const RunContext& context) {
  const std::vector<Eigen::Vector3f> asked = Finite(from);
  std::vector<Eigen::Vector3f> others = Finite(to);
  if (asked.empty() || others.empty())
    return Fail(ErrorCode::kTooFewPoints, "distance of two clouds: the {} has no point",
                asked.empty() ? "first" : "second");
  context.Report(0.0, "distance of the clouds");
  const PointTree tree(std::move(others));
  std::vector<float> distances(asked.size());
  constexpr std::size_t kBlock = 4096;
  const auto blocks = static_cast<int>((asked.size() + kBlock - 1) / kBlock);
  const bool done = ParallelFor(blocks, context, [&](int block) {
    const std::size_t begin = static_cast<std::size_t>(block) * kBlock;
    for (std::size_t i = begin; i < std::min(begin + kBlock, asked.size()); ++i)
      distances[i] = static_cast<float>(std::sqrt(tree.NearestSquared(asked[i])));
  });
  if (!done) return Fail(ErrorCode::kCancelled, "the distance of two clouds was cancelled");
  return distances;
}

CloudDistance SummaryOf(std::vector<float> distances_m) {
  FORESIGHT_EXPECTS(!distances_m.empty(), "a distance");
  return {distances_m.size(), Quantile(distances_m, 0.5), Quantile(distances_m, 0.95),
          *std::max_element(distances_m.begin(), distances_m.end())};
}

Result<CloudDistance> DistanceOfClouds(std::span<const Eigen::Vector3f> from,
                                       std::span<const Eigen::Vector3f> to,
                                       const RunContext& context) {
  FORESIGHT_TRY(std::vector<float> distances, NearestDistances(from, to, context));
  return SummaryOf(std::move(distances));
}

}  // namespace foresight
