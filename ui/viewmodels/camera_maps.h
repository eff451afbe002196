#pragma once

#include "core/calibration/projection_maps.h"

namespace foresight {

/// How well a calibrated camera is known in each part of its image.
struct CameraMaps {
  double distance_m = 0.0;
  ImageField uncertainty;  ///< at the distance; empty where it is not known
  ImageField uncertainty_at_infinity;
  ImageField halves;  ///< odd against even images, at the distance; empty where they are too few
  ImageField halves_at_infinity;
};

/// Under a second for 30 images.
Result<CameraMaps> MakeCameraMaps(const CalibrationBoard& board, const ModelCalibration& model,
                                  double distance_m, const RunContext& context);

}  // namespace foresight
