#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/detection/json_values.h"
#include "core/detection/object_json.h"

namespace foresight {
namespace {

Json EvidenceJson(const CylinderEvidence& evidence) {
  return {{"rays", evidence.rays},
          {"hits", evidence.hits},
          {"inlier_ratio", evidence.inlier_ratio},
          {"see_through", evidence.see_through},
          {"residual_mad_m", evidence.residual_mad_m},
          {"range_sigma_m", evidence.range_sigma_m},
          {"seen_arc_rad", evidence.seen_arc_rad},
          {"box_margin_nats", evidence.box_margin_nats},
          {"in_drawn_box", NumberOrNull(evidence.in_drawn_box)}};
}

CylinderEvidence CylinderEvidenceFrom(const Json& value) {
  CylinderEvidence evidence;
  evidence.rays = CountIn(value, "rays");
  evidence.hits = CountIn(value, "hits");
  evidence.inlier_ratio = NumberFrom(value.at("inlier_ratio"));
  evidence.see_through = NumberFrom(value.at("see_through"));
  evidence.residual_mad_m = NumberFrom(value.at("residual_mad_m"));
  evidence.range_sigma_m = NumberFrom(value.at("range_sigma_m"));
  evidence.seen_arc_rad = NumberFrom(value.at("seen_arc_rad"));
  evidence.box_margin_nats = NumberFrom(value.at("box_margin_nats"));
  evidence.in_drawn_box = NumberOrNone(value, "in_drawn_box");
  return evidence;
}

}  // namespace

CylinderModel CylinderModelFrom(const Json& value) {
  const CylinderModel model{SizeIn(value, "radius_m"), SizeIn(value, "length_m")};
  if (const Status status = model.Check(); !status)
    throw std::invalid_argument(status.error().message);
  return model;
}

Json ToJson(const CylinderDetection& cylinder,
            const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  return {{"base_from_object", ToJson(cylinder.base_from_object)},
          {"robot_from_object", ToJson(robot_from_base * cylinder.base_from_object)},
          {"radius_m", cylinder.model.radius_m},
          {"length_m", cylinder.model.length_m},
          {"sigma_radius_m", cylinder.sigma_radius_m},
          {"sigma_across_m", cylinder.sigma_across_m},
          {"sigma_axis_rad", cylinder.sigma_axis_rad},
          {"covariance", ToJson(cylinder.covariance)},
          {"evidence", EvidenceJson(cylinder.evidence)}};
}

CylinderDetection CylinderFrom(const Json& value) {
  CylinderDetection cylinder;
  cylinder.base_from_object = PoseFrom(value.at("base_from_object"));
  cylinder.model = CylinderModelFrom(value);
  cylinder.sigma_radius_m = NumberFrom(value.at("sigma_radius_m"));
  cylinder.sigma_across_m = NumberFrom(value.at("sigma_across_m"));
  cylinder.sigma_axis_rad = NumberFrom(value.at("sigma_axis_rad"));
  cylinder.covariance = CovarianceFrom(value);
  cylinder.evidence = CylinderEvidenceFrom(value.at("evidence"));
  return cylinder;
}

}  // namespace foresight
