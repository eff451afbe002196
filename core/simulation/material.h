#pragma once

#include <Eigen/Core>

namespace foresight {

/// How a surface answers light and laser.
struct Material {
  Eigen::Vector3d color = {0.6, 0.6, 0.6};  ///< linear reflectance, 0 to 1
  enum class Pattern { kPlain, kChecker, kStripes, kNoise, kBrick } pattern = Pattern::kPlain;
  Eigen::Vector3d color2 = {0.4, 0.4, 0.4};  ///< the pattern's other colour
  double pattern_size_m = 0.1;
  double lidar_reflectance = 0.5;  ///< at the laser's wavelength
  double specular = 0.0;           ///< fraction that is mirrored away: such a return may be lost
  double emission = 0.0;           ///< light of its own; 1 = as bright as white under light 1
};

}  // namespace foresight
