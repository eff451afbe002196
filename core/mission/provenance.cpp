#include "core/mission/provenance.h"

#include <nlohmann/json.hpp>

namespace foresight {
namespace {

using Json = nlohmann::ordered_json;

/// A JSON text inside of another one stays readable as what it is.
Json Nested(const std::string& text) {
  if (text.empty()) return nullptr;
  Json value = Json::parse(text, nullptr, false);
  return value.is_discarded() || value.is_string() || value.is_null() ? Json(text) : value;
}

std::string Unnested(const Json& value) {
  if (value.is_null()) return {};
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

std::string ProvenanceToJson(const Provenance& provenance) {
  return Json{{"program_version", provenance.program_version},
              {"rig_id", provenance.rig_id},
              {"image_position", provenance.image_position},
              {"source", provenance.source},
              {"options", Nested(provenance.options_json)},
              {"seed", provenance.seed},
              {"roi", Nested(provenance.roi_json)}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<Provenance> ProvenanceFromJson(const std::string& json, const std::string& source) {
  try {
    const Json value = Json::parse(json);
    Provenance provenance;
    value.at("program_version").get_to(provenance.program_version);
    value.at("rig_id").get_to(provenance.rig_id);
    value.at("image_position").get_to(provenance.image_position);
    value.at("source").get_to(provenance.source);
    provenance.options_json = Unnested(value.at("options"));
    value.at("seed").get_to(provenance.seed);
    provenance.roi_json = Unnested(value.at("roi"));
    return provenance;
  } catch (const nlohmann::json::exception& error) {
    return Fail(ErrorCode::kBadData, "{}: provenance: {}", source, error.what());
  }
}

}  // namespace foresight
