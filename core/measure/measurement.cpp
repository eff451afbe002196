#include "core/measure/measurement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/geometry/angles.h"
#include "core/geometry/frames.h"

namespace foresight {
namespace {

constexpr double kSamePoint_m = 1e-6;

/// The foot of a measurement on its plane: along the normal, or straight down to the ground.
Eigen::Vector3d FootOf(MeasureKind kind, const MeasuredPlane& plane, const Eigen::Vector3d& point) {
  if (kind == MeasureKind::kHeight) {
    const double z = plane.plane.normal.z();
    return point - Eigen::Vector3d(0.0, 0.0, plane.plane.Distance(point) / z);
  }
  return point - plane.plane.Distance(point) * plane.plane.normal;
}

double ValueOf(MeasureKind kind, const std::vector<Eigen::Vector3d>& at,
               const std::optional<MeasuredPlane>& plane) {
  switch (kind) {
    case MeasureKind::kPoint:
      return at[0].norm();
    case MeasureKind::kDistance:
      return (at[1] - at[0]).norm();
    case MeasureKind::kAngle: {
      const Eigen::Vector3d a = at[0] - at[1], b = at[2] - at[1];
      return std::atan2(a.cross(b).norm(), a.dot(b));
    }
    case MeasureKind::kPlaneDistance:
      return plane->plane.Distance(at[0]);
    case MeasureKind::kHeight:
      break;
  }
  return plane->plane.Distance(at[0]) / plane->plane.normal.z();
}

/// How much the value changes a metre where the points of `moves` are moved along `way`.
template <class Moves>
double SlopeOf(MeasureKind kind, const std::vector<MeasuredPoint>& points,
               const std::vector<Eigen::Vector3d>& at, const std::optional<MeasuredPlane>& plane,
               const Eigen::Vector3d& way, const Moves& moves) {
  constexpr double kStep_m = 1e-4;
  std::vector<Eigen::Vector3d> ahead = at, behind = at;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!moves(points[i])) continue;
    ahead[i] += kStep_m * way;
    behind[i] -= kStep_m * way;
  }
  return (ValueOf(kind, ahead, plane) - ValueOf(kind, behind, plane)) / (2.0 * kStep_m);
}

/// Of the places of scans in a map: all points of a scan move together. The ground of a height is
/// that of the point's own scan, and moves with it.
double PlacementVariance(MeasureKind kind, const std::vector<MeasuredPoint>& points,
                         const std::vector<Eigen::Vector3d>& at,
                         const std::optional<MeasuredPlane>& plane) {
  if (kind == MeasureKind::kHeight) return 0.0;
  double variance = 0.0;
  std::set<std::string> scans;
  for (const MeasuredPoint& point : points) {
    if (!scans.insert(point.scan_uuid).second) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const double slope =
          SlopeOf(kind, points, at, plane, Eigen::Vector3d::Unit(axis),
                  [&](const MeasuredPoint& other) { return other.scan_uuid == point.scan_uuid; });
      variance += std::pow(slope * point.placement_sigma_m, 2);
    }
  }
  return variance;
}

/// Each point moves along its ray; what the plane is uncertain by adds to that, and what the scans'
/// places are.
double SigmaOf(MeasureKind kind, const std::vector<MeasuredPoint>& points,
               const std::vector<Eigen::Vector3d>& at, const std::optional<MeasuredPlane>& plane) {
  double variance = PlacementVariance(kind, points, at, plane);
  for (const MeasuredPoint& point : points) {
    if (!std::isfinite(point.sigma_m)) return std::nan("");
    const double slope = SlopeOf(kind, points, at, plane, point.ray,
                                 [&](const MeasuredPoint& other) { return &other == &point; });
    variance += std::pow(slope * point.sigma_m, 2);
  }
  if (plane && plane->inliers > 0) variance += plane->rms_m * plane->rms_m / plane->inliers;
  return std::sqrt(variance);
}

}  // namespace

std::string OriginText(const MeasuredPoint& point) {
  if (point.source == MeasuredPoint::Source::kLidar)
    return fmt::format("line {}, beam {}", point.line, point.beam);
  return fmt::format("depth map of image {}, pixel ({:.0f}, {:.0f})", point.image, point.pixel.x(),
                     point.pixel.y());
}

const char* ToString(MeasureKind kind) {
  switch (kind) {
    case MeasureKind::kPoint:
      return "point";
    case MeasureKind::kDistance:
      return "distance";
    case MeasureKind::kAngle:
      return "angle";
    case MeasureKind::kPlaneDistance:
      return "plane_distance";
    case MeasureKind::kHeight:
      break;
  }
  return "height";
}

