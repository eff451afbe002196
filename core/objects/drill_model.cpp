#include "core/objects/drill_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace foresight {

Status DrillModel::Check() const {
  if (!(scale >= 0.5 && scale <= 2.0))
    return Fail(ErrorCode::kInvalidOptions, "drill: scale {} is not within 0.5 to 2", scale);
  if (parts.empty()) return Fail(ErrorCode::kInvalidOptions, "drill: there are no parts");
  for (const SolidPart& part : parts) FORESIGHT_CHECK(part.Check());
  return {};
}

double DrillModel::Distance(const Eigen::Vector3d& point) const {
  double distance = std::numeric_limits<double>::infinity();
  for (const SolidPart& part : parts) distance = std::min(distance, part.Distance(point));
  return distance;
}

Eigen::Quaterniond BodyTurn(const Eigen::Vector2d& body_tilt_rad) {
  const double angle = body_tilt_rad.norm();
  if (!(angle > 0.0)) return Eigen::Quaterniond::Identity();
  const Eigen::Vector3d axis(body_tilt_rad.x() / angle, body_tilt_rad.y() / angle, 0.0);
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

Eigen::Vector2d LeanOf(const Eigen::Quaterniond& turn) {
  const Eigen::Vector3d axis = turn * Eigen::Vector3d::UnitZ();
  const double sine = axis.head<2>().norm();
  if (!(sine > 0.0)) return Eigen::Vector2d::Zero();
  return std::atan2(sine, axis.z()) / sine * Eigen::Vector2d(-axis.y(), axis.x());
}

Wireframe WireframeOf(const DrillModel& model) {
  Wireframe lines;
  for (const SolidPart& part : model.parts)
    for (auto& line : WireframeOf(part)) lines.push_back(std::move(line));
  return lines;
}

}  // namespace foresight
