#pragma once

#include "core/evaluation/stereo_scene.h"

namespace foresight {

/// The same scene at `factor` times the size: the disparities of both views interpolated on
/// surfaces (bilinear where the four neighbours are one surface, the nearest one elsewhere), image
/// bicubic.
StereoScene EnlargeScene(const StereoScene& scene, int factor);

}  // namespace foresight
