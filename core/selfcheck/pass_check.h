#pragma once

#include "core/registration/register_scan.h"

namespace foresight {

struct PassCheckOptions {
  int beams = 12;           ///< of a patch, 3 deg of the usual lidar
  double turn_rad = 0.035;  ///< of the plate across a patch, 2 deg
  int least_lines = 3;      ///< of each way in a patch
  double least_filled = 0.7;
  double most_rms_m = 0.030;  ///< rougher patches are no surface
  double floor_m = 0.001;     ///< what a patch's offset is not better than
  double least_speed_rad_s = 0.01;
  int least_patches = 60;
  int groups = 12;  ///< of neighbouring beams, for the deviation
  double tukey_sigmas = 4.7;
};

/// How the ranges of the ways up and down lie on each other: where a surface slopes along the
/// plate's way, stamps that are off part them. No plane is needed, only surfaces.
struct PassCheck {
  double stamp_s = 0.0;  ///< to be added to the lidar's stamps
  double sigma_s = 0.0;
  double speed_rad_s = 0.0;  ///< of the plate, mean of both ways
  int patches = 0;
};

/// Fails with kTooFewPoints where the scan does not sweep both ways, or shows too few surfaces.
Result<PassCheck> CheckPasses(const Scan& scan, const RegisteredScan& cloud,
                              const PassCheckOptions& options);

}  // namespace foresight
