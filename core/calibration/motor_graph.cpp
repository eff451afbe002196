#include "core/calibration/motor_graph.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

/// Sets of nodes that are merged, and found by one of their members.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t nodes) : parent_(nodes) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int Find(int node) {
    while (parent_[static_cast<std::size_t>(node)] != node)
      node = parent_[static_cast<std::size_t>(node)];
    return node;
  }
  void Merge(int a, int b) { parent_[static_cast<std::size_t>(Find(a))] = Find(b); }

 private:
  std::vector<int> parent_;
};

std::string AnglesInWords(const std::vector<double>& angles, const std::vector<int>& stops) {
  std::string text;
  for (const int stop : stops)
    text += fmt::format("{}{:.6g}", text.empty() ? "" : ", ",
                        DegreesFromRadians(angles[static_cast<std::size_t>(stop)]));
  return text + " deg";
}

}  // namespace

MotorGraph MakeMotorGraph(const CalibrationSession& session) {
  MotorGraph graph;
  graph.stops_rad = StopAngles(session);
  const std::size_t stops = graph.stops_rad.size();
  DisjointSets sets(stops + session.poses.size());
  std::vector<bool> seen(stops, false);
  for (std::size_t pose = 0; pose < session.poses.size(); ++pose) {
    int images = 0;
    for (const MotorStop& stop : session.poses[pose].stops) {
      if (stop.view.empty()) continue;
      const int index = StopIndex(graph.stops_rad, stop.motor_rad);
      sets.Merge(index, static_cast<int>(stops + pose));
      seen[static_cast<std::size_t>(index)] = true;
      ++images;
    }
    graph.seen_pairs += images;
    if (images == 1) graph.useless_poses.push_back(static_cast<int>(pose));
  }
  for (std::size_t stop = 0; stop < stops; ++stop)
    if (std::abs(graph.stops_rad[stop]) < kSameStop_rad) graph.reference = static_cast<int>(stop);
  for (int stop = 0; stop < static_cast<int>(stops); ++stop) {
    if (!seen[static_cast<std::size_t>(stop)])
      graph.unseen.push_back(stop);
    else if (graph.reference < 0 || sets.Find(stop) != sets.Find(graph.reference))
      graph.disconnected.push_back(stop);
  }
  return graph;
}

std::string MotorGraph::InWords(const CalibrationSession& session) const {
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  if (reference < 0) {
    add("there is no stop at 0 deg, which all angles refer to: capture one in each pose");
    return text;
  }
  if (!unseen.empty())
    add(
        fmt::format("no image shows the stand at the stops {}: add a pose of the stand that they "
                    "see",
                    AnglesInWords(stops_rad, unseen)));
  if (!disconnected.empty())
    add(
        fmt::format("no pose of the stand ties the stops {} to the stop 0 deg: add a pose that is "
                    "seen from one of them and from another stop",
                    AnglesInWords(stops_rad, disconnected)));
  if (text.empty() && static_cast<std::size_t>(seen_pairs) < 2 + session.poses.size())
    add("no pose of the stand is seen from two stops or more");
  return text;
}

CalibrationSession WithoutLooseStops(const CalibrationSession& session, const MotorGraph& graph) {
  std::vector<double> loose;
  for (const auto* stops : {&graph.unseen, &graph.disconnected})
    for (const int stop : *stops) loose.push_back(graph.stops_rad[static_cast<std::size_t>(stop)]);
  CalibrationSession rest = session;
  for (PatternPose& pose : rest.poses)
    std::erase_if(pose.stops, [&loose](const MotorStop& stop) {
      return std::any_of(loose.begin(), loose.end(), [&stop](double angle) {
        return std::abs(angle - stop.motor_rad) < kSameStop_rad;
      });
    });
  std::erase_if(rest.poses, [](const PatternPose& pose) {
    return pose.sweep.lines.empty() &&
           std::none_of(pose.stops.begin(), pose.stops.end(),
                        [](const MotorStop& stop) { return !stop.view.empty(); });
  });
  return rest;
}

}  // namespace foresight
