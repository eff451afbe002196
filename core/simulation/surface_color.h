#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/simulation/scene.h"

namespace foresight {

/// The colours of a scene's surfaces, with their procedural patterns, ready for many look-ups.
class SurfaceColor {
 public:
  explicit SurfaceColor(const Scene& scene);

  /// Linear reflectance at a point of a mesh; point and normal in robot.
  Eigen::Vector3f At(int mesh, const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const;

 private:
  struct Paint {
    Material::Pattern pattern;
    Eigen::Vector3f color;
    Eigen::Vector3f color2;
    float per_metre;  ///< pattern cells
    Eigen::Matrix3f object_from_robot;
    Eigen::Vector3f origin;  ///< of the object's frame, in robot
  };
  std::vector<Paint> paints_;
};

}  // namespace foresight
