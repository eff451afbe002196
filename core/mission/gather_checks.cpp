#include "core/mission/gather_checks.h"

#include <map>

#include "core/selfcheck/gather_rig.h"
#include "core/sensor/rig_id.h"

namespace foresight {

std::optional<GatheredCheck> GatherChecks(std::span<const KeptCheck> checks, const SensorRig& rig) {
  const std::string rig_id = RigId(rig);
  std::map<std::string, const KeptCheck*> newest;
  for (const KeptCheck& check : checks) {
    if (check.rig_id != rig_id) continue;
    const KeptCheck*& of_scan = newest[check.scan_uuid];
    if (of_scan == nullptr || check.utc_ns >= of_scan->utc_ns) of_scan = &check;
  }
  std::vector<RigCheck> rigs;
  for (const auto& [uuid, check] : newest)
    if (check->rig.camera || check->rig.plate || check->rig.turns || check->rig.passes)
      rigs.push_back(check->rig);
  if (rigs.size() < 2) return std::nullopt;
  GatheredCheck gathered;
  gathered.scans = static_cast<int>(rigs.size());
  gathered.check = JudgeScan(rig, Fail(ErrorCode::kTooFewPoints, "each scan has its own"),
                             GatherRig(rigs, rig, RigCheckLimits()), {});
  std::erase_if(gathered.check.cannot_see,
                [](const std::string& sentence) { return sentence.starts_with("depth: "); });
  return gathered;
}

}  // namespace foresight
