#include "hardware/link/chunks/health_item.h"

#include <exception>
#include <nlohmann/json.hpp>

#include "core/io/json_reader.h"

namespace foresight {

std::string ToJson(const HealthReport& report) {
  return R"({"at_start":)" + ToJson(report.at_start) + R"(,"at_end":)" + ToJson(report.at_end) +
         "}";
}

Result<HealthReport> HealthReportFromJson(std::string_view json, const std::string& source) {
  try {
    const nlohmann::json members = ParseJson(json);
    HealthReport report;
    FORESIGHT_TRY(report.at_start, HeadHealthFromJson(members.at("at_start").dump()));
    FORESIGHT_TRY(report.at_end, HeadHealthFromJson(members.at("at_end").dump()));
    return report;
  } catch (const std::exception& error) {
    return Fail(ErrorCode::kBadData, "{}: device health: {}", source, error.what());
  }
}

}  // namespace foresight
