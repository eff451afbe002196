#include "core/fitting/drill/other_tools.h"

#include "core/fitting/drill/named_part.h"

namespace foresight {
namespace {

constexpr double kFractions[] = {1.0, 0.8};  // of the chuck's thickness
constexpr double kShortestPart_m = 0.010;
constexpr double kForward = 0.9;  // of a bit that points ahead, not up

/// Which of a part's own axes lies along a direction.
int AxisAlong(const SolidPart& part, const Eigen::Vector3d& direction) {
  int axis = 0;
  (part.object_from_part.Inverse().Rotate(direction)).cwiseAbs().maxCoeff(&axis);
  return axis;
}

/// Where a part ends in a direction.
double EndAlong(const SolidPart& part, const Eigen::Vector3d& direction) {
  return part.object_from_part.translation().dot(direction) +
         0.5 * part.size_m[AxisAlong(part, direction)];
}

/// Lets a part end at `end_m` at the latest; false where nothing of it would be left.
bool CutAt(double end_m, const Eigen::Vector3d& direction, SolidPart& part) {
  const double excess_m = EndAlong(part, direction) - end_m;
  if (excess_m <= 0.0) return true;
  double& length_m = part.size_m[AxisAlong(part, direction)];
  if (length_m - excess_m < kShortestPart_m) return false;
  length_m -= excess_m;
  part.object_from_part = {part.object_from_part.rotation(),
                           part.object_from_part.translation() - 0.5 * excess_m * direction};
  return true;
}

}  // namespace

std::optional<DrillTemplate> WithoutFoot(const DrillTemplate& kind) {
  DrillTemplate tool = kind;
  const auto feet = std::erase_if(
      tool.parts, [](const SolidPart& part) { return part.name == DrillTemplate::kFoot; });
  if (feet == 0) return std::nullopt;
  SolidPart& grip = *NamedPart(tool.parts, DrillTemplate::kBody);
  const Eigen::Vector3d middle = grip.object_from_part.translation();
  const double top_m = middle.z() + 0.5 * grip.size_m.z();
  grip.size_m.z() = top_m;
  grip.object_from_part = {grip.object_from_part.rotation(), {middle.x(), middle.y(), 0.5 * top_m}};
  return tool;
}

std::optional<DrillTemplate> WithoutChuck(const DrillTemplate& kind) {
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitX();
  const SolidPart* chuck = NamedPart(kind.parts, DrillTemplate::kChuck);
  if (chuck == nullptr || kind.bit_direction.dot(forward) < kForward) return std::nullopt;
  const double end_m = EndAlong(*chuck, forward);
  DrillTemplate tool = kind;
  std::erase_if(tool.parts,
                [](const SolidPart& part) { return part.name == DrillTemplate::kChuck; });
  SolidPart* head = NamedPart(tool.parts, DrillTemplate::kGearCase);
  if (head == nullptr) head = NamedPart(tool.parts, DrillTemplate::kHead);
  if (head == nullptr) return std::nullopt;
  const double longer_m = end_m - EndAlong(*head, forward);
  head->size_m[AxisAlong(*head, forward)] += longer_m;
  head->object_from_part = {head->object_from_part.rotation(),
                            head->object_from_part.translation() + 0.5 * longer_m * forward};
  tool.max_bit_length_m = 0.0;
  return tool;
}

std::vector<std::vector<SolidPart>> WithNozzles(const std::vector<SolidPart>& drill,
                                                double nozzle_m) {
  std::vector<std::vector<SolidPart>> tools;
  const SolidPart* chuck = NamedPart(drill, DrillTemplate::kChuck);
  if (chuck == nullptr) return tools;
  const Eigen::Vector3d middle = chuck->object_from_part.translation();
  const SolidPart* bit = NamedPart(drill, DrillTemplate::kBit);
  // A bit may point up.
  const Eigen::Vector3d ahead = bit != nullptr
                                    ? Eigen::Vector3d(bit->object_from_part.translation() - middle)
                                    : Eigen::Vector3d::UnitX();
  Eigen::Vector3d forward = chuck->object_from_part.Rotate(Eigen::Vector3d::UnitZ());
  if (forward.dot(ahead) < 0.0) forward = -forward;
  std::vector<double> ends = {EndAlong(*chuck, forward)};
  if (bit != nullptr) ends.push_back(EndAlong(*bit, forward));
  for (const double end_m : ends)
    for (const double fraction : kFractions) {
      std::vector<SolidPart> tool = drill;
      std::erase_if(tool, [&](SolidPart& part) {
        if (part.name == DrillTemplate::kBit) return true;
        if (part.name == DrillTemplate::kHead || part.name == DrillTemplate::kGearCase)
          return !CutAt(end_m - nozzle_m, forward, part);
        if (part.name != DrillTemplate::kChuck) return false;
        part.size_m.head<2>() *= fraction;
        part.size_m.z() = nozzle_m;
        const double at_m = end_m - 0.5 * nozzle_m;
        part.object_from_part = {part.object_from_part.rotation(),
                                 middle + (at_m - middle.dot(forward)) * forward};
        return false;
      });
      tools.push_back(std::move(tool));
    }
  return tools;
}

}  // namespace foresight
