#include "core/detection/detection_json.h"

#include <nlohmann/json.hpp>

#include "core/detection/json_values.h"
#include "core/detection/object_json.h"
#include "core/io/json_reader.h"

namespace foresight {
namespace {

Detection ObjectFrom(const Json& value) {
  const std::string kind = value.at("kind");
  if (kind == "valve") return ValveFrom(value);
  if (kind == "drill") return DrillFrom(value);
  if (kind == "terrain") return TerrainFrom(value);
  if (kind == "handle") return HandleFrom(value);
  if (kind == "cylinder") return CylinderFrom(value);
  throw std::invalid_argument("kind '" + kind + "' is not known");
}

}  // namespace

std::string DetectionToJson(const Detection& detection,
                            const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  Json value =
      std::visit([&](const auto& found) { return ToJson(found, robot_from_base); }, detection);
  value["kind"] = KindOf(detection);
  AddVerdict(VerdictOf(detection), value);
  AddOrigin(OriginOf(detection), value);
  // What a text was made of may hold bytes that are no UTF-8; JSON may not.
  return value.dump(2, ' ', false, Json::error_handler_t::replace);
}

Result<Detection> DetectionFromJson(std::string_view text) {
  try {
    const Json value = ParseJson(text);
    Detection detection = ObjectFrom(value);
    std::visit(
        [&value](auto& found) {
          found.verdict = VerdictFrom(value);
          found.origin = OriginFrom(value);
        },
        detection);
    return detection;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    return Fail(ErrorCode::kBadData, "detection: {}", failure.what());
  }
}

std::vector<std::pair<std::string, double>> EvidenceNumbers(const Detection& detection) {
  const Json value = std::visit(
      [](const auto& found) { return ToJson(found, Rigid<frame::Robot, frame::Base>()); },
      detection);
  std::vector<std::pair<std::string, double>> numbers;
  if (!value.contains("evidence")) return numbers;
  for (const auto& [name, number] : value.at("evidence").items())
    if (number.is_number() || number.is_null()) numbers.emplace_back(name, NumberFrom(number));
  return numbers;
}

std::string RoiToJson(const Roi& roi) {
  return ToJson(roi).dump();
}

Result<Roi> RoiFromJson(std::string_view text) {
  try {
    Roi roi = RoiFrom(ParseJson(text));
    const Status sound = CheckRoi(roi);
    if (!sound) return Fail(ErrorCode::kBadData, "region: {}", sound.error().message);
    return roi;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    return Fail(ErrorCode::kBadData, "region: {}", failure.what());
  }
}

}  // namespace foresight
