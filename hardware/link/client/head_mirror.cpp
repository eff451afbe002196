#include "hardware/link/client/head_mirror.h"

namespace foresight {
namespace {

/// A head says something once a second; after this the operator is told that it does not.
constexpr double kQuiet_s = 3.0;

}  // namespace

Status HeadMirror::Take(const link::Status& status, double desk_time_s) {
  const std::lock_guard lock(mutex_);
  heard_s_ = LinkSession::Now();
  trouble_.clear();
  if (desk_time_s < desk_time_s_) return {};
  FORESIGHT_TRY(said_, FromMessage(status, said_.health));
  desk_time_s_ = desk_time_s;
  scan_id_ = status.scan_id();
  if (said_.message != message_then_) own_message_.clear();
  return {};
}

void HeadMirror::Forget() {
  const std::lock_guard lock(mutex_);
  desk_time_s_ = -1.0;
}

void HeadMirror::Lost(const Error& error) {
  const std::lock_guard lock(mutex_);
  trouble_ = error.message;
}

void HeadMirror::Ask(HeadState state, const std::string& message) {
  const std::lock_guard lock(mutex_);
  asked_ = state;
  asked_message_ = message;
  own_message_.clear();
}

void HeadMirror::Answered() {
  const std::lock_guard lock(mutex_);
  asked_.reset();
}

void HeadMirror::Tell(const std::string& message) {
  const std::lock_guard lock(mutex_);
  own_message_ = message;
  message_then_ = said_.message;
}

HeadStatus HeadMirror::Now() const {
  const std::lock_guard lock(mutex_);
  HeadStatus status = said_;
  if (!own_message_.empty()) status.message = own_message_;
  if (asked_) {
    status.state = *asked_;
    status.message = asked_message_;
  }
  const double age_s = LinkSession::Now() - heard_s_;
  if (age_s <= kQuiet_s) return status;
  // What this end has to tell is no old word, and comes first: a strip cuts the end off.
  if (!asked_ && !own_message_.empty())
    status.message = fmt::format("{}; no word from the head for {:.0f} s", own_message_, age_s);
  else
    status.message = fmt::format("no word from the head for {:.0f} s{}", age_s,
                                 status.message.empty() ? "" : "; before: " + status.message);
  return status;
}

std::string HeadMirror::ScanOnHead() const {
  const std::lock_guard lock(mutex_);
  return scan_id_;
}

double HeadMirror::Age() const {
  const std::lock_guard lock(mutex_);
  return LinkSession::Now() - heard_s_;
}

bool HeadMirror::Connected() const {
  const std::lock_guard lock(mutex_);
  return desk_time_s_ >= 0.0 && LinkSession::Now() - heard_s_ <= kQuiet_s;
}

std::string HeadMirror::Trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

}  // namespace foresight
