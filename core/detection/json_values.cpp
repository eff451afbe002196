#include "core/detection/json_values.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/io/json_reader.h"

namespace foresight {
namespace {

constexpr std::size_t kMostCorners = 10'000;
constexpr double kFarthest_px = 1e6;

Json FrameJson(const Eigen::Quaterniond& q, const Eigen::Vector3d& position) {
  return {{"position_m", ToJson(position)},
          {"quaternion_wxyz", Json::array({q.w(), q.x(), q.y(), q.z()})},
          {"x_axis", ToJson(Eigen::Vector3d(q * Eigen::Vector3d::UnitX()))},
          {"y_axis", ToJson(Eigen::Vector3d(q * Eigen::Vector3d::UnitY()))},
          {"z_axis", ToJson(Eigen::Vector3d(q * Eigen::Vector3d::UnitZ()))}};
}

template <class To>
Rigid<To, frame::Object> FrameFrom(const Json& value) {
  const Json& q = value.at("quaternion_wxyz");
  const Eigen::Quaterniond rotation(q.at(0), q.at(1), q.at(2), q.at(3));
  if (!(std::abs(rotation.norm() - 1.0) < 1e-6))
    throw std::invalid_argument("quaternion_wxyz has not length 1");
  const Eigen::Vector3d position = Vector3From(value.at("position_m"));
  if (!(position.array().abs() <= kFarthest_m).all())
    throw std::invalid_argument(fmt::format("position_m ({}, {}, {}) is not within {} m",
                                            position.x(), position.y(), position.z(), kFarthest_m));
  // What a program wrote has length 1 to the last digits and stays as it is, bit for bit; what
  // somebody typed is brought to length 1.
  constexpr double kRounding = 1e-15;
  if (std::abs(rotation.squaredNorm() - 1.0) <= kRounding)
    return Rigid<To, frame::Object>::FromUnit(rotation, position);
  return {rotation, position};
}

VerdictLevel LevelFrom(const std::string& name) {
  const Result<VerdictLevel> level = VerdictLevelFromString(name);
  if (!level) throw std::invalid_argument(level.error().message);
  return *level;
}

}  // namespace

Json ToJson(const Eigen::Vector2d& v) {
  return Json::array({v.x(), v.y()});
}

Json ToJson(const Eigen::Vector3d& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

double NumberFrom(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Json NumberOrNull(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

std::optional<double> NumberOrNone(const Json& object, const char* key) {
  if (!object.contains(key) || object.at(key).is_null()) return std::nullopt;
  return NumberFrom(object.at(key));
}

double SizeIn(const Json& object, const char* key) {
  return NumberIn(object, key, 0.0, kLargestObject_m);
}

int CountIn(const Json& object, const char* key) {
  return IntegerIn(object, key, 0, std::numeric_limits<int>::max());
}

Eigen::Vector3d PointOnObjectIn(const Json& object, const char* key) {
  const Eigen::Vector3d point = Vector3From(object.at(key));
  if (!(point.array().abs() <= kLargestObject_m).all())
    throw std::invalid_argument(fmt::format("'{}' is ({}, {}, {}), not within {} m", key, point.x(),
                                            point.y(), point.z(), kLargestObject_m));
  return point;
}

Eigen::Vector2d Vector2From(const Json& value) {
  return {NumberFrom(value.at(0)), NumberFrom(value.at(1))};
}

Eigen::Vector3d Vector3From(const Json& value) {
  return {NumberFrom(value.at(0)), NumberFrom(value.at(1)), NumberFrom(value.at(2))};
}

Json ToJson(const Rigid<frame::Robot, frame::Object>& pose) {
  return FrameJson(pose.rotation(), pose.translation());
}

Json ToJson(const Rigid<frame::Base, frame::Object>& pose) {
  return FrameJson(pose.rotation(), pose.translation());
}

Json ToJson(const Rigid<frame::Object, frame::Object>& pose) {
  return FrameJson(pose.rotation(), pose.translation());
}

Rigid<frame::Base, frame::Object> PoseFrom(const Json& value) {
  return FrameFrom<frame::Base>(value);
}

Rigid<frame::Object, frame::Object> PartPoseFrom(const Json& value) {
  return FrameFrom<frame::Object>(value);
}

Json ToJson(const PoseCovariance& covariance) {
  Json rows = Json::array();
  for (Eigen::Index row = 0; row < 6; ++row) {
    Json values = Json::array();
    for (Eigen::Index column = 0; column < 6; ++column) values.push_back(covariance(row, column));
    rows.push_back(values);
  }
  return rows;
}

PoseCovariance CovarianceFrom(const Json& object) {
  PoseCovariance covariance = PoseCovariance::Constant(std::numeric_limits<double>::quiet_NaN());
  if (!object.contains("covariance")) return covariance;
  const Json& rows = object.at("covariance");
  for (std::size_t row = 0; row < 6; ++row)
    for (std::size_t column = 0; column < 6; ++column)
      covariance(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          NumberFrom(rows.at(row).at(column));
  return covariance;
}

void AddVerdict(const Verdict& verdict, Json& object) {
  object["verdict"] = ToString(verdict.level);
  object["probability"] = verdict.probability;
  object["reason"] = verdict.reason;
  object["features"] = verdict.features;
  object["gates"] = verdict.failed_gates;
}

Verdict VerdictFrom(const Json& object) {
  Verdict verdict{LevelFrom(object.at("verdict")),
                  NumberFrom(object.at("probability")),
                  object.at("reason"),
                  {},
                  {}};
  if (object.contains("features"))
    for (const Json& feature : object.at("features"))
      verdict.features.push_back(NumberFrom(feature));
  if (object.contains("gates")) object.at("gates").get_to(verdict.failed_gates);
  return verdict;
}

const Json& Renamed(const Json& object, const char* name, const char* old_name) {
  return object.at(object.contains(old_name) ? old_name : name);
}

const Json& AlternativesIn(const Json& object) {
  const char* key = object.contains("rivals") ? "rivals" : "alternatives";
  return ListIn(object, key, kMostAlternatives);
}

Json ToJson(const Roi& roi) {
  if (const auto* box = std::get_if<BoxRoi>(&roi))
    return {{"base_from_box", ToJson(box->base_from_box)}, {"size_m", ToJson(box->size_m)}};
  const auto& image = std::get<ImageRoi>(roi);
  Json polygon = Json::array();
  for (const Eigen::Vector2d& corner : image.polygon) polygon.push_back(ToJson(corner));
  return {{"motor_rad", image.motor_rad}, {"polygon_px", polygon}};
}

Roi RoiFrom(const Json& value) {
  if (value.contains("base_from_box"))
    return BoxRoi{PoseFrom(value.at("base_from_box")), Vector3From(value.at("size_m"))};
  ImageRoi roi;
  roi.motor_rad = NumberFrom(value.at("motor_rad"));
  for (const Json& corner : ListIn(value, "polygon_px", kMostCorners)) {
    roi.polygon.push_back(Vector2From(corner));
    if (!(roi.polygon.back().array().abs() <= kFarthest_px).all())
      throw std::invalid_argument(fmt::format("a corner of polygon_px is at ({}, {})",
                                              roi.polygon.back().x(), roi.polygon.back().y()));
  }
  return roi;
}

void AddOrigin(const FitOrigin& origin, Json& object) {
  object["roi"] = ToJson(origin.roi);
  object["source"] = origin.source;
  object["image"] = origin.image;
  object["seconds"] = origin.seconds;
}

FitOrigin OriginFrom(const Json& object) {
  FitOrigin origin;
  origin.roi = RoiFrom(object.at("roi"));
  // Older records have neither.
  origin.source = object.value("source", origin.source);
  origin.image = object.value("image", origin.image);
  origin.seconds = NumberFrom(object.at("seconds"));
  return origin;
}

}  // namespace foresight
