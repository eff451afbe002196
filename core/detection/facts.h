#pragma once

#include <string>
#include <vector>

#include "core/detection/detection.h"

namespace foresight {

/// One line of what is known about a detection: "Position", "x 812, y -40, z 1106 mm".
struct Fact {
  std::string name;
  std::string value;
};

/// What an operator reads of a candidate, the same words on the screen and on the command line:
/// what it is, its pose in the robot's frame (x forward, y left, z up; millimetres and degrees)
/// with deviations, sizes, and how the measurements support it. Deviations and support are known of
/// the best answer alone: an alternative is told without them.
std::vector<Fact> FactsOf(const Detection& detection, int candidate,
                          const Rigid<frame::Robot, frame::Base>& robot_from_base);

/// "lidar returns", or the title of a depth method.
std::string SourceTitle(const std::string& source);

}  // namespace foresight
