#pragma once

#include "hardware/api/sensor_head.h"
#include "sensor_head.pb.h"

namespace foresight {

/// Raised when a message or an item of a scan changes its meaning; both sides must have the same.
inline constexpr int kLinkProtocol = 1;
/// Each call but Identify carries the station's version under this key.
inline constexpr const char* kProtocolKey = "foresight-protocol";

/// The protocol's messages <-> values. What comes from the other side is checked: the readers fail
/// with kBadData, naming the member.

link::State ToMessage(HeadState state);
/// nullopt where a newer head has a state that this program does not know.
std::optional<HeadState> FromMessage(link::State state);

/// Health included only where `with_health`.
link::Status ToMessage(const HeadStatus& status, bool with_health);
/// `before` has the health where the message has none.
Result<HeadStatus> FromMessage(const link::Status& message, const HeadHealth& before);

link::Outcome ToMessage(const Status& status);
Status FromMessage(const link::Outcome& outcome);

link::HeadMotion ToMessage(const HeadMotion& motion);
Result<HeadMotion> FromMessage(const link::HeadMotion& message);

link::LiveViewRequest ToMessage(const LiveViewOptions& options);
Result<LiveViewOptions> FromMessage(const link::LiveViewRequest& message);

link::StartStops ToMessage(const StopPlan& plan);
Result<StopPlan> FromMessage(const link::StartStops& message);

/// Whether the head moves by it: what a stop voids.
bool Moves(const link::Command& command);

}  // namespace foresight
