#include "hardware/link/client/remote_stand.h"

#include "core/base/contract.h"

namespace foresight {

int RemoteStand::At() const {
  const std::lock_guard lock(mutex_);
  return at_;
}

bool RemoteStand::Moving() const {
  const std::lock_guard lock(mutex_);
  return asked_.has_value();
}

std::string RemoteStand::Trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

void RemoteStand::MoveTo(int place) {
  FORESIGHT_EXPECTS(place >= -1 && place < static_cast<int>(stand_.places.size()),
                    "the stand goes to one of its places");
  link::Command command;
  command.mutable_move_stand()->set_place(place + 1);
  const std::lock_guard lock(mutex_);  // also while it is sent: Leave() waits for that
  trouble_ = send_ ? "" : "there is no link to the head any more";
  if (!send_) return;
  asked_ = place;
  send_(std::move(command), [self = weak_from_this(), place](const CommandEnd& end) {
    if (const auto stand = self.lock()) stand->End(place, end);
  });
}

void RemoteStand::End(int place, const CommandEnd& end) {
  const std::lock_guard lock(mutex_);
  if (end.kind == CommandEnd::Kind::kDone) {
    at_ = place;
    known_desk_s_ = end.outcome.desk_time_s();
  } else {
    trouble_ = end.error.message;
  }
  if (asked_ == place) asked_.reset();
}

void RemoteStand::Heard(int at, double desk_time_s) {
  const std::lock_guard lock(mutex_);
  if (asked_ || desk_time_s < known_desk_s_ || at < 0 ||
      at > static_cast<int>(stand_.places.size()))
    return;
  at_ = at - 1;
  known_desk_s_ = desk_time_s;
}

void RemoteStand::Forget() {
  const std::lock_guard lock(mutex_);
  known_desk_s_ = -1.0;
}

void RemoteStand::Leave() {
  const std::lock_guard lock(mutex_);
  send_ = nullptr;
  if (asked_) trouble_ = "there is no link to the head any more";
  asked_.reset();
}

}  // namespace foresight
