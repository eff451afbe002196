#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "hardware/net/unique_fd.h"

namespace foresight {

/// A connected robot: lines out and lines in. Never waits, and keeps no more than one message and
/// one answer.
class RobotConnection {
 public:
  explicit RobotConnection(UniqueFd fd) : fd_(std::move(fd)) {}

  int fd() const { return fd_.Get(); }
  /// Part of the line has not been taken yet.
  bool HasMoreToWrite() const { return !out_.empty(); }

  /// Something has come, or the robot is gone.
  bool HasMoreToRead() const;

  /// Writes a line, with its line feed, as far as the robot takes it now. Fails with kDevice where
  /// it is gone.
  Status WriteLine(std::string line);
  /// Goes on with it.
  Status Write();
  /// The lines that have come whole, without their ends, of at most kLongestRobotLine_bytes; none
  /// where none has. Fails with kDevice where the robot is gone, kBadData where a line is longer.
  Result<std::vector<std::string>> ReadLines();

 private:
  UniqueFd fd_;
  std::string out_;
  std::string in_;
};

}  // namespace foresight
