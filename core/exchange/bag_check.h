#pragma once

// As bag_file.h: nothing of ours, for ROS's headers are no C++20.

#include <string>

namespace foresight {

/// Walks through a ROS 1 bag of version 2.0 and checks every length, offset and position that
/// ROS's library follows without a look: a wrong one ends the program there, by an assertion or by
/// a read beyond a buffer. Chunks are unpacked one by one (at most 1 GB).
/// Source: wiki.ros.org/Bags/Format/2.0.
/// @returns what is wrong and at which byte of the file; empty where the library may open it.
std::string CheckBag(const std::string& path);

}  // namespace foresight
