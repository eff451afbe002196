#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/simulation/scene.h"

namespace foresight {

/// The colours of a scene's surfaces, with their procedural patterns and prints, ready for many
/// look-ups. The scene outlives it.
class SurfaceColor {
 public:
  explicit SurfaceColor(const Scene& scene);

  /// What points that lie close together share: cells of the noise lattice. One for each thread.
  struct Neighbourhood {
    struct Cell {
      std::array<int, 3> corner = {};
      std::array<float, 8> values = {};
      bool filled = false;
    };
    std::array<Cell, 2> octaves;
  };

  /// Linear reflectance at a point of a mesh; point and normal in robot. The answer does not depend
  /// on the neighbourhood, only its cost does.
  Eigen::Vector3f At(int mesh, const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                     Neighbourhood* near) const;

  /// Whether a mesh's print is on the side that `normal` points from.
  bool IsPrinted(int mesh, const Eigen::Vector3f& normal) const;
  /// The mean over a small quadrilateral of a printed side.
  Eigen::Vector3f MeanOfPrint(int mesh, const std::array<Eigen::Vector3f, 4>& points) const;

 private:
  struct Paint {
    Material::Pattern pattern;
    Eigen::Vector3f color;
    Eigen::Vector3f color2;
    float per_metre;  ///< pattern cells
    Eigen::Matrix3f object_from_robot;
    Eigen::Vector3f origin;  ///< of the object's frame, in robot
    const BoardFace* face;   ///< of the scene; nullptr = no print

    Eigen::Vector2f OnFace(const Eigen::Vector3f& point) const {
      return (object_from_robot * (point - origin)).head<2>();
    }
  };
  std::vector<Paint> paints_;
};

}  // namespace foresight
