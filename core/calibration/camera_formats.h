#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/calibration/camera_refit.h"

namespace foresight {

/// How other programs write a camera.
enum class CameraFormat { kOpenCv, kRos, kKalibr, kColmap };

/// "opencv", "ros", "kalibr", "colmap".
std::string_view ToString(CameraFormat format);
/// Fails with kInvalidOptions.
Result<CameraFormat> CameraFormatFromText(std::string_view text);

/// A camera in another program's file.
struct CameraExport {
  std::string text;
  std::string model;  ///< as that program calls it
  /// Where the format has no name for the camera's model: the refit that was written instead, with
  /// its largest error over the image; else the file says the same.
  std::optional<CameraRefit> refit;
};

/// OpenCV's FileStorage YAML (cv::fisheye for kb4), ROS's camera_info, Kalibr's camchain, COLMAP's
/// cameras.txt. The paper's k is the FOV model there (w = 2 atan(k / 2), f_FOV = f w / k); OpenCV
/// and ROS have no name for it, and none but Kalibr has one for EUCM: KB4 is fitted. Kalibr's
/// radtan has no k3. Principal points are COLMAP's in its file: its first pixel's centre is (0.5,
/// 0.5). Fails as RefitCamera does.
Result<CameraExport> ExportCamera(const CameraModel& camera, CameraFormat format);

/// The reverse. A model of theirs that is none of ours is refused by name. Fails with kBadData,
/// naming `source` and what is wrong.
Result<CameraModel> ImportCamera(const std::string& text, CameraFormat format,
                                 const std::string& source);

}  // namespace foresight
