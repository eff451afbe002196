#include "core/mission/mission_records.h"

#include <utility>

namespace foresight {
namespace {

using Action = DetectionEvent::Action;
constexpr std::pair<Action, const char*> kActions[] = {
    {Action::kAccepted, "accepted"}, {Action::kRejected, "rejected"},
    {Action::kReopened, "reopened"}, {Action::kRenamed, "renamed"},
    {Action::kDeleted, "deleted"},   {Action::kRestored, "restored"},
    {Action::kSent, "sent"}};

}  // namespace

const char* ToString(Decision decision) {
  switch (decision) {
    case Decision::kAccepted:
      return "accepted";
    case Decision::kRejected:
      return "rejected";
    default:
      return "open";
  }
}

const char* ToString(Action action) {
  for (const auto& [known, name] : kActions)
    if (known == action) return name;
  return "unknown";
}

Result<Action> DetectionActionFromString(const std::string& text) {
  for (const auto& [action, name] : kActions)
    if (text == name) return action;
  return Fail(ErrorCode::kBadData, "'{}' is no action on a detection", text);
}

}  // namespace foresight
