#pragma once

#include <optional>
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
/// @param up_of_cloud of an answer in a cloud whose frame has another way up than z: directions are
/// told in numbers of that frame, and how far up by this; length 1
std::vector<Fact> FactsOf(const Detection& detection, int candidate,
                          const Rigid<frame::Robot, frame::Base>& robot_from_base,
                          const std::optional<Eigen::Vector3d>& up_of_cloud = std::nullopt);

/// "lidar returns", or the title of a depth method.
std::string SourceTitle(const std::string& source);

}  // namespace foresight
