#pragma once

#include <filesystem>
#include <string>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

/// A scene in the form of the Middlebury stereo data sets of 2014: two rectified views and the
/// disparity of the left one, sometimes of both. depth = baseline focal / (disparity + offset).
struct StereoScene {
  std::string name;
  ColorImage right;            ///< the guidance image of the testbed
  FloatImage left_disparity;   ///< pixels; NaN = unknown
  FloatImage right_disparity;  ///< same, of the right view; empty where the data set has none
  MaskImage left_in_both;      ///< 255 = the pixel is also seen by the right view
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

/// Reads a folder of either form of the data set (docs/formats.md): calib.txt, im0.png, im1.png,
/// the left view's disparity (disp0GT.pfm or disp0.pfm) and, where they are there, the right view's
/// (disp1GT.pfm or disp1.pfm) and mask0nocc.png. All of one size, that of calib.txt where it names
/// one. Fails with kIo where a file is missing, or kBadData.
Result<StereoScene> LoadStereoScene(const std::filesystem::path& folder);

}  // namespace foresight
