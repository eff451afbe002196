// PCL's own fits, as its tutorials set them up; lengths scaled to the objects.
#include <pcl/console/print.h>
#include <pcl/features/integral_image_normal.h>
#include <pcl/features/normal_3d.h>
#include <pcl/registration/icp.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>
#include <pcl/segmentation/region_growing.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "tests/benchmark/fit_peers.h"

namespace foresight::peers {
namespace {

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Normals = pcl::PointCloud<pcl::Normal>;

constexpr double kLeastArea_m2 = 0.02;
constexpr double kMostTilt_cos = 0.70;

Cloud::Ptr CloudOf(const Points& points) {
  Cloud::Ptr cloud(new Cloud);
  for (const Eigen::Vector3d& p : points)
    cloud->push_back(
        Point(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())));
  return cloud;
}

Normals::Ptr NormalsOf(const Cloud::Ptr& cloud, int neighbours) {
  pcl::NormalEstimation<Point, pcl::Normal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setKSearch(neighbours);
  Normals::Ptr normals(new Normals);
  estimation.compute(*normals);
  return normals;
}

/// The rectangle of least area round points of a plane, tried degree by degree.
std::optional<Patch> PatchOf(const Points& points, const Eigen::Vector3d& up) {
  if (points.size() < 20) return std::nullopt;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) spread += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  Eigen::Vector3d z = solver.eigenvectors().col(0);
  if (z.dot(up) < 0.0) z = -z;
  if (z.dot(up) < kMostTilt_cos) return std::nullopt;
  const Eigen::Vector3d x = z.unitOrthogonal(), y = z.cross(x);
  std::optional<Patch> best;
  for (int degree = 0; degree < 90; ++degree) {
    const double turn = degree * 0.017453292519943295;
    const Eigen::Vector3d u = std::cos(turn) * x + std::sin(turn) * y, v = z.cross(u);
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector3d& p : points)
      box.extend(Eigen::Vector2d(u.dot(p - mean), v.dot(p - mean)));
    if (best && box.sizes().prod() >= best->size_m.prod()) continue;
    Patch patch;
    patch.pose.linear() << u, v, z;
    patch.pose.translation() = mean + box.center().x() * u + box.center().y() * v;
    patch.pose.makeAffine();
    patch.size_m = box.sizes();
    best = patch;
  }
  if (best->size_m.prod() < kLeastArea_m2) return std::nullopt;
  return best;
}

std::vector<Patch> PatchesOf(const Cloud& cloud, const std::vector<pcl::PointIndices>& clusters,
                             const Eigen::Vector3d& up) {
  std::vector<Patch> patches;
  for (const pcl::PointIndices& cluster : clusters) {
    Points points;
    for (const int i : cluster.indices)
      points.push_back(cloud[static_cast<std::size_t>(i)].getVector3fMap().cast<double>());
    if (const auto patch = PatchOf(points, up)) patches.push_back(*patch);
  }
  return patches;
}

}  // namespace

void QuietPcl() {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
}

std::optional<Circle> PclCircle(const Points& points, double inlier_m) {
  pcl::SACSegmentation<Point> segmentation;
  segmentation.setModelType(pcl::SACMODEL_CIRCLE3D);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setMaxIterations(2000);
  segmentation.setDistanceThreshold(inlier_m);
  segmentation.setRadiusLimits(0.04, 0.30);
  segmentation.setInputCloud(CloudOf(points));
  pcl::PointIndices inliers;
  pcl::ModelCoefficients found;
  segmentation.segment(inliers, found);
  if (found.values.size() != 7) return std::nullopt;
  const auto& v = found.values;
  return Circle{{v[0], v[1], v[2]}, Eigen::Vector3d(v[4], v[5], v[6]).normalized(), v[3]};
}

