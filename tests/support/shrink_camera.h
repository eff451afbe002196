#pragma once

#include "core/sensor/camera_model.h"

namespace foresight {

/// The same lens before a sensor of fewer pixels, for tests that draw many images.
inline void Shrink(double scale, CameraModel* camera) {
  camera->width = static_cast<int>(camera->width * scale);
  camera->height = static_cast<int>(camera->height * scale);
  camera->fx *= scale;
  camera->fy *= scale;
  camera->cx = scale * (camera->cx + 0.5) - 0.5;
  camera->cy = scale * (camera->cy + 0.5) - 0.5;
}

}  // namespace foresight
