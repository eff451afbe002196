#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "core/detection/json_values.h"
#include "core/detection/object_json.h"
#include "core/io/json_reader.h"

namespace foresight {
namespace {

constexpr std::size_t kMostParts = 1000;

const char* NameOf(SolidPart::Shape shape) {
  constexpr const char* kNames[] = {"box", "cylinder", "capsule"};
  return kNames[static_cast<std::size_t>(shape)];
}

SolidPart::Shape ShapeFrom(const std::string& name) {
  for (const auto shape :
       {SolidPart::Shape::kBox, SolidPart::Shape::kCylinder, SolidPart::Shape::kCapsule})
    if (name == NameOf(shape)) return shape;
  throw std::invalid_argument("shape '" + name + "' is not known");
}

Json CandidateJson(const DrillCandidate& drill,
                   const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  return {{"base_from_object", ToJson(drill.base_from_object)},
          {"robot_from_object", ToJson(robot_from_base * drill.base_from_object)},
          {"model", ToJson(drill.model)},
          {"log_likelihood", drill.log_likelihood}};
}

Json EvidenceJson(const DrillEvidence& evidence) {
  return {{"rays", evidence.rays},
          {"hits", evidence.hits},
          {"inlier_ratio", evidence.inlier_ratio},
          {"see_through", evidence.see_through},
          {"rms_m", evidence.rms_m},
          {"yaw_margin_nats", evidence.yaw_margin_nats},
          {"flip_margin_nats", evidence.flip_margin_nats},
          {"head_nats", evidence.head_nats},
          {"gain_nats", evidence.gain_nats},
          {"alternative_margin_nats", evidence.alternative_margin_nats},
          {"best_alternative", evidence.best_alternative},
          {"no_foot_margin_nats", NumberOrNull(evidence.no_foot_margin_nats)},
          {"nozzle_margin_nats", NumberOrNull(evidence.nozzle_margin_nats)},
          {"no_chuck_margin_nats", NumberOrNull(evidence.no_chuck_margin_nats)},
          {"unusual_nats", NumberOrNull(evidence.unusual_nats)}};
}

DrillCandidate DrillCandidateFrom(const Json& value) {
  return {PoseFrom(value.at("base_from_object")), DrillModelFrom(value.at("model")),
          NumberFrom(value.at("log_likelihood"))};
}

DrillEvidence DrillEvidenceFrom(const Json& value) {
  DrillEvidence evidence;
  evidence.rays = CountIn(value, "rays");
  evidence.hits = CountIn(value, "hits");
  evidence.inlier_ratio = NumberFrom(Renamed(value, "inlier_ratio", "inlier_share"));
  evidence.see_through = NumberFrom(value.at("see_through"));
  evidence.rms_m = NumberFrom(value.at("rms_m"));
  evidence.yaw_margin_nats = NumberFrom(value.at("yaw_margin_nats"));
  evidence.flip_margin_nats = NumberFrom(value.at("flip_margin_nats"));
  evidence.head_nats = NumberFrom(value.at("head_nats"));
  evidence.gain_nats = NumberFrom(value.at("gain_nats"));
  evidence.alternative_margin_nats =
      NumberFrom(Renamed(value, "alternative_margin_nats", "rival_margin_nats"));
  evidence.best_alternative = Renamed(value, "best_alternative", "best_rival");
  evidence.no_foot_margin_nats = NumberOrNone(value, "no_foot_margin_nats");
  evidence.nozzle_margin_nats = NumberOrNone(value, "nozzle_margin_nats");
  evidence.no_chuck_margin_nats = NumberOrNone(value, "no_chuck_margin_nats");
  evidence.unusual_nats = NumberOrNone(value, "unusual_nats");
  return evidence;
}

/// What a hand needs, in both frames.
Json GraspToJson(const DrillCandidate& drill,
                 const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  const auto base_from_grasp = drill.base_from_object * drill.model.object_from_grasp;
  const Eigen::Vector3d trigger = drill.base_from_object * drill.model.trigger_m;
  const Eigen::Vector3d tip = drill.base_from_object * drill.model.bit_tip_m;
  return {{"base_from_grasp", ToJson(base_from_grasp)},
          {"robot_from_grasp", ToJson(robot_from_base * base_from_grasp)},
          {"trigger_in_base_m", ToJson(trigger)},
          {"trigger_in_robot_m", ToJson(Eigen::Vector3d(robot_from_base * trigger))},
          {"bit_tip_in_base_m", ToJson(tip)},
          {"bit_tip_in_robot_m", ToJson(Eigen::Vector3d(robot_from_base * tip))}};
}

}  // namespace

Json ToJson(const DrillModel& model) {
  Json parts = Json::array();
  for (const SolidPart& part : model.parts)
    parts.push_back({{"name", part.name},
                     {"shape", NameOf(part.shape)},
                     {"object_from_part", ToJson(part.object_from_part)},
                     {"size_m", ToJson(part.size_m)}});
  return {{"template", model.template_name},
          {"scale", model.scale},
          {"body_tilt_rad", ToJson(model.body_tilt_rad)},
          {"bit_length_m", model.bit_length_m},
          {"object_from_grasp", ToJson(model.object_from_grasp)},
          {"trigger_m", ToJson(model.trigger_m)},
          {"bit_tip_m", ToJson(model.bit_tip_m)},
          {"parts", parts}};
}

DrillModel DrillModelFrom(const Json& value) {
  DrillModel model;
  model.template_name = value.at("template");
  model.scale = NumberIn(value, "scale", 0.01, 100.0);
  model.body_tilt_rad = Vector2From(value.at("body_tilt_rad"));
  model.bit_length_m = SizeIn(value, "bit_length_m");
  model.object_from_grasp = PartPoseFrom(value.at("object_from_grasp"));
  model.trigger_m = PointOnObjectIn(value, "trigger_m");
  model.bit_tip_m = PointOnObjectIn(value, "bit_tip_m");
  for (const Json& part : ListIn(value, "parts", kMostParts)) {
    model.parts.push_back({part.at("name"), ShapeFrom(part.at("shape")),
                           PartPoseFrom(part.at("object_from_part")),
                           PointOnObjectIn(part, "size_m")});
    if (const Status status = model.parts.back().Check(); !status)
      throw std::invalid_argument(status.error().message);
  }
  return model;
}

Json ToJson(const DrillDetection& detection,
            const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  Json alternatives = Json::array();
  for (const DrillCandidate& alternative : detection.alternatives) {
    alternatives.push_back(CandidateJson(alternative, robot_from_base));
    alternatives.back()["margin_nats"] = detection.best.log_likelihood - alternative.log_likelihood;
  }
  Json value = {{"best", CandidateJson(detection.best, robot_from_base)},
                {"grasp", GraspToJson(detection.best, robot_from_base)},
                {"sigma_position_m", ToJson(detection.sigma_position_m)},
                {"sigma_yaw_rad", detection.sigma_yaw_rad},
                {"sigma_axis_rad", detection.sigma_axis_rad},
                {"covariance", ToJson(detection.covariance)},
                {"table", nullptr},
                {"evidence", EvidenceJson(detection.evidence)},
                {"alternatives", alternatives}};
  if (detection.table)
    value["table"] = {{"normal", ToJson(detection.table->normal)},
                      {"offset_m", detection.table->offset}};
  return value;
}

DrillDetection DrillFrom(const Json& value) {
  DrillDetection detection;
  detection.best = DrillCandidateFrom(value.at("best"));
  detection.sigma_position_m = Vector3From(value.at("sigma_position_m"));
  detection.sigma_yaw_rad = NumberFrom(value.at("sigma_yaw_rad"));
  detection.sigma_axis_rad = NumberFrom(value.at("sigma_axis_rad"));
  detection.covariance = CovarianceFrom(value);
  if (const Json& table = value.at("table"); !table.is_null())
    detection.table = Plane{Vector3From(table.at("normal")), NumberFrom(table.at("offset_m"))};
  detection.evidence = DrillEvidenceFrom(value.at("evidence"));
  for (const Json& alternative : AlternativesIn(value))
    detection.alternatives.push_back(DrillCandidateFrom(alternative));
  return detection;
}

}  // namespace foresight
