#include "app/ctl/fit_output.h"

#include "app/common/output.h"
#include "core/detection/facts.h"

namespace foresight {

void PrintSummary(const Detection& detection, const SensorRig& rig,
                  const std::optional<Eigen::Vector3d>& up_of_cloud) {
  const Verdict& verdict = VerdictOf(detection);
  PrintLine(fmt::format("{} ({}): {}", ToString(verdict.level),
                        ProbabilityText(verdict.probability), verdict.reason));
  const auto* terrain = std::get_if<TerrainDetection>(&detection);
  const int parts = terrain == nullptr ? 1 : static_cast<int>(terrain->surfaces.size());
  for (int part = 0; part < parts; ++part)
    for (const Fact& fact : FactsOf(detection, part, rig.robot_from_base, up_of_cloud))
      PrintLine(fmt::format("{:<15} {}", fact.name, fact.value));
}

ExitCode PrintNothingFound(ObjectKind kind, const Error& error) {
  using Json = nlohmann::ordered_json;
  PrintNote("foresightctl: {}", error.message);
  PrintJson({{"kind", ToString(kind)},
             {"verdict", "UNSURE"},
             {"probability", kind == ObjectKind::kCylinder ? Json(nullptr) : Json(0.0)},
             {"reason", error.message}});
  return ExitCode::kNegative;
}

}  // namespace foresight
