#include "hardware/link/robot/pose_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/sha256.h"
#include "core/mission/pose_json.h"

namespace foresight {
namespace {

using Reason = std::optional<std::string>;

std::string Short(const std::string& id) {
  return id.substr(0, 8);
}

/// What the operator made of it, and what the fit did.
Reason WhyNotByItself(const PoseMessage& message) {
  if (message.origin != PoseMessage::Origin::kLive)
    return "It comes from a review: the scene may have changed since. Scan and fit again.";
  if (message.decision == Decision::kRejected) return "It was rejected.";
  if (message.decision != Decision::kAccepted)
    return "Nobody has accepted it. Compare the outline with the image and accept it first.";
  if (!message.is_winner)
    return fmt::format("It is alternative {}, not the best answer.", message.candidate);
  if (message.verdict == VerdictLevel::kUnsure)
    return "Its verdict is UNSURE. Draw the region closer, or scan slower or from nearer.";
  if (!message.covariance) return "How exact it is is not known (no covariance). Fit it again.";
  return std::nullopt;
}

Reason WhyNotInThisRig(const PoseMessage& message, const ScanAtHead& scan, const HeadFacts& head) {
  for (const std::string& rig : {message.rig_id, scan.rig_id})
    if (rig != head.rig_id)
      return fmt::format("It is of rig {}, and the head has rig {} now. Scan and fit again.",
                         Short(rig), Short(head.rig_id));
  return std::nullopt;
}

Reason WhyNotOfThisScan(const PoseMessage& message, const ScanAtHead& scan, const HeadFacts& head,
                        const PoseGateOptions& options) {
  if ((message.simulated || scan.simulated) && !head.simulated)
    return "Its scan is simulated, and this head is not.";
  if (!scan.is_newest) return "It is from an earlier scan. Fit it again in the newest one.";
  if (const double age_s = std::max(message.age_s, scan.age_s); !(age_s <= options.oldest_s))
    return fmt::format("Its scan began {:.0f} s ago, more than {:.0f} s. Scan and fit again.",
                       age_s, options.oldest_s);
  return std::nullopt;
}

std::string DigestOf(PoseMessage message) {
  message.age_s = 0.0;  // a repeat is older
  return Sha256Hex(PoseMessageToJson(message));
}

RobotAnswer Refused(std::string reason) {
  return {RobotAnswer::Kind::kRefused, std::move(reason)};
}

}  // namespace

Status PoseGateOptions::Check() const {
  if (!(oldest_s > 0.0 && oldest_s <= 86'400.0))
    return Fail(ErrorCode::kInvalidOptions, "oldest_s is {}, not above 0 and at most 86400",
                oldest_s);
  if (remembered == 0 || remembered > 1'000'000)
    return Fail(ErrorCode::kInvalidOptions, "remembered is {}, not 1 to 1000000", remembered);
  return {};
}

Reason WhyNotToSend(const PoseMessage& message, const HeadFacts& head,
                    const PoseGateOptions& options) {
  if (const Status sound = CheckPoseMessage(message); !sound)
    return fmt::format("The message is damaged: {}.", sound.error().message);
  if (Reason reason = WhyNotByItself(message)) return reason;
  const std::optional<ScanAtHead> scan = head.find_scan(message.scan_uuid);
  if (!scan) return fmt::format("This head does not have its scan {}.", Short(message.scan_uuid));
  if (Reason reason = WhyNotInThisRig(message, *scan, head)) return reason;
  return WhyNotOfThisScan(message, *scan, head, options);
}

PoseGate::PoseGate(PoseGateOptions options, Send send)
    : options_(options), send_(std::move(send)) {}

PoseGate::Outcome PoseGate::Publish(std::string_view pose_json, const HeadFacts& head) {
  Result<PoseMessage> message = PoseMessageFromJson(pose_json);
  if (!message)
    return {Refused(fmt::format("The message is damaged: {}.", message.error().message)), false};
  const std::string id = message->Id();
  const std::string digest = DigestOf(*message);
  const std::lock_guard lock(mutex_);
  if (const auto known = known_.find(id); known != known_.end()) {
    if (known->second.digest == digest) return {known->second.answer, true};
    return {Refused(fmt::format("Another pose was sent as {} before. Send it again.", id)), false};
  }
  RobotAnswer answer;
  if (Reason reason = WhyNotToSend(*message, head, options_)) {
    answer = Refused(*std::move(reason));
  } else {
    if (const auto scan = head.find_scan(message->scan_uuid))
      message->age_s = std::max(message->age_s, scan->age_s);
    answer = send_(*message);
  }
  Remember(id, {digest, answer});
  return {answer, false};
}

void PoseGate::Remember(const std::string& id, Known known) {
  known_.emplace(id, std::move(known));
  order_.push_back(id);
  if (order_.size() <= options_.remembered) return;
  known_.erase(order_.front());
  order_.pop_front();
}

}  // namespace foresight
