#include "core/mapping/scan_changes.h"

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/octree/octree_pointcloud_changedetector.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <unordered_map>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

using Points = pcl::PointCloud<pcl::PointXYZ>;

Points::Ptr PointsOf(const PlacedScan& scan) {
  auto points = std::make_shared<Points>();
  for (int line = 0; line < scan.cloud.lines; ++line)
    for (int beam = 0; beam < scan.cloud.beams; ++beam) {
      if (!scan.cloud.Valid(line, beam)) continue;
      const Eigen::Vector3f place =
          (scan.map_from_base * scan.cloud.points[scan.cloud.Index(line, beam)].cast<double>())
              .cast<float>();
      points->emplace_back(place.x(), place.y(), place.z());
    }
  return points;
}

/// The beams of a scan, found by where they point.
class Beams {
 public:
  explicit Beams(const PlacedScan& scan) : scan_(scan) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int line = 0; line < scan.cloud.lines; ++line) sum += OriginOf(line);
    eye_ = sum / std::max(1, scan.cloud.lines);
    for (int line = 0; line < scan.cloud.lines; ++line) {
      spread_m_ = std::max(spread_m_, (OriginOf(line) - eye_).norm());
      for (int beam = 0; beam < scan.cloud.beams; ++beam)
        if (scan.cloud.Valid(line, beam)) Add(line, beam);
    }
  }

  /// How many beams went through the place, and ended at least `behind_m` behind it.
  int Through(const Eigen::Vector3d& place, const ScanChangeOptions& options) const {
    const Eigen::Vector3d line_of_sight = place - eye_;
    const double distance_m = line_of_sight.norm();
    if (distance_m < 2.0 * spread_m_) return 0;
    // Seen from a beam's own origin the place lies elsewhere than from their mean.
    const int reach = 1 + static_cast<int>(std::ceil(spread_m_ / distance_m / kBin_rad));
    const auto [row, column] = BinOf(line_of_sight / distance_m);
    int through = 0;
    for (int r = row - reach; r <= row + reach; ++r)
      for (int c = column - reach; c <= column + reach; ++c) {
        const auto bin = bins_.find(KeyOf(r, c));
        if (bin == bins_.end()) continue;
        for (const Beam& beam : bin->second) through += PassedThrough(beam, place, options) ? 1 : 0;
      }
    return through;
  }

 private:
  static constexpr double kBin_rad = RadiansFromDegrees(1.0);
  static constexpr double kHalfFootprint_rad = 0.004;

  struct Beam {
    int line = 0;
    Eigen::Vector3f direction;
    float range_m = 0.0f;
  };

  Eigen::Vector3d OriginOf(int line) const {
    return scan_.map_from_base * scan_.cloud.origins[static_cast<std::size_t>(line)].cast<double>();
  }

  /// Elevation and azimuth in bins; the poles, where bins get narrow, are above and below the head.
  static std::pair<int, int> BinOf(const Eigen::Vector3d& direction) {
    const double up = std::asin(std::clamp(direction.z(), -1.0, 1.0));
    const double around = std::atan2(direction.y(), direction.x());
    return {static_cast<int>(std::floor(up / kBin_rad)),
            static_cast<int>(std::floor(around / kBin_rad))};
  }
  static int KeyOf(int row, int column) {
    constexpr int kTurn = 360;
    return row * kTurn + ((column % kTurn) + kTurn) % kTurn;
  }

  void Add(int line, int beam) {
    const Eigen::Vector3d end =
        scan_.map_from_base * scan_.cloud.points[scan_.cloud.Index(line, beam)].cast<double>();
    const Eigen::Vector3d ray = end - OriginOf(line);
    const double range_m = ray.norm();
    if (!(range_m > 0.0)) return;
    const Eigen::Vector3d direction = ray / range_m;
    const auto [row, column] = BinOf(direction);
    bins_[KeyOf(row, column)].push_back(
        {line, direction.cast<float>(), static_cast<float>(range_m)});
  }

  bool PassedThrough(const Beam& beam, const Eigen::Vector3d& place,
                     const ScanChangeOptions& options) const {
    const Eigen::Vector3d direction = beam.direction.cast<double>();
    const Eigen::Vector3d to_place = place - OriginOf(beam.line);
    const double along_m = direction.dot(to_place);
    if (along_m <= 0.0 || along_m + options.behind_m > beam.range_m) return false;
    const double beside_m = (to_place - along_m * direction).norm();
    return beside_m <= std::max(options.beside_m, kHalfFootprint_rad * along_m);
  }

  const PlacedScan& scan_;
  Eigen::Vector3d eye_ = Eigen::Vector3d::Zero();
  double spread_m_ = 0.0;
  std::unordered_map<int, std::vector<Beam>> bins_;
};

