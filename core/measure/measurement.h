#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/measure/measured_plane.h"
#include "core/measure/measured_point.h"

namespace foresight {

enum class MeasureKind {
  kPoint,          ///< where a point is
  kDistance,       ///< of two points
  kAngle,          ///< at the second of three points
  kPlaneDistance,  ///< of a point from a plane
  kHeight,         ///< of a point above the ground, along the robot's z
};
inline constexpr std::array kMeasureKinds = {MeasureKind::kPoint, MeasureKind::kDistance,
                                             MeasureKind::kAngle, MeasureKind::kPlaneDistance,
                                             MeasureKind::kHeight};
/// "point", "distance", "angle", "plane_distance", "height".
const char* ToString(MeasureKind kind);
/// The reverse; fails with kBadData.
Result<MeasureKind> MeasureKindFromString(const std::string& name);
/// How many points it takes, the plane left aside.
int PointsOf(MeasureKind kind);
bool NeedsPlane(MeasureKind kind);

/// Where the points of a measurement are.
enum class MeasureFrame {
  kRobot,  ///< of the scan that they were measured in
  kMap     ///< of several scans (frame::Map); each point names its own
};

/// "robot", "map": the names of the frames.
const char* ToString(MeasureFrame frame);

/// What was measured, and with what.
struct Measurement {
  MeasureKind kind = MeasureKind::kPoint;
  MeasureFrame frame = MeasureFrame::kRobot;
  std::vector<MeasuredPoint> points;   ///< PointsOf(kind) of them
  std::optional<MeasuredPlane> plane;  ///< the plane, or the ground
  /// Metres, or radians of an angle; of a point its distance from the frame's origin. A distance
  /// from a plane is positive on the side it was seen from.
  double value = 0.0;
  /// Of the value, from the sigmas of the ranges and of the scans' places; NaN = not known.
  double sigma = std::nan("");
};

/// Computes the value and its standard deviation. Fails with kInvalidInput where points or plane
/// are missing, and where two points of a distance or an angle are the same.
Result<Measurement> Measure(MeasureKind kind, std::vector<MeasuredPoint> points,
                            std::optional<MeasuredPlane> plane,
                            MeasureFrame frame = MeasureFrame::kRobot);

/// "1.234 m ± 12 mm", "34.5° ± 0.4°", "(1.200, 0.310, -0.455) m"; "1.234 m" where no sigma is
/// known.
std::string ValueText(const Measurement& measurement);

/// What to draw: lines in its frame from point to point, or to the foot on the plane.
std::vector<std::vector<Eigen::Vector3d>> MeasurementLines(const Measurement& measurement);
/// Where its label stands, in its frame.
Eigen::Vector3d LabelPlace(const Measurement& measurement);

}  // namespace foresight
