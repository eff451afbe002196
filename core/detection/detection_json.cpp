#include "core/detection/detection_json.h"

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace foresight {
namespace {

using nlohmann::json;

json ToJson(const Eigen::Vector3d& v) {
  return json::array({v.x(), v.y(), v.z()});
}

template <class To>
json ToJson(const Rigid<To, frame::Object>& pose) {
  const Eigen::Quaterniond& q = pose.rotation();
  return {{"position_m", ToJson(pose.translation())},
          {"quaternion_wxyz", json::array({q.w(), q.x(), q.y(), q.z()})},
          {"axis", ToJson(pose.Rotate(Eigen::Vector3d::UnitZ()))}};
}

json ToJson(const ValveModel& model) {
  return {{"rim_radius_m", model.rim_radius_m},
          {"tube_radius_m", model.tube_radius_m},
          {"spokes", model.spokes},
          {"spoke_radius_m", model.spoke_radius_m},
          {"hub_radius_m", model.hub_radius_m},
          {"dish_m", model.dish_m}};
}

json ToJson(const ValveCandidate& valve) {
  return {{"base_from_object", ToJson(valve.base_from_object)},
          {"model", ToJson(valve.model)},
          {"log_likelihood", valve.log_likelihood}};
}

json ToJson(const ValveEvidence& evidence) {
  return {{"rays", evidence.rays},
          {"hits", evidence.hits},
          {"inlier_share", evidence.inlier_share},
          {"see_through", evidence.see_through},
          {"blocked_gaps", evidence.blocked_gaps},
          {"rms_m", evidence.rms_m},
          {"arc_coverage", evidence.arc_coverage},
          {"margin_nats", evidence.margin_nats},
          {"gain_nats", evidence.gain_nats}};
}

json ToJson(const Roi& roi) {
  if (const auto* box = std::get_if<BoxRoi>(&roi))
    return {{"base_from_box", ToJson(box->base_from_box)}, {"size_m", ToJson(box->size_m)}};
  const auto& image = std::get<ImageRoi>(roi);
  json polygon = json::array();
  for (const Eigen::Vector2d& corner : image.polygon)
    polygon.push_back(json::array({corner.x(), corner.y()}));
  return {{"motor_rad", image.motor_rad}, {"polygon_px", polygon}};
}

/// JSON has no NaN: it is written as null.
double Number(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Eigen::Vector3d VectorFrom(const json& value) {
  return {Number(value.at(0)), Number(value.at(1)), Number(value.at(2))};
}

ValveModel ModelFrom(const json& value) {
  return {value.at("rim_radius_m"),   value.at("tube_radius_m"), value.at("spokes"),
          value.at("spoke_radius_m"), value.at("hub_radius_m"),  value.at("dish_m")};
}

Rigid<frame::Base, frame::Object> PoseFrom(const json& pose) {
  const json& q = pose.at("quaternion_wxyz");
  const Eigen::Quaterniond rotation(q.at(0), q.at(1), q.at(2), q.at(3));
  if (!(std::abs(rotation.norm() - 1.0) < 1e-6))
    throw std::invalid_argument("quaternion_wxyz has not length 1");
  return {rotation, VectorFrom(pose.at("position_m"))};
}

ValveCandidate CandidateFrom(const json& value) {
  return {PoseFrom(value.at("base_from_object")), ModelFrom(value.at("model")),
          Number(value.at("log_likelihood"))};
}

ValveEvidence EvidenceFrom(const json& value) {
  ValveEvidence evidence;
  evidence.rays = value.at("rays");
  evidence.hits = value.at("hits");
  evidence.inlier_share = Number(value.at("inlier_share"));
  evidence.see_through = Number(value.at("see_through"));
  evidence.blocked_gaps = Number(value.at("blocked_gaps"));
  evidence.rms_m = Number(value.at("rms_m"));
  evidence.arc_coverage = Number(value.at("arc_coverage"));
  evidence.margin_nats = Number(value.at("margin_nats"));
  evidence.gain_nats = Number(value.at("gain_nats"));
  return evidence;
}

VerdictLevel LevelFrom(const std::string& name) {
  for (const VerdictLevel level :
       {VerdictLevel::kUnsure, VerdictLevel::kLikely, VerdictLevel::kConfirmed})
    if (name == ToString(level)) return level;
  throw std::invalid_argument("verdict '" + name + "' is not known");
}

Roi RoiFrom(const json& value) {
  if (value.contains("base_from_box"))
    return BoxRoi{PoseFrom(value.at("base_from_box")), VectorFrom(value.at("size_m"))};
  ImageRoi roi;
  roi.motor_rad = Number(value.at("motor_rad"));
  for (const json& corner : value.at("polygon_px"))
    roi.polygon.emplace_back(Number(corner.at(0)), Number(corner.at(1)));
  return roi;
}

ValveDetection DetectionFrom(const json& value) {
  if (value.at("kind") != "valve") throw std::invalid_argument("kind is not 'valve'");
  ValveDetection detection;
  detection.best = CandidateFrom(value.at("best"));
  detection.phase_observable = value.at("phase_observable");
  detection.sigma_position_m = VectorFrom(value.at("sigma_position_m"));
  detection.sigma_axis_rad = Number(value.at("sigma_axis_rad"));
  detection.sigma_phase_rad = Number(value.at("sigma_phase_rad"));
  detection.evidence = EvidenceFrom(value.at("evidence"));
  detection.verdict = {
      LevelFrom(value.at("verdict")), Number(value.at("probability")), value.at("reason"), {}};
  for (const json& rival : value.at("rivals")) detection.rivals.push_back(CandidateFrom(rival));
  detection.origin.roi = RoiFrom(value.at("roi"));
  detection.origin.seconds = Number(value.at("seconds"));
  return detection;
}

}  // namespace

std::string DetectionToJson(const ValveDetection& detection,
                            const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  json best = ToJson(detection.best);
  best["robot_from_object"] = ToJson(robot_from_base * detection.best.base_from_object);
  json rivals = json::array();
  for (const ValveCandidate& rival : detection.rivals) rivals.push_back(ToJson(rival));
  const json value = {{"kind", "valve"},
                      {"verdict", ToString(detection.verdict.level)},
                      {"probability", detection.verdict.probability},
                      {"reason", detection.verdict.reason},
                      {"best", best},
                      {"phase_observable", detection.phase_observable},
                      {"sigma_position_m", ToJson(detection.sigma_position_m)},
                      {"sigma_axis_rad", detection.sigma_axis_rad},
                      {"sigma_phase_rad", detection.sigma_phase_rad},
                      {"evidence", ToJson(detection.evidence)},
                      {"rivals", rivals},
                      {"roi", ToJson(detection.origin.roi)},
                      {"seconds", detection.origin.seconds}};
  return value.dump(2);
}

Result<ValveDetection> ValveDetectionFromJson(std::string_view text) {
  try {
    return DetectionFrom(json::parse(text));
  } catch (const std::exception& failure) {
    return Fail(ErrorCode::kBadData, "valve detection: {}", failure.what());
  }
}

}  // namespace foresight