/// Points in cells of an octree that the other cloud has nothing in, and farther than the distance
/// from each of its points.
Points::Ptr NewPoints(const Points::Ptr& known, const Points::Ptr& other, double distance_m) {
  pcl::octree::OctreePointCloudChangeDetector<pcl::PointXYZ> octree(distance_m);
  octree.setInputCloud(known);
  octree.addPointsFromInputCloud();
  octree.switchBuffers();
  octree.setInputCloud(other);
  octree.addPointsFromInputCloud();
  std::vector<int> in_new_cells;
  octree.getPointIndicesFromNewVoxels(in_new_cells);
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(known);
  auto fresh = std::make_shared<Points>();
  std::vector<int> index(1);
  std::vector<float> squared(1);
  for (const int at : in_new_cells) {
    const pcl::PointXYZ& point = (*other)[static_cast<std::size_t>(at)];
    if (tree.nearestKSearch(point, 1, index, squared) == 1 && squared[0] <= distance_m * distance_m)
      continue;
    fresh->push_back(point);
  }
  return fresh;
}

ScanChange ChangeOf(const Points& points, const pcl::PointIndices& indices, ScanChange::Kind kind) {
  ScanChange change;
  change.kind = kind;
  Eigen::AlignedBox3d box;
  for (const int at : indices.indices) {
    change.points.push_back(points[static_cast<std::size_t>(at)].getVector3fMap());
    box.extend(change.points.back().cast<double>());
  }
  change.centre = box.center();
  change.size_m = box.sizes();
  return change;
}

/// What stands in `seen` and not in the scan of `beams`. @returns points that it could not see.
std::size_t AddChanges(const Points::Ptr& known, const Points::Ptr& seen, const Beams& beams,
                       ScanChange::Kind kind, const ScanChangeOptions& options,
                       std::vector<ScanChange>& changes) {
  const Points::Ptr fresh = NewPoints(known, seen, options.distance_m);
  auto changed = std::make_shared<Points>();
  for (const pcl::PointXYZ& point : *fresh)
    if (beams.Through(point.getVector3fMap().cast<double>(), options) >= options.min_beams_through)
      changed->push_back(point);
  const std::size_t hidden = fresh->size() - changed->size();
  if (changed->empty()) return hidden;
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> clusters;
  clusters.setClusterTolerance(options.gap_m);
  clusters.setMinClusterSize(options.min_points);
  clusters.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  clusters.setInputCloud(changed);
  std::vector<pcl::PointIndices> found;
  clusters.extract(found);
  for (const pcl::PointIndices& indices : found)
    changes.push_back(ChangeOf(*changed, indices, kind));
  return hidden;
}

}  // namespace

Status ScanChangeOptions::Check() const {
  const auto positive = [](const char* name, double value) -> Status {
    if (value > 0.0 && std::isfinite(value)) return {};
    return Fail(ErrorCode::kInvalidOptions, "ScanChangeOptions::{} {} is not positive", name,
                value);
  };
  FORESIGHT_CHECK(positive("distance_m", distance_m));
  FORESIGHT_CHECK(positive("behind_m", behind_m));
  FORESIGHT_CHECK(positive("beside_m", beside_m));
  FORESIGHT_CHECK(positive("gap_m", gap_m));
  FORESIGHT_CHECK(positive("min_beams_through", min_beams_through));
  return positive("min_points", min_points);
}

const char* ToString(ScanChange::Kind kind) {
  return kind == ScanChange::Kind::kAppeared ? "appeared" : "gone";
}

Result<ScanChanges> FindChanges(const PlacedScan& before, const PlacedScan& after,
                                const ScanChangeOptions& options, const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  const Points::Ptr old_points = PointsOf(before), new_points = PointsOf(after);
  if (old_points->empty() || new_points->empty())
    return Fail(ErrorCode::kTooFewPoints, "the {} scan has no return",
                old_points->empty() ? "earlier" : "later");
  const auto cancelled = [&]() -> Status {
    if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the comparison was cancelled");
    return {};
  };
  ScanChanges out;
  context.Report(0.1, "comparing scans");
  out.not_seen_before = AddChanges(old_points, new_points, Beams(before),
                                   ScanChange::Kind::kAppeared, options, out.changes);
  FORESIGHT_CHECK(cancelled());
  context.Report(0.6, "comparing scans");
  AddChanges(new_points, old_points, Beams(after), ScanChange::Kind::kGone, options, out.changes);
  FORESIGHT_CHECK(cancelled());
  std::stable_sort(
      out.changes.begin(), out.changes.end(),
      [](const ScanChange& a, const ScanChange& b) { return a.points.size() > b.points.size(); });
  return out;
}

}  // namespace foresight
