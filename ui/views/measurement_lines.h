#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/pictures/projected_wireframe.h"
#include "ui/viewmodels/measure_view_model.h"
#include "ui/views/outlines.h"

namespace foresight {

/// A measurement, or what there is of one that is being taken: lines from point to point, a cross
/// at each point, and its value.
struct RobotMeasurement {
  Wireframe lines;   ///< in robot, or in map where the cloud shows one; metres
  Wireframe points;  ///< crosses
  Eigen::Vector3d label_at = Eigen::Vector3d::Zero();
  std::string label;  ///< UTF-8; empty while it is being taken
  OutlineStyle style;
};
struct PixelMeasurement {
  PixelLines lines;  ///< in the current image
  PixelLines points;
  std::optional<Eigen::Vector2d> label_at;  ///< none where it is out of sight
  std::string label;
  OutlineStyle style;
};

/// All of the scan that is shown, and the one that is being taken in it. The selected one is
/// thicker.
std::vector<RobotMeasurement> MeasurementsInRobot(const SessionModel& session,
                                                  const MeasureViewModel& measure);
/// The same of what the cloud shows: of the map, those that lie in it (LiesInMap).
std::vector<RobotMeasurement> MeasurementsInCloud(const SessionModel& session,
                                                  const MeasureViewModel& measure);
std::vector<PixelMeasurement> MeasurementsInImage(const SessionModel& session,
                                                  const MeasureViewModel& measure);
/// Where a place in robot is in the current image; nullopt = out of sight.
std::optional<Eigen::Vector2d> PixelInImage(const SessionModel& session,
                                            const Eigen::Vector3d& place);

}  // namespace foresight
