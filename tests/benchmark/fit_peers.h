#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace foresight::peers {

using Points = std::vector<Eigen::Vector3d>;

/// A circle in space: where a rim is.
struct Circle {
  Eigen::Vector3d middle;
  Eigen::Vector3d axis;
  double radius_m = 0.0;
};

/// A flat patch with the smallest rectangle round it.
struct Patch {
  Eigen::Isometry3d pose;  ///< the rectangle's middle, z its normal
  Eigen::Vector2d size_m;
};

/// PCL writes a line for each sample of three points that it rejects; from here on it does not.
void QuietPcl();

/// SACMODEL_CIRCLE3D by RANSAC; nullopt where PCL finds none.
std::optional<Circle> PclCircle(const Points& points, double inlier_m);

/// The axis of SACMODEL_CYLINDER with normals of 20 neighbours, radii of 15 to 60 mm.
std::optional<Circle> PclCylinder(const Points& points, double inlier_m);

/// The scene's points onto the template's from each start (base from template); that with the
/// least mean distance.
std::optional<Eigen::Isometry3d> PclIcp(const Points& scene, const Points& model,
                                        const std::vector<Eigen::Isometry3d>& starts);

/// Planes by RegionGrowing on normals of 30 neighbours, 5 deg.
std::vector<Patch> PclRegionGrowing(const Points& points, const Eigen::Vector3d& up);

/// Planes by OrganizedMultiPlaneSegmentation: a row-major grid, NaN = none.
std::vector<Patch> PclOrganizedPlanes(const Points& grid, int width, const Eigen::Vector3d& up);

}  // namespace foresight::peers
