#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace foresight {

/// calib.txt of a rectified Middlebury pair.
struct StereoCalibration {
  double focal_px = 0.0;
  double left_cx = 0.0;  ///< principal points, pixels
  double right_cx = 0.0;
  double cy = 0.0;
  double disparity_offset_px = 0.0;  ///< doffs
  double baseline_m = 0.0;
  int width = 0;  ///< 0 = the file does not say
  int height = 0;
};

/// Reads cam0, cam1, doffs, baseline and, where given, width and height; other keys are ignored.
/// Fails with kIo, or with kBadData for a missing key, a value that is no number, a focal length or
/// baseline that is not positive, or two cameras of different focal length.
Result<StereoCalibration> ReadStereoCalibration(const std::filesystem::path& path);

}  // namespace foresight
