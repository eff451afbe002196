#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/detection/json_values.h"
#include "core/detection/object_json.h"
#include "core/io/json_reader.h"

namespace foresight {
namespace {

Json CandidateJson(const HandleCandidate& handle,
                   const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  return {{"base_from_object", ToJson(handle.base_from_object)},
          {"robot_from_object", ToJson(robot_from_base * handle.base_from_object)},
          {"model", ToJson(handle.model)},
          {"log_likelihood", handle.log_likelihood}};
}

HandleCandidate CandidateFrom(const Json& value) {
  return {PoseFrom(value.at("base_from_object")), HandleModelFrom(value.at("model")),
          NumberFrom(value.at("log_likelihood"))};
}

Json EvidenceJson(const HandleEvidence& evidence) {
  return {{"rays", evidence.rays},
          {"hits", evidence.hits},
          {"inlier_ratio", evidence.inlier_ratio},
          {"see_through", evidence.see_through},
          {"rms_m", evidence.rms_m},
          {"covered", evidence.covered},
          {"beside", evidence.beside},
          {"mirror_margin_nats", evidence.mirror_margin_nats},
          {"edges_nats", evidence.edges_nats},
          {"image_nats", evidence.image_nats},
          {"outline_nats_per_px", evidence.outline_nats_per_px},
          {"length_margin_nats", evidence.length_margin_nats},
          {"gain_nats", evidence.gain_nats},
          {"alternative_margin_nats", evidence.alternative_margin_nats},
          {"best_alternative", evidence.best_alternative}};
}

HandleEvidence HandleEvidenceFrom(const Json& value) {
  HandleEvidence evidence;
  evidence.rays = CountIn(value, "rays");
  evidence.hits = CountIn(value, "hits");
  evidence.inlier_ratio = NumberFrom(value.at("inlier_ratio"));
  evidence.see_through = NumberFrom(value.at("see_through"));
  evidence.rms_m = NumberFrom(value.at("rms_m"));
  evidence.covered = NumberFrom(value.at("covered"));
  evidence.beside = NumberFrom(value.at("beside"));
  evidence.mirror_margin_nats = NumberFrom(value.at("mirror_margin_nats"));
  // Answers of earlier programs do not have all of these.
  const auto newer = [&](const char* key) {
    return value.contains(key) ? NumberFrom(value[key]) : 0.0;
  };
  evidence.edges_nats = newer("edges_nats");
  evidence.image_nats = newer("image_nats");
  evidence.outline_nats_per_px = newer("outline_nats_per_px");
  evidence.length_margin_nats = NumberFrom(value.at("length_margin_nats"));
  evidence.gain_nats = NumberFrom(value.at("gain_nats"));
  evidence.alternative_margin_nats = NumberFrom(value.at("alternative_margin_nats"));
  evidence.best_alternative = value.at("best_alternative");
  return evidence;
}

HandleModel::Plate PlateFrom(const std::string& name) {
  for (const auto plate : {HandleModel::Plate::kRosette, HandleModel::Plate::kLong})
    if (name == ToString(plate)) return plate;
  throw std::invalid_argument("plate '" + name + "' is not known");
}

Json PlaneJson(const Plane& door) {
  return {{"normal", ToJson(door.normal)}, {"offset_m", door.offset}};
}

Plane PlaneFrom(const Json& value) {
  return {Vector3From(value.at("normal")), NumberFrom(value.at("offset_m"))};
}

}  // namespace

Json ToJson(const HandleModel& model) {
  return {{"length_m", model.length_m}, {"behind_m", model.behind_m},
          {"bow_m", model.bow_m},       {"lift_m", model.lift_m},
          {"radius_m", model.radius_m}, {"standoff_m", model.standoff_m},
          {"returned", model.returned}, {"plate", ToString(model.plate)}};
}

HandleModel HandleModelFrom(const Json& value) {
  HandleModel model;
  model.length_m = SizeIn(value, "length_m");
  // Files of versions before 2026-11-28 know no piece behind the pivot, and straight levers alone.
  if (value.contains("behind_m")) model.behind_m = NumberFrom(value.at("behind_m"));
  if (value.contains("bow_m")) model.bow_m = NumberFrom(value.at("bow_m"));
  if (value.contains("lift_m")) model.lift_m = NumberFrom(value.at("lift_m"));
  model.radius_m = SizeIn(value, "radius_m");
  model.standoff_m = SizeIn(value, "standoff_m");
  model.returned = value.at("returned").get<bool>();
  model.plate = PlateFrom(value.at("plate").get<std::string>());
  if (const Status status = model.Check(); !status)
    throw std::invalid_argument(status.error().message);
  return model;
}

Json ToJson(const HandleDetection& detection,
            const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  Json alternatives = Json::array();
  for (const HandleCandidate& alternative : detection.alternatives) {
    alternatives.push_back(CandidateJson(alternative, robot_from_base));
    alternatives.back()["margin_nats"] = detection.best.log_likelihood - alternative.log_likelihood;
  }
  return {{"best", CandidateJson(detection.best, robot_from_base)},
          {"door", PlaneJson(detection.door)},
          {"sigma_position_m", ToJson(detection.sigma_position_m)},
          {"sigma_turn_rad", detection.sigma_turn_rad},
          {"sigma_normal_rad", detection.sigma_normal_rad},
          {"sigma_length_m", detection.sigma_length_m},
          {"covariance", ToJson(detection.covariance)},
          {"evidence", EvidenceJson(detection.evidence)},
          {"alternatives", alternatives}};
}

HandleDetection HandleFrom(const Json& value) {
  HandleDetection detection;
  detection.best = CandidateFrom(value.at("best"));
  detection.door = PlaneFrom(value.at("door"));
  detection.sigma_position_m = Vector3From(value.at("sigma_position_m"));
  detection.sigma_turn_rad = NumberFrom(value.at("sigma_turn_rad"));
  detection.sigma_normal_rad = NumberFrom(value.at("sigma_normal_rad"));
  detection.sigma_length_m = NumberFrom(value.at("sigma_length_m"));
  detection.covariance = CovarianceFrom(value);
  detection.evidence = HandleEvidenceFrom(value.at("evidence"));
  for (const Json& alternative : AlternativesIn(value))
    detection.alternatives.push_back(CandidateFrom(alternative));
  return detection;
}

}  // namespace foresight
