#include "core/detection/pose_difference.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/detection/candidates.h"

namespace foresight {
namespace {

int TurnsOf(const Detection& detection) {
  if (std::holds_alternative<CylinderDetection>(detection)) return 0;
  const auto* valve = std::get_if<ValveDetection>(&detection);
  if (valve == nullptr || valve->best.model.IsLever()) return 1;
  return valve->best.model.spokes;
}

/// The turn about z that brings x of `rotation` as near to x as it can be.
double TurnAboutZ(const Eigen::Quaterniond& rotation) {
  return 2.0 * std::atan2(rotation.z(), rotation.w());
}

Eigen::Quaterniond AboutZ(double angle_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()));
}

/// Of the rotations that give the same object, the smallest.
Eigen::Quaterniond Smallest(const Eigen::Quaterniond& rotation, int turns) {
  const double about_z = TurnAboutZ(rotation);
  if (turns == 0) return rotation * AboutZ(-about_z);
  const double step = 2.0 * std::numbers::pi / turns;
  return rotation * AboutZ(-step * std::round(about_z / step));
}

}  // namespace

std::vector<PlacedObject> PlacedObjectsOf(const Detection& detection, const std::string& uuid,
                                          const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  const auto* terrain = std::get_if<TerrainDetection>(&detection);
  const int parts = terrain == nullptr ? 1 : static_cast<int>(terrain->surfaces.size());
  std::vector<PlacedObject> objects;
  for (int part = 0; part < parts; ++part)
    objects.push_back({uuid, KindOf(detection), CandidateText(detection, part),
                       CandidateLevel(detection, part),
                       robot_from_base * CandidatePose(detection, part), TurnsOf(detection)});
  return objects;
}

PoseDifference DifferenceOf(const PlacedObject& first, const PlacedObject& second) {
  const auto difference = first.robot_from_object.Inverse() * second.robot_from_object;
  // A wheel of which the spokes were counted otherwise has no turn that can be compared.
  const int turns = first.turns == second.turns ? first.turns : 0;
  const Eigen::AngleAxisd turn(Smallest(difference.rotation(), turns));
  PoseDifference answer;
  answer.shift_m = difference.translation();
  answer.distance_m = answer.shift_m.norm();
  // Eigen's angle of a quaternion is in [0, pi].
  answer.angle_rad = turn.angle();
  answer.turn_rad = turn.angle() * turn.axis();
  return answer;
}

std::vector<ObjectPair> MatchObjects(const std::vector<PlacedObject>& first,
                                     const std::vector<PlacedObject>& second, double reach_m) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = 0; j < second.size(); ++j) {
      const double distance_m =
          (first[i].robot_from_object.translation() - second[j].robot_from_object.translation())
              .norm();
      if (first[i].kind == second[j].kind && distance_m <= reach_m)
        candidates.emplace_back(distance_m, i, j);
    }
  std::sort(candidates.begin(), candidates.end());
  std::vector<std::optional<std::size_t>> partner(first.size());
  std::vector<bool> taken(second.size());
  for (const auto& [distance_m, i, j] : candidates) {
    if (partner[i] || taken[j]) continue;
    partner[i] = j;
    taken[j] = true;
  }
  std::vector<ObjectPair> pairs;
  for (std::size_t i = 0; i < first.size(); ++i)
    if (partner[i])
      pairs.push_back({first[i], second[*partner[i]], DifferenceOf(first[i], second[*partner[i]])});
  for (std::size_t i = 0; i < first.size(); ++i)
    if (!partner[i]) pairs.push_back({first[i], std::nullopt, std::nullopt});
  for (std::size_t j = 0; j < second.size(); ++j)
    if (!taken[j]) pairs.push_back({std::nullopt, second[j], std::nullopt});
  return pairs;
}

}  // namespace foresight
