#include "core/fitting/drill/other_tools.h"

#include <algorithm>
#include <string_view>

namespace foresight {
namespace {

// Between a hot air tool's mouth, which is as wide as its barrel, and the widest chuck.
constexpr double kBluntWidth = 0.88;  // of the head

SolidPart* PartNamed(std::string_view name, DrillTemplate& kind) {
  const auto found = std::find_if(kind.parts.begin(), kind.parts.end(),
                                  [&](const SolidPart& part) { return part.name == name; });
  return found == kind.parts.end() ? nullptr : &*found;
}

}  // namespace

std::optional<DrillTemplate> WithoutFoot(const DrillTemplate& kind) {
  DrillTemplate tool = kind;
  const auto feet = std::erase_if(
      tool.parts, [](const SolidPart& part) { return part.name == DrillTemplate::kFoot; });
  if (feet == 0) return std::nullopt;
  SolidPart& grip = *PartNamed(DrillTemplate::kBody, tool);
  const Eigen::Vector3d middle = grip.object_from_part.translation();
  const double top_m = middle.z() + 0.5 * grip.size_m.z();
  grip.size_m.z() = top_m;
  grip.object_from_part = {grip.object_from_part.rotation(), {middle.x(), middle.y(), 0.5 * top_m}};
  return tool;
}

std::optional<DrillTemplate> WithBluntHead(const DrillTemplate& kind) {
  DrillTemplate tool = kind;
  SolidPart* chuck = PartNamed(DrillTemplate::kChuck, tool);
  const SolidPart* head = PartNamed(DrillTemplate::kHead, tool);
  if (chuck == nullptr || head == nullptr) return std::nullopt;
  chuck->size_m.head<2>().setConstant(kBluntWidth * head->size_m.y());
  chuck->name = DrillTemplate::kHead;  // it gets wider with the head
  return tool;
}

}  // namespace foresight
