#pragma once

#include <chrono>
#include <filesystem>
#include <memory>

#include "core/mission/pose_message.h"
#include "hardware/link/robot/robot_answer.h"

namespace foresight {

struct RobotSocketOptions {
  std::filesystem::path path;  ///< of the socket; empty = DefaultRobotSocketPath()
  std::chrono::milliseconds answer_timeout{2000};
  Status Check() const;
};

/// $XDG_RUNTIME_DIR/foresight/robot.sock. Fails with kInvalidOptions where the variable is not set.
Result<std::filesystem::path> DefaultRobotSocketPath();

/// The local socket that the robot's software connects to (docs/protocols.md, "To the robot"). One
/// robot at a time: the first one stays, because a program that connects later, or by mistake, must
/// not take poses away from the robot that acts on them; a robot that died leaves its place at
/// once, for the system closes its end. Whatever a robot sends or leaves out, memory and waiting
/// are bounded.
class RobotSocket {
 public:
  /// Takes over the file that a crashed head left, and makes the folder. Fails with kIo where
  /// another head listens there, or something else has the name.
  static Result<std::unique_ptr<RobotSocket>> Listen(const RobotSocketOptions& options);
  /// Ends a Send that waits, closes the connection and removes the file.
  ~RobotSocket();
  RobotSocket(const RobotSocket&) = delete;
  RobotSocket& operator=(const RobotSocket&) = delete;

  const std::filesystem::path& path() const;
  bool RobotIsThere() const;

  /// Writes the message and waits for the robot's answer to it, answer_timeout at most. Safe from
  /// any thread; one message at a time.
  RobotAnswer Send(const PoseMessage& message);

 private:
  struct Impl;
  explicit RobotSocket(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foresight
