#pragma once

#include <Eigen/Core>
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
  int mesh = -1;                                     ///< index into Scene::meshes
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< length 1, towards the ray's origin
};

/// A scene ready for ray casting (Embree). Casting is const and safe from many threads.
class RayCaster {
 public:
  explicit RayCaster(std::shared_ptr<const Scene> scene);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  const Scene& scene() const;
  SceneHit Cast(const SceneRay& ray) const;
  /// Packets of eight: several times faster for rays that lie close together.
  void Cast(std::span<const SceneRay> rays, std::span<SceneHit> hits) const;
  /// Whether anything lies within `distance_m` along the ray.
  bool Occluded(const SceneRay& ray, float distance_m) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace foresight
