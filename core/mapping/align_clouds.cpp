#include "core/mapping/align_clouds.h"

#include <pcl/features/normal_3d.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/octree/octree_pointcloud_voxelcentroid.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

using Points = pcl::PointCloud<pcl::PointXYZ>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t kFewestPoints = 200;

Points::Ptr CloudOf(std::span<const Eigen::Vector3f> points) {
  auto cloud = std::make_shared<Points>();
  cloud->reserve(points.size());
  for (const Eigen::Vector3f& point : points)
    if (point.allFinite()) cloud->emplace_back(point.x(), point.y(), point.z());
  return cloud;
}

Points::Ptr Thinned(const Points::Ptr& cloud, double voxel_m) {
  // Not pcl::VoxelGrid: its cells are counted in 32 bits, and a hall with 5 cm cells has more.
  auto thinned = std::make_shared<Points>();
  if (cloud->empty()) return thinned;
  pcl::octree::OctreePointCloudVoxelCentroid<pcl::PointXYZ> octree(voxel_m);
  octree.setInputCloud(cloud);
  octree.addPointsFromInputCloud();
  octree.getVoxelCentroids(thinned->points);
  thinned->width = static_cast<std::uint32_t>(thinned->points.size());
  thinned->height = 1;
  return thinned;
}

Eigen::Matrix4f MatrixOf(const Rigid<frame::Map, frame::Robot>& pose) {
  return pose.Matrix().cast<float>();
}

Rigid<frame::Map, frame::Robot> RigidOf(const Eigen::Matrix4f& matrix) {
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>().cast<double>();
  return {Eigen::Quaterniond(rotation).normalized(), matrix.topRightCorner<3, 1>().cast<double>()};
}

/// The planes that the aligned points met, and what they leave open.
class Judge {
 public:
  Judge(const Points::Ptr& reference, double reach_m) : reference_(reference), reach_m_(reach_m) {
    tree_.setInputCloud(reference);
    pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimate;
    estimate.setInputCloud(reference);
    estimate.setKSearch(16);
    estimate.compute(normals_);
  }

  void Look(const Points& moving, CloudAlignment& alignment) const {
    const Rigid<frame::Map, frame::Robot>& pose = alignment.map_from_robot;
    std::vector<Eigen::Vector3d> places, planes;
    double sum = 0.0;
    std::size_t near = 0;
    for (const pcl::PointXYZ& point : moving) {
      const Eigen::Vector3d place = pose * Eigen::Vector3d(point.x, point.y, point.z);
      const auto partner = PartnerOf(place);
      if (!partner) continue;
      ++near;
      const auto index = static_cast<std::size_t>(*partner);
      const Eigen::Vector3d normal = normals_[index].getNormalVector3fMap().cast<double>();
      // Where neighbours make no plane (edges, cables) a distance along a normal says nothing.
      if (!normal.allFinite() || normals_[index].curvature > kFlat) continue;
      const Eigen::Vector3d other = (*reference_)[index].getVector3fMap().cast<double>();
      const double distance = normal.dot(place - other);
      sum += distance * distance;
      places.push_back(place);
      planes.push_back(normal);
    }
    alignment.points = near;
    alignment.overlap_ratio =
        moving.empty() ? 0.0 : static_cast<double>(near) / static_cast<double>(moving.size());
    if (places.empty()) return;
    alignment.rms_m = std::sqrt(sum / static_cast<double>(places.size()));
    Determine(places, planes, alignment);
  }

 private:
  static constexpr float kFlat = 0.03f;

  std::optional<int> PartnerOf(const Eigen::Vector3d& place) const {
    std::vector<int> index(1);
    std::vector<float> squared(1);
    const pcl::PointXYZ at(static_cast<float>(place.x()), static_cast<float>(place.y()),
                           static_cast<float>(place.z()));
    if (tree_.nearestKSearch(at, 1, index, squared) != 1) return std::nullopt;
    if (squared[0] > reach_m_ * reach_m_) return std::nullopt;
    return index[0];
  }

  /// Covariance of a small turn and shift about the points' centre, from point-to-plane distances.
  static void Determine(const std::vector<Eigen::Vector3d>& places,
                        const std::vector<Eigen::Vector3d>& planes, CloudAlignment& alignment) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& place : places)
      centre += place / static_cast<double>(places.size());
    Matrix6 information = Matrix6::Identity() * 1e-9;
    for (std::size_t i = 0; i < places.size(); ++i) {
      Eigen::Matrix<double, 6, 1> row;
      row << (places[i] - centre).cross(planes[i]), planes[i];
      information += row * row.transpose();
    }
    // Neighbours share the scanner's systematic errors: not every point is a measurement of its
    // own. So many make the sigma as large as the spread of ten alignments (map_accuracy 5 101).
    constexpr double kPointsPerMeasurement = 400.0;
    const double variance = alignment.rms_m * alignment.rms_m * kPointsPerMeasurement;
    const Matrix6 covariance = information.inverse() * variance;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> turns(covariance.topLeftCorner<3, 3>());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> shifts(
        covariance.bottomRightCorner<3, 3>());
    alignment.largest_sigma_rad = std::sqrt(std::max(0.0, turns.eigenvalues()[2]));
    alignment.largest_sigma_m = std::sqrt(std::max(0.0, shifts.eigenvalues()[2]));
    alignment.weakest_shift = shifts.eigenvectors().col(2);
  }

  Points::Ptr reference_;
  double reach_m_;
  pcl::KdTreeFLANN<pcl::PointXYZ> tree_;
  pcl::PointCloud<pcl::Normal> normals_;
};

