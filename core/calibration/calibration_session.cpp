#include "core/calibration/calibration_session.h"

#include <algorithm>
#include <cmath>

#include "core/base/contract.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

Status CheckView(const CalibrationBoard& board, const BoardView& view, const std::string& where) {
  if (const Status status = view.Check(board); !status)
    return Fail(ErrorCode::kInvalidInput, "{}: {}", where, status.error().message);
  return {};
}

Status CheckLines(const std::vector<LidarLine>& lines, const LidarModel& lidar,
                  const std::string& where) {
  for (const LidarLine& line : lines)
    if (line.range_mm.size() != static_cast<std::size_t>(lidar.beams))
      return Fail(ErrorCode::kInvalidInput, "{}: line {} has {} beams, the lidar has {}", where,
                  line.seq, line.range_mm.size(), lidar.beams);
  return {};
}

Status CheckStop(const CalibrationSession& session, const MotorStop& stop,
                 const std::string& where) {
  if (!std::isfinite(stop.motor_rad) || std::abs(stop.motor_rad) > 2.0 * M_PI)
    return Fail(ErrorCode::kInvalidInput, "{}: {} rad is no angle of the motor", where,
                stop.motor_rad);
  const std::string at =
      fmt::format("{}, stop {:.2f} deg", where, DegreesFromRadians(stop.motor_rad));
  if (stop.view.a) FORESIGHT_CHECK(CheckView(session.mount.a, *stop.view.a, at + ", board A"));
  if (stop.view.b) {
    if (!session.mount.b) return Fail(ErrorCode::kInvalidInput, "{}: the stand has no board B", at);
    FORESIGHT_CHECK(CheckView(*session.mount.b, *stop.view.b, at + ", board B"));
  }
  return CheckLines(stop.lines, session.prior.lidar, at);
}

}  // namespace

Status CalibrationSession::Check() const {
  FORESIGHT_CHECK(mount.Check());
  FORESIGHT_CHECK(prior.Check());
  if (!intrinsic_views.empty()) FORESIGHT_CHECK(intrinsic_board.Check());
  for (const IntrinsicView& view : intrinsic_views)
    FORESIGHT_CHECK(CheckView(intrinsic_board, view.view, view.source));
  for (const PatternPose& pose : poses) {
    for (std::size_t i = 0; i < pose.stops.size(); ++i) {
      FORESIGHT_CHECK(CheckStop(*this, pose.stops[i], pose.name));
      for (std::size_t j = 0; j < i; ++j)
        if (std::abs(pose.stops[i].motor_rad - pose.stops[j].motor_rad) < kSameStop_rad)
          return Fail(ErrorCode::kInvalidInput, "{}: the stop {:.2f} deg is there twice", pose.name,
                      DegreesFromRadians(pose.stops[i].motor_rad));
    }
    FORESIGHT_CHECK(CheckLines(pose.sweep.lines, prior.lidar, pose.name + ", sweep"));
  }
  return {};
}

std::vector<double> StopAngles(const CalibrationSession& session) {
  std::vector<double> angles;
  for (const PatternPose& pose : session.poses)
    for (const MotorStop& stop : pose.stops)
      if (!stop.view.empty() || !stop.lines.empty()) angles.push_back(stop.motor_rad);
  std::sort(angles.begin(), angles.end());
  const auto same = [](double a, double b) { return std::abs(a - b) < kSameStop_rad; };
  angles.erase(std::unique(angles.begin(), angles.end(), same), angles.end());
  return angles;
}

int StopIndex(const std::vector<double>& angles, double motor_rad) {
  for (std::size_t i = 0; i < angles.size(); ++i)
    if (std::abs(angles[i] - motor_rad) < kSameStop_rad) return static_cast<int>(i);
  FORESIGHT_EXPECTS(false, "the angle is one of the stops");
  return -1;
}

}  // namespace foresight
