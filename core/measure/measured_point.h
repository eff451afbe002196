#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>

namespace foresight {

/// A place that was measured: a return of the lidar, or a pixel of a depth map.
struct MeasuredPoint {
  enum class Source { kLidar, kDepth };

  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< in the measurement's frame
  Source source = Source::kLidar;
  std::string scan_uuid;
  int line = -1;  ///< of a return: counted from 0 in the scan
  int beam = -1;
  int image = -1;  ///< of a pixel: the image's position in the scan
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double range_m = std::nan("");  ///< from the sensor
  double sigma_m = std::nan("");  ///< of the range; NaN = not known
  /// Of its scan's place in a map, along each axis; 0 where the frame is the scan's own.
  double placement_sigma_m = 0.0;
  /// Unit vector away from the sensor, in the measurement's frame.
  Eigen::Vector3d ray = Eigen::Vector3d::Zero();
};

/// "line 12, beam 540" or "depth map of image 1, pixel (320, 240)".
std::string OriginText(const MeasuredPoint& point);

}  // namespace foresight
