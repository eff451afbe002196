#include "core/mission/plan_json.h"

#include <nlohmann/json.hpp>

#include "core/io/json_reader.h"

namespace foresight {
namespace {

constexpr std::size_t kMostImages = 1000;

}  // namespace

std::string PlanToJson(const ScanPlan& plan) {
  return nlohmann::json{{"from_rad", plan.from_rad},
                        {"to_rad", plan.to_rad},
                        {"speed_rad_s", plan.speed_rad_s},
                        {"image_angles_rad", plan.image_angles_rad},
                        {"exposure_s", plan.exposure_s},
                        {"gain_db", plan.gain_db},
                        {"image_mode", ToString(plan.image_mode)},
                        {"max_blur_px", plan.max_blur_px},
                        {"passes", plan.passes}}
      .dump();
}

Result<ScanPlan> PlanFromJson(const std::string& json, const std::string& source) {
  try {
    const nlohmann::json value = ParseJson(json);
    ScanPlan plan;
    value.at("from_rad").get_to(plan.from_rad);
    value.at("to_rad").get_to(plan.to_rad);
    value.at("speed_rad_s").get_to(plan.speed_rad_s);
    ListIn(value, "image_angles_rad", kMostImages).get_to(plan.image_angles_rad);
    value.at("exposure_s").get_to(plan.exposure_s);
    value.at("gain_db").get_to(plan.gain_db);
    // Plans that were written before these existed are executed as they were.
    // "picture_mode" is what earlier programs wrote.
    const char* mode_key = value.contains("picture_mode") ? "picture_mode" : "image_mode";
    if (value.contains(mode_key)) {
      const auto mode = ImageModeFromString(value[mode_key].get<std::string>());
      if (!mode)
        return Fail(ErrorCode::kBadData, "{}: scan plan: {}", source, mode.error().message);
      plan.image_mode = *mode;
    }
    plan.max_blur_px = value.value("max_blur_px", plan.max_blur_px);
    if (value.contains("passes")) plan.passes = IntegerIn(value, "passes", 1, 2);
    if (const Status status = plan.Check(); !status)
      return Fail(ErrorCode::kBadData, "{}: {}", source, status.error().message);
    return plan;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return Fail(ErrorCode::kBadData, "{}: scan plan: {}", source, error.what());
  }
}

}  // namespace foresight
