#pragma once

#include <memory>

#include "core/base/shared_list.h"
#include "core/fitting/ray_set.h"
#include "core/sensor/camera_frame.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// The edges of that image of a scan which shows a region best: the one that the region was drawn
/// on; for a box the one that shows most of its rays, the nearest to its middle. Null where no
/// image of the camera's size shows any. `outline_weight`: of ImageEdges. O(pixels of the region).
std::shared_ptr<const ImageEdges> ImageOfRegion(const SharedList<CameraFrame>& frames,
                                                const SensorRig& rig, const Roi& roi,
                                                const RaySet& rays, double outline_weight);

}  // namespace foresight
