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
  /// Fraction of the laser's light that goes on to what lies behind. A camera sees the surface.
  double translucency = 0.0;
  /// The laser's light comes back from this far below the surface: its range reads longer.
  double penetration_m = 0.0;
};

}  // namespace foresight
