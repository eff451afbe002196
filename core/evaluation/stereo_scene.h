#pragma once

#include <filesystem>
#include <string>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

/// A scene in the form of the Middlebury stereo data sets of 2014: two rectified views and the
/// disparity of the left one. depth = baseline focal / (disparity + offset).
struct StereoScene {
  std::string name;
  ColorImage right;           ///< the guidance image of the testbed
  FloatImage left_disparity;  ///< pixels; NaN = unknown
  MaskImage left_in_both;     ///< 255 = the pixel is also seen by the right view
  double baseline_m = 0.0;
  double focal_px = 0.0;
  double left_cx = 0.0;  ///< principal points, pixels
  double right_cx = 0.0;
  double cy = 0.0;
  double disparity_offset_px = 0.0;  ///< doffs

  double DepthOf(double disparity_px) const {
    return baseline_m * focal_px / (disparity_px + disparity_offset_px);
  }
  double DisparityOf(double depth_m) const {
    return baseline_m * focal_px / depth_m - disparity_offset_px;
  }
};

/// Reads calib.txt, im1.png, disp0GT.pfm and, where there is one, mask0nocc.png of a folder.
/// im0.png must be there and of the same size, as the data set promises. Fails with kIo or
/// kBadData.
Result<StereoScene> LoadStereoScene(const std::filesystem::path& folder);

/// The same scene at `factor` times the size: disparity interpolated on surfaces (bilinear where
/// the four neighbours are one surface, the nearest one elsewhere), image bicubic.
StereoScene EnlargeScene(const StereoScene& scene, int factor);

}  // namespace foresight