void TellUndetermined(const AlignCloudsOptions& options, CloudAlignment& alignment) {
  const Eigen::Vector3d& w = alignment.weakest_shift;
  if (alignment.largest_sigma_m > options.max_sigma_m)
    alignment.undetermined.push_back(
        fmt::format("the shift along ({:.2f}, {:.2f}, {:.2f}) is known to {:.0f} mm only", w.x(),
                    w.y(), w.z(), 1e3 * alignment.largest_sigma_m));
  if (alignment.largest_sigma_rad > options.max_sigma_rad)
    alignment.undetermined.push_back(fmt::format("a turn is known to {:.2f} deg only",
                                                 DegreesFromRadians(alignment.largest_sigma_rad)));
}

Status CheckCount(const char* which, const Points& cloud) {
  if (cloud.size() >= kFewestPoints) return {};
  return Fail(ErrorCode::kTooFewPoints, "the {} cloud has {} points after thinning, {} are needed",
              which, cloud.size(), kFewestPoints);
}

}  // namespace

Status AlignCloudsOptions::Check() const {
  const auto positive = [](const char* name, double value) -> Status {
    if (value > 0.0 && std::isfinite(value)) return {};
    return Fail(ErrorCode::kInvalidOptions, "AlignCloudsOptions::{} {} is not positive", name,
                value);
  };
  FORESIGHT_CHECK(positive("voxel_m", voxel_m));
  for (const double reach : reach_m) FORESIGHT_CHECK(positive("reach_m", reach));
  FORESIGHT_CHECK(positive("max_sigma_m", max_sigma_m));
  FORESIGHT_CHECK(positive("max_sigma_rad", max_sigma_rad));
  if (max_iterations < 1)
    return Fail(ErrorCode::kInvalidOptions, "AlignCloudsOptions::max_iterations {} is below 1",
                max_iterations);
  if (!(min_overlap_ratio >= 0.0 && min_overlap_ratio <= 1.0))
    return Fail(ErrorCode::kInvalidOptions,
                "AlignCloudsOptions::min_overlap_ratio {} is not between 0 and 1",
                min_overlap_ratio);
  return {};
}

Result<CloudAlignment> AlignClouds(std::span<const Eigen::Vector3f> reference,
                                   std::span<const Eigen::Vector3f> moving,
                                   const Rigid<frame::Map, frame::Robot>& guess,
                                   const AlignCloudsOptions& options, const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  const Points::Ptr target = Thinned(CloudOf(reference), options.voxel_m);
  const Points::Ptr source = Thinned(CloudOf(moving), options.voxel_m);
  FORESIGHT_CHECK(CheckCount("reference", *target));
  FORESIGHT_CHECK(CheckCount("moving", *source));
  pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
  icp.setInputTarget(target);
  icp.setInputSource(source);
  icp.setMaximumIterations(options.max_iterations);
  icp.setTransformationEpsilon(1e-6);
  icp.setRotationEpsilon(1e-6);
  Eigen::Matrix4f pose = MatrixOf(guess);
  for (std::size_t stage = 0; stage < options.reach_m.size(); ++stage) {
    if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the alignment was cancelled");
    context.Report(static_cast<double>(stage) / 4.0, "aligning clouds");
    icp.setMaxCorrespondenceDistance(options.reach_m[stage]);
    Points aligned;
    icp.align(aligned, pose);
    pose = icp.getFinalTransformation();
    if (!pose.allFinite())
      return Fail(ErrorCode::kNoConvergence, "the clouds have nothing in common near the guess");
  }
  CloudAlignment alignment;
  alignment.map_from_robot = RigidOf(pose);
  Judge(target, options.reach_m.back()).Look(*source, alignment);
  if (alignment.overlap_ratio < options.min_overlap_ratio)
    return Fail(ErrorCode::kNoConvergence,
                "only {:.0f} % of the points lie on the other cloud ({:.0f} % are needed): the "
                "scans show too little in common, or the first guess is too far off",
                100.0 * alignment.overlap_ratio, 100.0 * options.min_overlap_ratio);
  TellUndetermined(options, alignment);
  return alignment;
}

}  // namespace foresight
