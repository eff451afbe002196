#pragma once

#include <array>
#include <memory>

#include "core/calibration/chain_problem.h"

namespace ceres {
class CostFunction;
}

// Residuals of the chain for Ceres, with their derivatives. A pose's parameter block is 7 doubles
// (quaternion w x y z, translation); its derivatives are those by a step in its own frame
// (tangent.h) and stand in the first 6 columns, where PoseManifold expects them.
namespace foresight::chain {

using PoseBlock = std::array<double, 7>;

template <class To, class From>
PoseBlock BlockOf(const Rigid<To, From>& rigid) {
  const Eigen::Quaterniond& q = rigid.rotation();
  const Eigen::Vector3d& t = rigid.translation();
  return {q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()};
}

template <class To, class From>
Rigid<To, From> PoseOf(const double* block) {
  return {Eigen::Quaterniond(block[0], block[1], block[2], block[3]),
          Eigen::Vector3d(block[4], block[5], block[6])};
}

/// Plate angles between the stops: each stop's weight in the spline of AngleCorrection.
class AngleTable {
 public:
  explicit AngleTable(std::vector<double> motor_rad);

  /// The plate's angle where the motor says `motor_rad`; by_stop may be null.
  double PlateAngle(double motor_rad, const double* plate_rad, double* by_stop) const;
  int size() const { return static_cast<int>(motor_rad_.size()); }

 private:
  std::vector<double> motor_rad_;
  std::vector<AngleCorrection> basis_;
};

/// Corners of an intrinsic image. Blocks: camera, pose.
std::unique_ptr<ceres::CostFunction> MakeViewCost(const CornerSet& corners,
                                                  const CameraModel& camera, double sigma_px);

/// Corners of a board of the stand. Blocks: camera, head, angles, jitter, pose, and a_from_b of a
/// board B.
std::unique_ptr<ceres::CostFunction> MakeMountCost(const CornerSet& corners,
                                                   const CameraModel& camera, int stops,
                                                   double sigma_px);

/// Returns from a board. Blocks: lidar, range offset, head, angles, then jitter of a visit or stamp
/// offset of a sweep, pose, and a_from_b of a board B.
struct HitCostOptions {
  LidarResidual residual = LidarResidual::kRange;
  double huber_sigmas = 0.0;
};
std::unique_ptr<ceres::CostFunction> MakeHitCost(const BoardHits& hits,
                                                 std::shared_ptr<const AngleTable> angles,
                                                 const MotorTrack* track,
                                                 const HitCostOptions& options);

/// value / sigma. One block of one number.
std::unique_ptr<ceres::CostFunction> MakePriorCost(double sigma);

}  // namespace foresight::chain
