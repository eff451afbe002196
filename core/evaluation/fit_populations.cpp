#include "core/evaluation/fit_populations.h"

#include <functional>

#include "core/evaluation/drill_population.h"
#include "core/evaluation/terrain_population.h"
#include "core/evaluation/valve_population.h"

namespace foresight {
namespace {

struct Entry {
  std::string kind;
  std::function<std::unique_ptr<FitPopulation>()> make;
};

const std::vector<Entry>& Entries() {
  static const std::vector<Entry> entries = {
      {"valve", [] { return std::make_unique<ValvePopulation>(); }},
      {"drill", [] { return std::make_unique<DrillPopulation>(); }},
      {"terrain", [] { return std::make_unique<TerrainPopulation>(); }},
  };
  return entries;
}

}  // namespace

std::vector<std::string> FitPopulationKinds() {
  std::vector<std::string> kinds;
  for (const Entry& entry : Entries()) kinds.push_back(entry.kind);
  return kinds;
}

Result<std::unique_ptr<FitPopulation>> MakeFitPopulation(const std::string& kind) {
  std::string known;
  for (const Entry& entry : Entries()) {
    if (entry.kind == kind) return entry.make();
    known += (known.empty() ? "" : ", ") + entry.kind;
  }
  return Fail(ErrorCode::kInvalidOptions, "object '{}' is not one of: {}", kind, known);
}

}  // namespace foresight
