#include "core/mission/plan_json.h"

#include <nlohmann/json.hpp>

namespace foresight {

std::string PlanToJson(const ScanPlan& plan) {
  return nlohmann::json{
      {"from_rad", plan.from_rad},       {"to_rad", plan.to_rad},
      {"speed_rad_s", plan.speed_rad_s}, {"image_angles_rad", plan.image_angles_rad},
      {"exposure_s", plan.exposure_s},   {"gain_db", plan.gain_db}}
      .dump();
}

Result<ScanPlan> PlanFromJson(const std::string& json, const std::string& source) {
  try {
    const nlohmann::json value = nlohmann::json::parse(json);
    ScanPlan plan;
    value.at("from_rad").get_to(plan.from_rad);
    value.at("to_rad").get_to(plan.to_rad);
    value.at("speed_rad_s").get_to(plan.speed_rad_s);
    value.at("image_angles_rad").get_to(plan.image_angles_rad);
    value.at("exposure_s").get_to(plan.exposure_s);
    value.at("gain_db").get_to(plan.gain_db);
    return plan;
  } catch (const nlohmann::json::exception& error) {
    return Fail(ErrorCode::kBadData, "{}: scan plan: {}", source, error.what());
  }
}

}  // namespace foresight
