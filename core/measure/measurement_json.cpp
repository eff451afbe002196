#include "core/measure/measurement_json.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/detection/json_values.h"
#include "core/io/json_numbers.h"

namespace foresight {
namespace {

constexpr std::size_t kMostBytes = 1 << 20;

Json PointJson(const MeasuredPoint& point) {
  Json json = {{"position_m", ToJson(point.position_m)},
               {"scan_uuid", point.scan_uuid},
               {"range_m", FiniteOrNull(point.range_m)},
               {"sigma_m", FiniteOrNull(point.sigma_m)},
               {"ray", ToJson(point.ray)}};
  if (point.placement_sigma_m > 0.0) json["placement_sigma_m"] = point.placement_sigma_m;
  if (point.source == MeasuredPoint::Source::kLidar) {
    json["source"] = "lidar";
    json["line"] = point.line;
    json["beam"] = point.beam;
  } else {
    json["source"] = "depth";
    json["image"] = point.image;
    json["pixel"] = ToJson(point.pixel);
  }
  return json;
}

Eigen::Vector3d PlaceFrom(const Json& value, const char* what) {
  const Eigen::Vector3d place = Vector3From(value);
  if (!(place.array().abs() <= kFarthest_m).all())
    throw std::invalid_argument(fmt::format("{} is not within {} m", what, kFarthest_m));
  return place;
}

MeasuredPoint PointFrom(const Json& json) {
  MeasuredPoint point;
  point.position_m = PlaceFrom(json.at("position_m"), "position_m");
  point.scan_uuid = json.at("scan_uuid").get<std::string>();
  point.range_m = NumberFrom(json.at("range_m"));
  point.sigma_m = NumberFrom(json.at("sigma_m"));
  point.ray = PlaceFrom(json.at("ray"), "ray");
  if (json.contains("placement_sigma_m")) {
    point.placement_sigma_m = NumberFrom(json.at("placement_sigma_m"));
    if (!(point.placement_sigma_m >= 0.0 && point.placement_sigma_m <= kFarthest_m))
      throw std::invalid_argument("placement_sigma_m is no standard deviation");
  }
  const auto source = json.at("source").get<std::string>();
  if (source == "lidar") {
    point.line = CountIn(json, "line");
    point.beam = CountIn(json, "beam");
  } else if (source == "depth") {
    point.source = MeasuredPoint::Source::kDepth;
    point.image = CountIn(json, "image");
    point.pixel = Vector2From(json.at("pixel"));
  } else {
    throw std::invalid_argument(fmt::format("source '{}' is neither lidar nor depth", source));
  }
  return point;
}

Json PlaneJson(const MeasuredPlane& plane) {
  return {{"normal", ToJson(plane.plane.normal)},
          {"offset_m", plane.plane.offset},
          {"centre_m", ToJson(plane.centre)},
          {"rms_m", plane.rms_m},
          {"inliers", plane.inliers},
          {"points", plane.points},
          {"made_from", plane.made_from}};
}

/// Measurements of earlier programs name no frame.
MeasureFrame FrameFrom(const Json& json) {
  const auto name = json.value("frame", std::string(ToString(MeasureFrame::kRobot)));
  for (const MeasureFrame frame : {MeasureFrame::kRobot, MeasureFrame::kMap})
    if (name == ToString(frame)) return frame;
  throw std::invalid_argument(fmt::format("frame '{}' is neither robot nor map", name));
}

MeasuredPlane PlaneFrom(const Json& json) {
  MeasuredPlane plane;
  plane.plane.normal = PlaceFrom(json.at("normal"), "normal");
  if (!(std::abs(plane.plane.normal.norm() - 1.0) < 1e-6))
    throw std::invalid_argument("normal has not length 1");
  plane.plane.offset = NumberFrom(json.at("offset_m"));
  if (!(std::abs(plane.plane.offset) <= kFarthest_m))
    throw std::invalid_argument("offset_m is not a place");
  plane.centre = PlaceFrom(json.at("centre_m"), "centre_m");
  plane.rms_m = NumberFrom(json.at("rms_m"));
  plane.inliers = CountIn(json, "inliers");
  plane.points = CountIn(json, "points");
  plane.made_from = json.at("made_from").get<std::string>();
  return plane;
}

}  // namespace

std::string MeasurementToJson(const Measurement& measurement) {
  Json json = {{"measurement", ToString(measurement.kind)},
               {"value", measurement.value},
               {"sigma", FiniteOrNull(measurement.sigma)},
               {"unit", measurement.kind == MeasureKind::kAngle ? "rad" : "m"},
               {"label", ValueText(measurement)},
               {"frame", ToString(measurement.frame)},
               {"points", Json::array()}};
  for (const MeasuredPoint& point : measurement.points) json["points"].push_back(PointJson(point));
  if (measurement.plane) json["plane"] = PlaneJson(*measurement.plane);
  return json.dump();
}

Result<Measurement> MeasurementFromJson(const std::string& text) {
  if (text.size() > kMostBytes)
    return Fail(ErrorCode::kBadData, "measurement: {} bytes are no measurement", text.size());
  try {
    const Json json = Json::parse(text);
    FORESIGHT_TRY(const MeasureKind kind,
                  MeasureKindFromString(json.at("measurement").get<std::string>()));
    std::vector<MeasuredPoint> points;
    for (const Json& point : json.at("points")) points.push_back(PointFrom(point));
    std::optional<MeasuredPlane> plane;
    if (json.contains("plane")) plane = PlaneFrom(json.at("plane"));
    auto measured = Measure(kind, std::move(points), std::move(plane), FrameFrom(json));
    if (!measured) return Fail(ErrorCode::kBadData, "measurement: {}", measured.error().message);
    return measured;
  } catch (const std::exception& error) {
    return Fail(ErrorCode::kBadData, "measurement: {}", error.what());
  }
}

}  // namespace foresight
