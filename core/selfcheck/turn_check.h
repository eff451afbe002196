#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/base/run_context.h"
#include "core/registration/register_scan.h"

namespace foresight {

struct TurnCheckOptions {
  double least_spread_rad = 0.15;  ///< between the images that are farthest apart, 9 deg
  double most_apart_rad = 0.9;     ///< of two images that are compared
  int most_points = 1500;          ///< of a pair of images
  int most_points_in_all = 6000;
  int most_images = 7;           ///< evenly over the angles, where there are more
  int least_points = 120;        ///< of all pairs that could be followed
  int groups = 12;               ///< of neighbouring points, for the deviations
  double shift_prior_m = 0.005;  ///< of the camera on the plate
  /// What a good motor is off by at an image, between the knots of its calibration: 0.025 deg.
  double motor_sigma_rad = 0.00044;
  double tukey_sigmas = 4.7;
  /// Of what the patches vary by, what must be explained by the image that they are followed into.
  double least_explained = 0.3;
};

/// How the images of one scan turn into each other, against what the motor says: points of the
/// lidar are followed from image to image, and the ranges say what the camera's own way adds.
struct TurnCheck {
  enum Unknown { kScale, kBend, kCameraY, kCameraZ, kUnknowns };

  /// How much farther the plate turns than the motor says (of its turn); halfway between the
  /// outermost images, how far the plate is ahead of where its scale alone would have it (rad); how
  /// far the camera turned on the plate since the calibration, about the head's y and z axes (rad).
  /// About x, the motor's axis, no turn shows: camera and plate turn alike.
  Eigen::Matrix<double, kUnknowns, 1> drift;
  Eigen::Matrix<double, kUnknowns, kUnknowns> covariance;
  bool bend_seen = false;   ///< three images and more; else kBend stays 0, with an infinite sigma
  double spread_rad = 0.0;  ///< between the outermost images, by the motor
  int images = 0;
  int points = 0;          ///< that were followed, of all pairs of images
  double explained = 0.0;  ///< of what the patches vary by, 0 to 1

  double Sigma(Unknown unknown) const { return std::sqrt(covariance(unknown, unknown)); }
};

/// Fails with kTooFewPoints where the scan has no two images far enough apart, or too little in
/// them can be followed, and with kCancelled. The light is taken to stand still.
Result<TurnCheck> CheckTurns(const Scan& scan, const RegisteredScan& cloud,
                             const TurnCheckOptions& options, const RunContext& context);

}  // namespace foresight
