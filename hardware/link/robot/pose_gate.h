#pragma once

#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "core/mission/pose_message.h"
#include "hardware/link/robot/robot_answer.h"

namespace foresight {

struct PoseGateOptions {
  double oldest_s = 600.0;        ///< a pose from a scan that began longer ago is refused
  std::size_t remembered = 1000;  ///< answers that are kept for repeats
  Status Check() const;
};

/// What the head itself knows of a scan.
struct ScanAtHead {
  std::string rig_id;
  bool simulated = false;
  double age_s = 0.0;     ///< since its begin, by the head's monotonic clock
  bool is_newest = true;  ///< no scan that ended later is there
};

/// What the head knows when a pose comes.
struct HeadFacts {
  std::string rig_id;      ///< of the rig in force
  bool simulated = false;  ///< the head is
  std::function<std::optional<ScanAtHead>(const std::string& uuid)> find_scan;  ///< none = not here
};

/// Why this pose may not go to the robot, in a sentence for the operator; none = it may. Judges by
/// what the head knows, and by what the message says of itself.
std::optional<std::string> WhyNotToSend(const PoseMessage& message, const HeadFacts& head,
                                        const PoseGateOptions& options);

/// The head's door to the robot: judges a pose, hands it on, and remembers the answer, so that a
/// repeat of a message is answered again and not carried out again. Safe from any thread; one pose
/// at a time.
class PoseGate {
 public:
  using Send = std::function<RobotAnswer(const PoseMessage&)>;
  struct Outcome {
    RobotAnswer answer;
    bool repeated = false;  ///< `answer` is that of the first time
  };

  /// `send` takes a message to the robot, e.g. RobotSocket::Send.
  PoseGate(PoseGateOptions options, Send send);

  /// `pose_json` as it came over the link. What is sent on has the head's own age, where that is
  /// greater.
  Outcome Publish(std::string_view pose_json, const HeadFacts& head);

 private:
  struct Known {
    std::string digest;  ///< of the message without its age
    RobotAnswer answer;
  };
  void Remember(const std::string& id, Known known);

  PoseGateOptions options_;
  Send send_;
  std::mutex mutex_;
  std::map<std::string, Known> known_;  ///< by the message's id
  std::deque<std::string> order_;       ///< of known_, oldest first
};

}  // namespace foresight
