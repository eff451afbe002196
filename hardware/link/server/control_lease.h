#pragma once

#include <mutex>
#include <string>

namespace foresight {

/// Who may make the head act: one operator at a time, by a lease that signs of life renew. The
/// same name takes its own lease again at once (its program was started anew). Another name waits
/// until the holder releases it, hands it over by name, or was not heard for lease_s. Safe from any
/// thread; `now_s` is a clock that does not go back.
class ControlLease {
 public:
  /// Outlives the longest blackout of a known link, 30 s.
  static constexpr double kUsualLease_s = 60.0;

  struct Answer {
    bool granted = false;
    std::string token;   ///< random; empty unless granted
    std::string holder;  ///< who holds control now; empty = nobody
    std::string reason;  ///< why it was not granted, and what to do
  };

  explicit ControlLease(double lease_s = kUsualLease_s);

  Answer Take(const std::string& name, double now_s);
  /// From now on `successor` may take control, and nobody else before the lease is over.
  Answer HandOver(const std::string& token, const std::string& successor, double now_s);
  Answer Release(const std::string& token, double now_s);
  /// Whether `token` holds control, whose lease begins anew then.
  bool Renew(const std::string& token, double now_s);
  bool Holds(const std::string& token, double now_s) const;
  /// Empty = nobody.
  std::string Holder(double now_s) const;
  double lease_s() const { return lease_s_; }

 private:
  bool Held(double now_s) const;

  const double lease_s_;
  mutable std::mutex mutex_;
  std::string holder_;
  std::string token_;
  std::string successor_;
  double renewed_s_ = 0.0;
};

}  // namespace foresight
