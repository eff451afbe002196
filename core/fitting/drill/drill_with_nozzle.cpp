#include "core/fitting/drill/drill_with_nozzle.h"

#include <algorithm>
#include <cmath>

#include "core/objects/drill_template.h"

namespace foresight {
namespace {

constexpr double kFractions[] = {1.0, 0.8};  // of the chuck's thickness
constexpr double kShortestPart_m = 0.010;

const SolidPart* Named(const std::vector<SolidPart>& parts, const char* name) {
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [&](const SolidPart& part) { return part.name == name; });
  return found == parts.end() ? nullptr : &*found;
}

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

std::vector<std::vector<SolidPart>> WithNozzles(const std::vector<SolidPart>& drill,
                                                double nozzle_m) {
  std::vector<std::vector<SolidPart>> tools;
  const SolidPart* chuck = Named(drill, DrillTemplate::kChuck);
  if (chuck == nullptr) return tools;
  const Eigen::Vector3d middle = chuck->object_from_part.translation();
  const SolidPart* bit = Named(drill, DrillTemplate::kBit);
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
