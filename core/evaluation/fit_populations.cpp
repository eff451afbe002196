#include "core/evaluation/fit_populations.h"

#include <functional>

#include "core/evaluation/other_populations.h"
#include "core/evaluation/varied_world.h"

namespace foresight {
namespace {

struct Entry {
  std::string kind;
  std::function<std::unique_ptr<FitPopulation>()> make, make_other;
};

const std::vector<Entry>& Entries() {
  static const std::vector<Entry> entries = {
      {"valve", [] { return std::make_unique<ValvePopulation>(); },
       [] { return std::make_unique<OtherValvePopulation>(); }},
      {"drill", [] { return std::make_unique<DrillPopulation>(); },
       [] { return std::make_unique<OtherDrillPopulation>(); }},
      {"terrain", [] { return std::make_unique<TerrainPopulation>(); },
       [] { return std::make_unique<OtherTerrainPopulation>(); }},
      {"handle", [] { return std::make_unique<HandlePopulation>(); },
       [] { return std::make_unique<OtherHandlePopulation>(); }},
  };
  return entries;
}

}  // namespace

std::vector<std::string> FitPopulationKinds() {
  std::vector<std::string> kinds;
  for (const Entry& entry : Entries()) kinds.push_back(entry.kind);
  return kinds;
}

Result<std::unique_ptr<FitPopulation>> MakeFitPopulation(const std::string& kind, FitWorld world) {
  std::string known;
  for (const Entry& entry : Entries()) {
    if (entry.kind == kind) {
      if (world == FitWorld::kOther) return entry.make_other();
      return world == FitWorld::kVaried ? MakeVaried(entry.make()) : entry.make();
    }
    known += (known.empty() ? "" : ", ") + entry.kind;
  }
  return Fail(ErrorCode::kInvalidOptions, "object '{}' is not one of: {}", kind, known);
}

}  // namespace foresight
