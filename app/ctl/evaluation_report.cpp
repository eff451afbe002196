#include "app/ctl/evaluation_report.h"

#include <algorithm>

#include "app/ctl/command.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

nlohmann::ordered_json ToJson(const DepthAccuracy& accuracy) {
  return {{"a80_mm", FiniteOrNull(accuracy.a80_mm)},
          {"a95_mm", FiniteOrNull(accuracy.a95_mm)},
          {"coverage", accuracy.coverage},
          {"unscored_kept", accuracy.unscored_kept}};
}

nlohmann::ordered_json ToJson(const EvaluationRow& row) {
  const MethodScore& score = row.score;
  nlohmann::ordered_json json = {{"scene", score.scene}, {"method", score.method}};
  json.update(ToJson(score.with_mask));
  json["seconds"] = score.seconds;
  json["samples"] = score.samples;
  json["rejected"] = score.rejected;
  json["rejection_precision"] = FiniteOrNull(score.rejection_precision);
  json["rejection_recall"] = FiniteOrNull(score.rejection_recall);
  json["without_mask"] = ToJson(score.without_mask);
  if (row.in_foresight_mask) json["in_foresight_mask"] = ToJson(*row.in_foresight_mask);
  if (row.calibration_error)
    json["calibration_error"] = {
        {"rotation_deg", DegreesFromRadians(row.calibration_error->rotation_rad)},
        {"translation_mm", 1000.0 * row.calibration_error->translation_m}};
  return json;
}

std::string Printed(const DepthAccuracy& accuracy) {
  return fmt::format("{:>8.1f} {:>8.1f} {:>6.3f}", accuracy.a80_mm, accuracy.a95_mm,
                     accuracy.coverage);
}

std::string PrintedRow(const EvaluationRow& row) {
  const MethodScore& s = row.score;
  return fmt::format("{:<16} {:<10} {} {:>6.3f}   {}   {:>24}   {:>7.2f}", s.scene, s.method,
                     Printed(s.with_mask), s.with_mask.unscored_kept, Printed(s.without_mask),
                     row.in_foresight_mask ? Printed(*row.in_foresight_mask) : "", s.seconds);
}

}  // namespace

void PrintEvaluation(const std::vector<EvaluationRow>& rows, bool as_json) {
  if (as_json) {
    auto list = nlohmann::ordered_json::array();
    for (const EvaluationRow& row : rows) list.push_back(ToJson(row));
    PrintJson(list);
    return;
  }
  PrintLine(fmt::format("{:<27} {:>31}   {:>24}   {:>24}", "", "masked", "not masked",
                        "in Foresight's mask"));
  PrintLine(fmt::format(
      "{:<16} {:<10} {:>8} {:>8} {:>6} {:>6}   {:>8} {:>8} {:>6}   {:>8} {:>8} {:>6}   {:>7}",
      "scene", "method", "A80 mm", "A95 mm", "cover", "holes", "A80 mm", "A95 mm", "cover",
      "A80 mm", "A95 mm", "cover", "seconds"));
  for (const EvaluationRow& row : rows) PrintLine(PrintedRow(row));
  const auto simulated = std::find_if(rows.begin(), rows.end(), [](const EvaluationRow& row) {
    return row.calibration_error.has_value();
  });
  if (simulated != rows.end())
    PrintLine(fmt::format("Simulated scenes: calibration off by {:.2f} deg and {:.1f} mm",
                          DegreesFromRadians(simulated->calibration_error->rotation_rad),
                          1000.0 * simulated->calibration_error->translation_m));
}

}  // namespace foresight
