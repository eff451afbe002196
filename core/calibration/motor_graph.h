#pragma once

#include <string>
#include <vector>

#include "core/calibration/calibration_session.h"

namespace foresight {

/// Whether the images tie all angles of the motor to its reference. A stop is tied to another one
/// by a pose of the stand that is seen from both: a graph of poses and stops. Its least angles
/// apart are those of StopAngles.
struct MotorGraph {
  std::vector<double> stops_rad;
  int reference = -1;              ///< the stop at 0; -1 = there is none
  std::vector<int> unseen;         ///< stops at which no image shows the stand
  std::vector<int> disconnected;   ///< stops that are seen, but not tied to the reference
  std::vector<int> useless_poses;  ///< seen from a single stop: they say nothing of the axis
  int seen_pairs = 0;              ///< images that show the stand

  bool Complete() const { return reference >= 0 && unseen.empty() && disconnected.empty(); }
  /// What is missing and what to record, in one line; empty where nothing is.
  std::string InWords(const CalibrationSession& session) const;
};

MotorGraph MakeMotorGraph(const CalibrationSession& session);

/// The session without the stops that `graph` cannot tie to the reference.
CalibrationSession WithoutLooseStops(const CalibrationSession& session, const MotorGraph& graph);

}  // namespace foresight
