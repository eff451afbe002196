#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "core/fitting/fit_origin.h"
#include "core/fitting/verdict.h"
#include "core/geometry/rigid.h"

namespace foresight {

/// What the detections' JSON is made of. Readers throw std::exception that names the fault;
/// DetectionFromJson turns it into an error. NaN is written as null.
using Json = nlohmann::json;

Json ToJson(const Eigen::Vector2d& v);
Json ToJson(const Eigen::Vector3d& v);
double NumberFrom(const Json& value);
/// Null where there is none; a member that is null or missing is none.
Json NumberOrNull(const std::optional<double>& number);
std::optional<double> NumberOrNone(const Json& object, const char* key);
/// A length of a part of an object: 0 to kLargestObject_m.
double SizeIn(const Json& object, const char* key);
/// How many of something there were: 0 to 2^31 - 1.
int CountIn(const Json& object, const char* key);
/// A point or a size in the object's frame, within kLargestObject_m.
Eigen::Vector3d PointOnObjectIn(const Json& object, const char* key);
inline constexpr double kLargestObject_m = 10.0;
inline constexpr std::size_t kMostAlternatives = 1000;
Eigen::Vector2d Vector2From(const Json& value);
Eigen::Vector3d Vector3From(const Json& value);

/// A frame as `position_m`, `quaternion_wxyz`, and its axes as directions in the outer frame:
/// `x_axis`, `y_axis`, `z_axis`.
Json ToJson(const Rigid<frame::Robot, frame::Object>& pose);
Json ToJson(const Rigid<frame::Base, frame::Object>& pose);
Json ToJson(const Rigid<frame::Object, frame::Object>& pose);
/// Position, within kFarthest_m, and rotation; the axes follow from them.
inline constexpr double kFarthest_m = 100'000.0;
Rigid<frame::Base, frame::Object> PoseFrom(const Json& value);
Rigid<frame::Object, frame::Object> PartPoseFrom(const Json& value);

/// Six rows of six numbers. A record without the member has an unknown one.
Json ToJson(const PoseCovariance& covariance);
PoseCovariance CovarianceFrom(const Json& object);

/// `verdict`, `probability`, `reason`, `features`: members of what the verdict is about.
void AddVerdict(const Verdict& verdict, Json& object);
Verdict VerdictFrom(const Json& object);

/// The member `name`, or `old_name` as earlier programs called it.
const Json& Renamed(const Json& object, const char* name, const char* old_name);
/// The array `alternatives`, or `rivals` as earlier programs called it.
const Json& AlternativesIn(const Json& object);

/// A region: corners in pixels at a motor angle, or a box in base.
Json ToJson(const Roi& roi);
Roi RoiFrom(const Json& value);

/// `roi`, `source`, `seconds`.
void AddOrigin(const FitOrigin& origin, Json& object);
FitOrigin OriginFrom(const Json& object);

}  // namespace foresight
