#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>

#include "core/simulation/scene.h"

namespace foresight {

struct SceneRay {
  Eigen::Vector3f origin;     ///< in robot
  Eigen::Vector3f direction;  ///< length 1
};

struct SceneHit {
  float distance_m = 0.0f;                           ///< NaN = nothing hit
  int mesh = -1;                                     ///< index into Scene::meshes; -1 = nothing hit
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< length 1, towards the ray's origin
  /// The triangle was hit where its corners run clockwise: of a solid, from inside.
  bool from_behind = false;
};

/// A scene ready for ray casting (Embree). Casting is const and safe from many threads. Surfaces
/// are seen from both sides. The constructor throws std::runtime_error where Embree cannot start.
class RayCaster {
 public:
  explicit RayCaster(std::shared_ptr<const Scene> scene);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  const Scene& scene() const;
  SceneHit Cast(const SceneRay& ray) const;
  /// Packets of sixteen: several times faster for rays that lie close together. Sizes are equal.
  void Cast(std::span<const SceneRay> rays, std::span<SceneHit> hits) const;
  /// Whether anything lies within `distance_m` along the ray.
  bool Occluded(const SceneRay& ray, float distance_m) const;
  /// Same in packets of sixteen; 1 = occluded. Sizes are equal.
  void Occluded(std::span<const SceneRay> rays, std::span<const float> distances_m,
                std::span<std::uint8_t> occluded) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace foresight
