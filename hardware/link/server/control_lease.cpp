#include "hardware/link/server/control_lease.h"

#include <fmt/format.h>

#include "core/base/contract.h"
#include "core/sensor/scan.h"

namespace foresight {

ControlLease::ControlLease(double lease_s) : lease_s_(lease_s) {
  FORESIGHT_EXPECTS(lease_s > 0.0, "a lease lasts for a while");
}

/// With the mutex held.
bool ControlLease::Held(double now_s) const {
  return !token_.empty() && now_s - renewed_s_ <= lease_s_;
}

ControlLease::Answer ControlLease::Take(const std::string& name, double now_s) {
  const std::lock_guard lock(mutex_);
  if (Held(now_s) && name != holder_ && name != successor_) {
    const double left_s = lease_s_ - (now_s - renewed_s_);
    return {false, "", holder_,
            fmt::format("{} has control: ask for it to be handed over, or wait; without a sign of "
                        "life it is free in {:.0f} s",
                        holder_, left_s)};
  }
  holder_ = name;
  successor_.clear();
  token_ = NewUuid();
  renewed_s_ = now_s;
  return {true, token_, holder_, ""};
}

ControlLease::Answer ControlLease::HandOver(const std::string& token, const std::string& successor,
                                            double now_s) {
  const std::lock_guard lock(mutex_);
  if (!Held(now_s) || token != token_)
    return {false, "", Held(now_s) ? holder_ : "", "only who has control can hand it over"};
  successor_ = successor;
  renewed_s_ = now_s;
  return {true, token_, holder_, ""};
}

ControlLease::Answer ControlLease::Release(const std::string& token, double now_s) {
  const std::lock_guard lock(mutex_);
  if (!Held(now_s) || token != token_)
    return {false, "", Held(now_s) ? holder_ : "", "only who has control can release it"};
  token_.clear();
  holder_.clear();
  successor_.clear();
  return {true, "", "", ""};
}

bool ControlLease::Renew(const std::string& token, double now_s) {
  const std::lock_guard lock(mutex_);
  if (!Held(now_s) || token != token_) return false;
  renewed_s_ = now_s;
  return true;
}

bool ControlLease::Holds(const std::string& token, double now_s) const {
  const std::lock_guard lock(mutex_);
  return Held(now_s) && token == token_;
}

std::string ControlLease::Holder(double now_s) const {
  const std::lock_guard lock(mutex_);
  return Held(now_s) ? holder_ : "";
}

}  // namespace foresight
