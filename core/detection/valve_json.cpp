#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/detection/json_values.h"
#include "core/detection/object_json.h"
#include "core/io/json_reader.h"

namespace foresight {
namespace {

constexpr double kMostDepthRatio = 100.0;

Json CandidateJson(const ValveCandidate& valve,
                   const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  return {{"base_from_object", ToJson(valve.base_from_object)},
          {"robot_from_object", ToJson(robot_from_base * valve.base_from_object)},
          {"model", ToJson(valve.model)},
          {"log_likelihood", valve.log_likelihood},
          {"brightness", valve.brightness}};
}

Json EvidenceJson(const ValveEvidence& evidence) {
  return {{"rays", evidence.rays},
          {"hits", evidence.hits},
          {"inlier_ratio", evidence.inlier_ratio},
          {"see_through", evidence.see_through},
          {"blocked_gaps", evidence.blocked_gaps},
          {"rms_m", evidence.rms_m},
          {"arc_coverage", evidence.arc_coverage},
          {"margin_nats", evidence.margin_nats},
          {"gain_nats", evidence.gain_nats},
          {"weakest_spoke", evidence.weakest_spoke},
          {"margin_line_sigmas", evidence.margin_line_sigmas},
          {"weakest_spoke_nats", evidence.weakest_spoke_nats},
          {"weakest_spoke_middle_nats", evidence.weakest_spoke_middle_nats},
          {"further_spoke_nats", evidence.further_spoke_nats},
          {"rim_nats", evidence.rim_nats},
          {"weakest_arc_nats", evidence.weakest_arc_nats},
          {"weakest_quarter_nats", evidence.weakest_quarter_nats},
          {"pipe_margin_nats", NumberOrNull(evidence.pipe_margin_nats)},
          {"outline_nats_per_px", evidence.outline_nats_per_px},
          {"weakest_outline_nats_per_px", evidence.weakest_outline_nats_per_px},
          {"further_outline_nats_per_px", evidence.further_outline_nats_per_px}};
}

ValveModel::Kind KindFrom(const std::string& name) {
  for (const auto kind : {ValveModel::Kind::kWheel, ValveModel::Kind::kLever})
    if (name == ToString(kind)) return kind;
  throw std::invalid_argument("valve '" + name + "' is not known");
}

ValveCandidate ValveCandidateFrom(const Json& value) {
  ValveCandidate valve{PoseFrom(value.at("base_from_object")), ValveModelFrom(value.at("model")),
                       NumberFrom(value.at("log_likelihood"))};
  if (value.contains("brightness")) valve.brightness = NumberFrom(value["brightness"]);
  return valve;
}

ValveEvidence ValveEvidenceFrom(const Json& value) {
  ValveEvidence evidence;
  evidence.rays = CountIn(value, "rays");
  evidence.hits = CountIn(value, "hits");
  evidence.inlier_ratio = NumberFrom(Renamed(value, "inlier_ratio", "inlier_share"));
  evidence.see_through = NumberFrom(value.at("see_through"));
  evidence.blocked_gaps = NumberFrom(value.at("blocked_gaps"));
  evidence.rms_m = NumberFrom(value.at("rms_m"));
  evidence.arc_coverage = NumberFrom(value.at("arc_coverage"));
  evidence.margin_nats = NumberFrom(value.at("margin_nats"));
  evidence.gain_nats = NumberFrom(value.at("gain_nats"));
  // Earlier programs did not write these.
  for (const auto& [name, member] :
       {std::pair("weakest_spoke", &evidence.weakest_spoke),
        std::pair("margin_line_sigmas", &evidence.margin_line_sigmas),
        std::pair("weakest_spoke_nats", &evidence.weakest_spoke_nats),
        std::pair("weakest_spoke_middle_nats", &evidence.weakest_spoke_middle_nats),
        std::pair("further_spoke_nats", &evidence.further_spoke_nats),
        std::pair("rim_nats", &evidence.rim_nats),
        std::pair("weakest_arc_nats", &evidence.weakest_arc_nats),
        std::pair("weakest_quarter_nats", &evidence.weakest_quarter_nats),
        std::pair("outline_nats_per_px", &evidence.outline_nats_per_px),
        std::pair("weakest_outline_nats_per_px", &evidence.weakest_outline_nats_per_px),
        std::pair("further_outline_nats_per_px", &evidence.further_outline_nats_per_px)})
    if (value.contains(name)) *member = NumberFrom(value[name]);
  evidence.pipe_margin_nats = NumberOrNone(value, "pipe_margin_nats");
  return evidence;
}

}  // namespace

Json ToJson(const ValveModel& model) {
  return {{"kind", ToString(model.kind)},
          {"lever_length_m", model.lever_length_m},
          {"rim_radius_m", model.rim_radius_m},
          {"tube_radius_m", model.tube_radius_m},
          {"spokes", model.spokes},
          {"spoke_radius_m", model.spoke_radius_m},
          {"hub_radius_m", model.hub_radius_m},
          {"dish_m", model.dish_m},
          {"rim_depth_ratio", model.rim_depth_ratio},
          {"spoke_depth_ratio", model.spoke_depth_ratio}};
}

ValveModel ValveModelFrom(const Json& value) {
  ValveModel model;
  model.rim_radius_m = SizeIn(value, "rim_radius_m");
  model.tube_radius_m = SizeIn(value, "tube_radius_m");
  model.spokes = IntegerIn(value, "spokes", 0, 6);
  model.spoke_radius_m = SizeIn(value, "spoke_radius_m");
  model.hub_radius_m = SizeIn(value, "hub_radius_m");
  model.dish_m = NumberIn(value, "dish_m", -kLargestObject_m, kLargestObject_m);
  // Records older than levers hold wheels.
  model.kind = KindFrom(value.value("kind", ToString(ValveModel::Kind::kWheel)));
  if (value.contains("lever_length_m")) model.lever_length_m = SizeIn(value, "lever_length_m");
  // Those older than flat wheels hold round ones.
  for (const auto& [key, ratio] : {std::pair("rim_depth_ratio", &model.rim_depth_ratio),
                                   std::pair("spoke_depth_ratio", &model.spoke_depth_ratio)})
    if (value.contains(key)) *ratio = NumberIn(value, key, 0.0, kMostDepthRatio);
  if (const Status status = model.Check(); !status)
    throw std::invalid_argument(status.error().message);
  return model;
}

Json ToJson(const ValveDetection& detection,
            const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  Json alternatives = Json::array();
  for (const ValveCandidate& alternative : detection.alternatives) {
    alternatives.push_back(CandidateJson(alternative, robot_from_base));
    alternatives.back()["margin_nats"] = detection.best.log_likelihood - alternative.log_likelihood;
  }
  return {{"best", CandidateJson(detection.best, robot_from_base)},
          {"phase_observable", detection.phase_observable},
          {"sigma_position_m", ToJson(detection.sigma_position_m)},
          {"sigma_axis_rad", detection.sigma_axis_rad},
          {"sigma_phase_rad", detection.sigma_phase_rad},
          {"covariance", ToJson(detection.covariance)},
          {"evidence", EvidenceJson(detection.evidence)},
          {"alternatives", alternatives}};
}

ValveDetection ValveFrom(const Json& value) {
  ValveDetection detection;
  detection.best = ValveCandidateFrom(value.at("best"));
  detection.phase_observable = value.at("phase_observable");
  detection.sigma_position_m = Vector3From(value.at("sigma_position_m"));
  detection.sigma_axis_rad = NumberFrom(value.at("sigma_axis_rad"));
  detection.sigma_phase_rad = NumberFrom(value.at("sigma_phase_rad"));
  detection.covariance = CovarianceFrom(value);
  detection.evidence = ValveEvidenceFrom(value.at("evidence"));
  for (const Json& alternative : AlternativesIn(value))
    detection.alternatives.push_back(ValveCandidateFrom(alternative));
  return detection;
}

}  // namespace foresight
