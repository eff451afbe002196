#pragma once

#include <memory>

#include "core/base/image.h"

namespace foresight {

struct CameraModel;

/// Where each pixel of an image looks: (X/Z, Y/Z) of its ray. A plane in space is exactly linear in
/// these, whatever the lens. NaN at 90 deg from the axis and beyond.
struct RayField {
  FloatImage x;
  FloatImage y;
};

/// The rays of a camera's pixels. The last few cameras' fields are kept and shared, as the same
/// camera is asked for with each image. Safe from any thread.
std::shared_ptr<const RayField> RaysOf(const CameraModel& camera);

}  // namespace foresight
