// Messages of the link that one side reads as values: the first byte says of which kind, the rest
// is the message on the wire.
#include <cmath>
#include <cstdint>

#include "hardware/link/protocol/messages.h"
#include "hardware/link/protocol/stop_messages.h"
#include "tests/fuzz/require.h"

namespace foresight {
namespace {

/// What was read is the same after it was sent once more.
template <class Message>
void TryAgain(const Message& message) {
  const auto value = FromMessage(message);
  if (!value) return Require(!value.error().message.empty(), "an error says what");
  Require(FromMessage(ToMessage(*value)).has_value(), "what was read can be sent and read again");
}

void TryStatus(const link::Status& message) {
  const auto status = FromMessage(message, HeadHealth());
  if (!status) return Require(!status.error().message.empty(), "an error says what");
  Require(std::isfinite(status->time_s) && std::isfinite(status->angle_rad), "values can be shown");
  Require(FromMessage(ToMessage(*status, true), HeadHealth()).has_value(),
          "a status can be sent and read again");
}

void TryCapture(const link::StopEvent& event) {
  const auto capture = CaptureFromMessage(event);
  if (!capture) return Require(!capture.error().message.empty(), "an error says what");
  Require(ToMessage(event.number(), *capture).has_value(), "what was captured can be sent again");
}

void TryOutcome(const link::Outcome& outcome) {
  Require(FromMessage(outcome).has_value() == (outcome.error() == link::NONE),
          "what is not done is an error, also of a kind that is not known");
}

template <class Message>
bool Parse(const std::uint8_t* bytes, std::size_t size, Message& message) {
  return message.ParseFromArray(bytes, static_cast<int>(size));
}

void Try(int kind, const std::uint8_t* bytes, std::size_t size) {
  const auto with = [&](auto message, const auto& attempt) {
    if (Parse(bytes, size, message)) attempt(message);
  };
  switch (kind % 6) {
    case 0:
      return with(link::Status(), TryStatus);
    case 1:
      return with(link::Outcome(), TryOutcome);
    case 2:
      return with(link::HeadMotion(), TryAgain<link::HeadMotion>);
    case 3:
      return with(link::LiveViewRequest(), TryAgain<link::LiveViewRequest>);
    case 4:
      return with(link::StartStops(), TryAgain<link::StartStops>);
    default:
      return with(link::StopEvent(), TryCapture);
  }
}

}  // namespace
}  // namespace foresight

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size > 0) foresight::Try(bytes[0], bytes + 1, size - 1);
  return 0;
}
