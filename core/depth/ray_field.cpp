#include "core/depth/ray_field.h"

#include <deque>
#include <limits>
#include <mutex>
#include <utility>

#include "core/base/parallel.h"
#include "core/sensor/camera_model.h"

namespace foresight {
namespace {

constexpr std::size_t kKeptFields = 3;

std::shared_ptr<const RayField> MakeRays(const CameraModel& camera) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  auto rays = std::make_shared<RayField>();
  rays->x = FloatImage(camera.width, camera.height, kNaN);
  rays->y = rays->x;
  ParallelFor(camera.height, {}, [&](int v) {
    for (int u = 0; u < camera.width; ++u)
      if (const auto ray = camera.UnprojectToPlane({u, v})) {
        rays->x(u, v) = static_cast<float>(ray->x());
        rays->y(u, v) = static_cast<float>(ray->y());
      }
  });
  return rays;
}

}  // namespace

std::shared_ptr<const RayField> RaysOf(const CameraModel& camera) {
  static std::mutex mutex;
  static std::deque<std::pair<CameraModel, std::shared_ptr<const RayField>>> kept;
  const std::lock_guard lock(mutex);
  for (const auto& [known, rays] : kept)
    if (known == camera) return rays;
  kept.emplace_front(camera, MakeRays(camera));
  if (kept.size() > kKeptFields) kept.pop_back();
  return kept.front().second;
}

}  // namespace foresight
