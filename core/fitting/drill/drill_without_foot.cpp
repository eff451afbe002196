#include "core/fitting/drill/drill_without_foot.h"

#include <algorithm>

namespace foresight {

std::optional<DrillTemplate> WithoutFoot(const DrillTemplate& kind) {
  DrillTemplate tool = kind;
  const auto feet = std::erase_if(
      tool.parts, [](const SolidPart& part) { return part.name == DrillTemplate::kFoot; });
  if (feet == 0) return std::nullopt;
  SolidPart& grip = *std::find_if(tool.parts.begin(), tool.parts.end(), [](const SolidPart& part) {
    return part.name == DrillTemplate::kBody;
  });
  const Eigen::Vector3d middle = grip.object_from_part.translation();
  const double top_m = middle.z() + 0.5 * grip.size_m.z();
  grip.size_m.z() = top_m;
  grip.object_from_part = {grip.object_from_part.rotation(), {middle.x(), middle.y(), 0.5 * top_m}};
  return tool;
}

}  // namespace foresight
