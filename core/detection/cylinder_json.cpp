#include "core/detection/cylinder_json.h"

#include <nlohmann/json.hpp>

#include "core/detection/json_values.h"

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
          {"box_margin_nats", evidence.box_margin_nats}};
}

}  // namespace

std::string CylinderToJson(const CylinderDetection& cylinder,
                           const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  Json value = {{"kind", "cylinder"},
                {"base_from_object", ToJson(cylinder.base_from_object)},
                {"robot_from_object", ToJson(robot_from_base * cylinder.base_from_object)},
                {"radius_m", cylinder.model.radius_m},
                {"length_m", cylinder.model.length_m},
                {"sigma_radius_m", cylinder.sigma_radius_m},
                {"sigma_across_m", cylinder.sigma_across_m},
                {"sigma_axis_rad", cylinder.sigma_axis_rad},
                {"evidence", EvidenceJson(cylinder.evidence)},
                {"verdict", ToString(cylinder.level)},
                {"probability", nullptr},
                {"reason", cylinder.reason}};
  AddOrigin(cylinder.origin, value);
  return value.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace foresight
