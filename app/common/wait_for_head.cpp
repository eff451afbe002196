#include "app/common/wait_for_head.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "app/common/interrupt_watcher.h"
#include "hardware/api/head_link.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kPoll{5};
constexpr std::chrono::seconds kPatience{5};  ///< with a link that does not come back

}  // namespace

HeadStatus WaitWhile(SensorHead& head, std::initializer_list<HeadState> states,
                     const RunContext& context, const std::function<void()>& meanwhile) {
  bool aborted = false;
  auto heard = std::chrono::steady_clock::now();
  for (;;) {
    head.OperatorSeen();
    const HeadStatus status = head.Status();
    if (std::find(states.begin(), states.end(), status.state) == states.end()) return status;
    if (context.Cancelled() && !aborted) {
      aborted = true;
      const std::string reason = InterruptReason();
      head.EndScan(reason.empty() ? "the scan was cancelled" : reason);
      if (status.state == HeadState::kHoming) head.StopMotor();
    }
    // Over a link that is lost nobody hears that, and what is shown is old.
    const HeadLink* link = head.Link();
    const auto now = std::chrono::steady_clock::now();
    if (!aborted || !link || link->Health().connected) heard = now;
    if (now - heard > kPatience) return status;
    if (meanwhile) meanwhile();
    std::this_thread::sleep_for(kPoll);
  }
}

bool WaitForEnd(SensorHead& head, const std::function<bool()>& ended, const RunContext& context,
                const std::function<void()>& meanwhile) {
  constexpr std::chrono::seconds kLast{10};
  std::optional<std::chrono::steady_clock::time_point> cancelled;
  while (!ended()) {
    head.OperatorSeen();
    const auto now = std::chrono::steady_clock::now();
    if (context.Cancelled() && !cancelled) cancelled = now;
    if (cancelled && now - *cancelled > kLast) return false;
    if (meanwhile) meanwhile();
    std::this_thread::sleep_for(kPoll);
  }
  return true;
}

Status HomeAndWait(SensorHead& head, const RunContext& context) {
  head.OperatorSeen();
  FORESIGHT_CHECK(head.Home());
  const HeadStatus status = WaitWhile(head, {HeadState::kHoming}, context);
  if (status.state != HeadState::kReady)
    return Fail(ErrorCode::kDevice, "the head is not ready after homing: {}{}{}", InterruptReason(),
                InterruptReason().empty() ? "" : "; ", status.message);
  return {};
}

}  // namespace foresight