std::optional<Circle> PclCylinder(const Points& points, double inlier_m) {
  const Cloud::Ptr cloud = CloudOf(points);
  pcl::SACSegmentationFromNormals<Point, pcl::Normal> segmentation;
  segmentation.setModelType(pcl::SACMODEL_CYLINDER);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setNormalDistanceWeight(0.1);
  segmentation.setMaxIterations(10000);
  segmentation.setDistanceThreshold(inlier_m);
  segmentation.setRadiusLimits(0.015, 0.060);
  segmentation.setInputCloud(cloud);
  segmentation.setInputNormals(NormalsOf(cloud, 20));
  pcl::PointIndices inliers;
  pcl::ModelCoefficients found;
  segmentation.segment(inliers, found);
  if (found.values.size() != 7) return std::nullopt;
  const auto& v = found.values;
  return Circle{{v[0], v[1], v[2]}, Eigen::Vector3d(v[3], v[4], v[5]).normalized(), v[6]};
}

std::optional<Eigen::Isometry3d> PclIcp(const Points& scene, const Points& model,
                                        const std::vector<Eigen::Isometry3d>& starts) {
  pcl::IterativeClosestPoint<Point, Point> icp;
  icp.setInputSource(CloudOf(scene));
  icp.setInputTarget(CloudOf(model));
  icp.setMaxCorrespondenceDistance(0.10);
  icp.setMaximumIterations(60);
  double least = std::numeric_limits<double>::infinity();
  std::optional<Eigen::Isometry3d> best;
  for (const Eigen::Isometry3d& base_from_model : starts) {
    Cloud aligned;
    icp.align(aligned, base_from_model.inverse().matrix().cast<float>());
    if (!icp.hasConverged()) continue;
    const double distance = icp.getFitnessScore(0.10);
    if (distance >= least) continue;
    least = distance;
    Eigen::Isometry3d model_from_base;
    model_from_base.matrix() = icp.getFinalTransformation().cast<double>();
    best = model_from_base.inverse();
  }
  return best;
}

std::vector<Patch> PclRegionGrowing(const Points& points, const Eigen::Vector3d& up) {
  const Cloud::Ptr cloud = CloudOf(points);
  pcl::RegionGrowing<Point, pcl::Normal> growing;
  growing.setMinClusterSize(40);
  growing.setMaxClusterSize(1000000);
  growing.setSearchMethod(pcl::search::Search<Point>::Ptr(new pcl::search::KdTree<Point>));
  growing.setNumberOfNeighbours(30);
  growing.setInputCloud(cloud);
  growing.setInputNormals(NormalsOf(cloud, 30));
  growing.setSmoothnessThreshold(0.0873f);
  growing.setCurvatureThreshold(1.0f);
  std::vector<pcl::PointIndices> clusters;
  growing.extract(clusters);
  return PatchesOf(*cloud, clusters, up);
}

std::vector<Patch> PclOrganizedPlanes(const Points& grid, int width, const Eigen::Vector3d& up) {
  const Cloud::Ptr cloud = CloudOf(grid);
  cloud->width = static_cast<std::uint32_t>(width);
  cloud->height = static_cast<std::uint32_t>(grid.size()) / cloud->width;
  cloud->is_dense = false;
  if (cloud->height < 4) return {};
  pcl::IntegralImageNormalEstimation<Point, pcl::Normal> estimation;
  estimation.setNormalEstimationMethod(estimation.COVARIANCE_MATRIX);
  estimation.setMaxDepthChangeFactor(0.02f);
  estimation.setNormalSmoothingSize(10.0f);
  estimation.setInputCloud(cloud);
  Normals::Ptr normals(new Normals);
  estimation.compute(*normals);
  pcl::OrganizedMultiPlaneSegmentation<Point, pcl::Normal, pcl::Label> segmentation;
  segmentation.setMinInliers(40);
  segmentation.setAngularThreshold(0.0873);
  segmentation.setDistanceThreshold(0.02);
  segmentation.setInputNormals(normals);
  segmentation.setInputCloud(cloud);
  std::vector<pcl::ModelCoefficients> planes;
  std::vector<pcl::PointIndices> clusters;
  segmentation.segment(planes, clusters);
  return PatchesOf(*cloud, clusters, up);
}

}  // namespace foresight::peers
