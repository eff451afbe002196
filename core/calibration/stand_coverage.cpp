#include "core/calibration/stand_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/calibration/locate_board.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

/// As many as docs/calibration_chain.md asks for, and fewer than which say too little.
constexpr int kGoodPoses = 6;
constexpr double kClearlyAside_rad = 0.1;

/// A pose of board A in base, from the first image that shows a board.
std::optional<Rigid<frame::Base, frame::Pattern>> LocateStand(const CalibrationSession& session,
                                                              const PatternPose& pose,
                                                              const SensorRig& rig) {
  for (const MotorStop& stop : pose.stops) {
    const auto base_from_camera = rig.CameraFromBase(stop.motor_rad).Inverse();
    if (stop.view.a) {
      if (const auto found =
              LocateBoard(rig.camera, session.mount.a, *stop.view.a, stop.view.source))
        return base_from_camera * found->camera_from_board;
    } else if (stop.view.b && session.mount.b) {
      if (const auto found =
              LocateBoard(rig.camera, *session.mount.b, *stop.view.b, stop.view.source))
        return base_from_camera * found->camera_from_board * session.mount.a_from_b.Inverse();
    }
  }
  return std::nullopt;
}

/// The turn of the hinge about the line of sight, by its upper end: 0 = upright, positive = leaning
/// to the right.
double HingeTurn(const BoardMount& mount, const Rigid<frame::Base, frame::Pattern>& base_from_a) {
  const Eigen::Vector3d hinge = base_from_a.Rotate(
      Eigen::Vector3d::UnitZ().cross(mount.a_from_b.Rotate(Eigen::Vector3d::UnitZ())));
  const Eigen::Vector3d sight = base_from_a.translation().normalized();
  const Eigen::Vector3d right = (Eigen::Vector3d::UnitX() - sight.x() * sight).normalized();
  const Eigen::Vector3d up = right.cross(sight);
  const double across = hinge.dot(right), along = hinge.dot(up);
  return along < 0.0 ? std::atan2(-across, -along) : std::atan2(across, along);
}

StandCoverage::Hinge HingeOf(double turn_rad) {
  const double turn_deg = DegreesFromRadians(turn_rad);
  if (std::abs(turn_deg) < 22.5) return StandCoverage::kUpright;
  if (std::abs(turn_deg) > 67.5) return StandCoverage::kLevel;
  return turn_deg < 0.0 ? StandCoverage::kLeaningLeft : StandCoverage::kLeaningRight;
}

std::string StopsInWords(const MotorGraph& graph, const std::vector<int>& stops) {
  std::string text;
  for (const int stop : stops)
    text += fmt::format("{}{:.6g}", text.empty() ? "" : ", ",
                        DegreesFromRadians(graph.stops_rad[static_cast<std::size_t>(stop)]));
  return text + " deg";
}

/// Where the stand has to be for stops that do not see it, or are tied to no other.
std::string PlaceForStops(const StandCoverage& coverage) {
  const MotorGraph& graph = coverage.graph;
  const std::vector<int>& wanting = graph.unseen.empty() ? graph.disconnected : graph.unseen;
  if (wanting.empty() || graph.stops_rad.empty()) return {};
  const std::size_t middle = graph.stops_rad.size() / 2;
  const auto above = std::count_if(wanting.begin(), wanting.end(), [&](int stop) {
    return static_cast<std::size_t>(stop) >= middle;
  });
  const bool higher = 2 * above >= static_cast<std::ptrdiff_t>(wanting.size());
  std::vector<int> side;
  for (const int stop : wanting)
    if ((static_cast<std::size_t>(stop) >= middle) == higher) side.push_back(stop);
  return fmt::format("the stand {}, so that the stop{} {} see{} it{}", higher ? "higher" : "lower",
                     side.size() > 1 ? "s" : "", StopsInWords(graph, side),
                     side.size() > 1 ? "" : "s",
                     graph.unseen.empty() ? " together with a stop nearer to 0 deg" : "");
}

std::string HingeWanted(const StandCoverage& coverage) {
  if (!coverage.two_boards) return {};
  constexpr std::array<const char*, 4> kWords = {
      "with its hinge upright", "with its hinge leaning 45 deg to the left", "with its hinge level",
      "with its hinge leaning 45 deg to the right"};
  for (const auto hinge : {StandCoverage::kUpright, StandCoverage::kLevel,
                           StandCoverage::kLeaningLeft, StandCoverage::kLeaningRight})
    if (coverage.hinges[hinge] == 0) return kWords[hinge];
  return {};
}

std::string SideWanted(const StandCoverage& coverage) {
  if (coverage.left == 0 && coverage.right == 0) return {};
  if (coverage.left == 0) return "further left";
  return coverage.right == 0 ? "further right" : "";
}

}  // namespace

StandCoverage MeasureStand(const CalibrationSession& session, const SensorRig& rig) {
  StandCoverage coverage;
  coverage.graph = MakeMotorGraph(session);
  coverage.two_boards = session.mount.b.has_value();
  for (const PatternPose& pose : session.poses) {
    if (!pose.sweep.lines.empty()) ++coverage.sweeps;
    const auto base_from_a = LocateStand(session, pose, rig);
    if (!base_from_a) continue;
    ++coverage.poses;
    const Eigen::Vector3d& place = base_from_a->translation();
    const double aside = std::asin(std::clamp(place.x() / place.norm(), -1.0, 1.0));
    if (aside < -kClearlyAside_rad) ++coverage.left;
    if (aside > kClearlyAside_rad) ++coverage.right;
    if (coverage.two_boards) ++coverage.hinges[HingeOf(HingeTurn(session.mount, *base_from_a))];
  }
  return coverage;
}

std::string NextPlace(const StandCoverage& coverage) {
  if (coverage.poses == 0)
    return "the stand 0.8 to 1.5 m away, open towards the head, its hinge upright";
  std::string text = PlaceForStops(coverage);
  const auto add = [&text](const std::string& part) {
    if (!part.empty()) text += (text.empty() ? "the stand " : ", ") + part;
  };
  if (coverage.poses < kGoodPoses) add(SideWanted(coverage));
  add(HingeWanted(coverage));
  if (text.empty() && coverage.sweeps == 0)
    return "a sweep up and down where the stand is: it tells the offset of the lidar's time stamps";
  if (text.empty() && coverage.poses < kGoodPoses)
    return fmt::format("another place of the stand, at another height; {} of {} are there",
                       coverage.poses, kGoodPoses);
  return text;
}

}  // namespace foresight