const char* ToString(MeasureFrame frame) {
  return frame == MeasureFrame::kMap ? "map" : frame::Robot::kName;
}

Result<MeasureKind> MeasureKindFromString(const std::string& name) {
  for (const MeasureKind kind : kMeasureKinds)
    if (name == ToString(kind)) return kind;
  return Fail(ErrorCode::kBadData, "'{}' is no kind of measurement", name);
}

int PointsOf(MeasureKind kind) {
  if (kind == MeasureKind::kDistance) return 2;
  return kind == MeasureKind::kAngle ? 3 : 1;
}

bool NeedsPlane(MeasureKind kind) {
  return kind == MeasureKind::kPlaneDistance || kind == MeasureKind::kHeight;
}

Result<Measurement> Measure(MeasureKind kind, std::vector<MeasuredPoint> points,
                            std::optional<MeasuredPlane> plane, MeasureFrame frame) {
  if (static_cast<int>(points.size()) != PointsOf(kind))
    return Fail(ErrorCode::kInvalidInput, "{} takes {} points, not {}", ToString(kind),
                PointsOf(kind), points.size());
  if (NeedsPlane(kind) != plane.has_value())
    return Fail(ErrorCode::kInvalidInput, "{} takes {} plane", ToString(kind), plane ? "no" : "a");
  if (kind == MeasureKind::kHeight && !(plane->plane.normal.z() > 0.1))
    return Fail(ErrorCode::kInvalidInput, "the ground is not level");
  std::vector<Eigen::Vector3d> at;
  for (const MeasuredPoint& point : points) {
    if (!point.position_m.allFinite())
      return Fail(ErrorCode::kInvalidInput, "a point was not measured");
    if (!at.empty() && (point.position_m - at.back()).norm() < kSamePoint_m)
      return Fail(ErrorCode::kInvalidInput, "the same point was taken twice");
    at.push_back(point.position_m);
  }
  Measurement measurement;
  measurement.kind = kind;
  measurement.frame = frame;
  measurement.value = ValueOf(kind, at, plane);
  measurement.sigma = SigmaOf(kind, points, at, plane);
  measurement.points = std::move(points);
  measurement.plane = std::move(plane);
  return measurement;
}

std::string ValueText(const Measurement& measurement) {
  const bool known = std::isfinite(measurement.sigma);
  if (measurement.kind == MeasureKind::kPoint) {
    const Eigen::Vector3d& p = measurement.points.front().position_m;
    const std::string at = fmt::format("({:.3f}, {:.3f}, {:.3f}) m", p.x(), p.y(), p.z());
    const double sigma_m = measurement.points.front().sigma_m;
    return std::isfinite(sigma_m) ? at + fmt::format(" ± {:.0f} mm of range", 1e3 * sigma_m) : at;
  }
  if (measurement.kind == MeasureKind::kAngle) {
    const std::string angle = fmt::format("{:.1f}°", DegreesFromRadians(measurement.value));
    return known ? angle + fmt::format(" ± {:.1f}°", DegreesFromRadians(measurement.sigma)) : angle;
  }
  const std::string length = fmt::format("{:.3f} m", measurement.value);
  return known ? length + fmt::format(" ± {:.0f} mm", 1e3 * measurement.sigma) : length;
}

std::vector<std::vector<Eigen::Vector3d>> MeasurementLines(const Measurement& measurement) {
  std::vector<Eigen::Vector3d> line;
  for (const MeasuredPoint& point : measurement.points) line.push_back(point.position_m);
  if (!measurement.plane) return {line};
  const Eigen::Vector3d foot = FootOf(measurement.kind, *measurement.plane, line.front());
  line.push_back(foot);
  // A square in the plane, so that it is seen which one is meant.
  const Eigen::Vector3d normal = measurement.plane->plane.normal;
  const Eigen::Vector3d x = normal.unitOrthogonal(), y = normal.cross(x);
  constexpr double kHalf_m = 0.15;
  const Eigen::Vector3d c =
      measurement.kind == MeasureKind::kHeight ? foot : measurement.plane->centre;
  std::vector<Eigen::Vector3d> square;
  static constexpr int kCorners[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  for (const auto& corner : kCorners)
    square.push_back(c + kHalf_m * (corner[0] * x + corner[1] * y));
  return {line, square};
}

Eigen::Vector3d LabelPlace(const Measurement& measurement) {
  if (measurement.kind == MeasureKind::kAngle) return measurement.points[1].position_m;
  const std::vector<Eigen::Vector3d> line = MeasurementLines(measurement).front();
  return 0.5 * (line.front() + line.back());
}

}  // namespace foresight
