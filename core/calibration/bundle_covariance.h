#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/calibration/camera_bundle.h"
#include "core/calibration/rotation_step.h"

namespace foresight {

/// What is known, and how well, after least squares: the inverse of J^T J of all unknowns together,
/// times the variance of a pixel coordinate. The unknowns that all views share are the camera's
/// values and, where it was free, the warp.
class BundleCovariance {
 public:
  /// At the bundle as it is. The variance is the residuals' own, over the degrees of freedom;
  /// corners that the lens does not show are left out. nullopt where some combination of unknowns
  /// is not observable.
  static std::optional<BundleCovariance> Of(const CameraBundle& bundle, bool free_warp);

  /// Standard deviation of a pixel coordinate, px.
  double noise_px() const { return noise_px_; }
  /// Of the camera's values, then of the warp's two, metres.
  const Eigen::MatrixXd& shared() const { return shared_; }
  CameraModel::Parameters ValueSigmas() const;
  Eigen::Vector2d WarpSigmas_m() const;

  /// How uncertain the place is at which a point appears, px^2: the point that `pixel` sees at
  /// `distance_m` (infinity is allowed). The point is known by where it lies to the boards, as
  /// mrcal has it, because the camera's own frame moves with its errors: a principal point that is
  /// off by a pixel is harmless where the whole frame is turned by as much. nullopt for a pixel
  /// without a ray.
  std::optional<Eigen::Matrix2d> OfProjection(const Eigen::Vector2d& pixel,
                                              double distance_m) const;

 private:
  struct ViewBlock {
    CameraFromPattern pose;
    Eigen::MatrixXd coupling;                ///< how the shared unknowns move the pose: -(this)^T
    Eigen::Matrix<double, 6, 6> covariance;  ///< of the pose if the shared unknowns were known
  };

  CameraModel camera_;
  bool free_warp_ = false;
  double noise_px_ = 0.0;
  Eigen::MatrixXd shared_;
  std::vector<ViewBlock> views_;
};

}  // namespace foresight
