#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>

namespace foresight {

/// How fast chunks come, and how many bytes a head may send ahead of what was acknowledged. The
/// credit grows towards what the path carries in a quarter of a second, twofold or fourfold at a
/// time, and halves where it takes more than two: what is sent ahead is what a change of mind waits
/// for.
class TransferRate {
 public:
  static constexpr std::int64_t kLeastCredit = 4 * 1024;
  static constexpr std::int64_t kWideCredit = std::int64_t{1} << 20;
  static constexpr std::int64_t kMostCredit = std::int64_t{16} << 20;
  static constexpr double kWindow_s = 2.0;
  static constexpr std::int64_t kBacklog_bytes = 8 * 1024;

  /// `left` = what the head had still to send then.
  void Received(std::int64_t bytes, std::int64_t left, double now_s) {
    Drop(now_s);
    if (left < kBacklog_bytes) backlog_since_s_ = now_s;
    if (bytes == 0) return;
    recent_.push_back({now_s, bytes});
    // A blackout before the first bytes says nothing of the path.
    if (since_change_ == 0) changed_s_ = now_s;
    since_change_ += bytes;
    const double took_s = now_s - changed_s_;
    // A head that had less to send than it might says nothing of the path.
    const bool slow = took_s > 2.0 && (since_change_ >= credit_ || backlog_since_s_ <= changed_s_);
    if (since_change_ < credit_ && !slow) return;
    if (took_s < 0.25) credit_ = std::min((took_s < 0.0625 ? 4 : 2) * credit_, kMostCredit);
    if (slow) credit_ = std::max(credit_ / 2, kLeastCredit);
    since_change_ = 0;
  }
  /// A stream began: its rate is not known yet. The credit stays, for a burst of a second has no
  /// time to learn it again; a path whose round trip is short begins with a large one.
  void Begin(double now_s, bool is_wide = false) {
    if (is_wide) credit_ = std::max(credit_, kWideCredit);
    since_change_ = 0;
    backlog_since_s_ = now_s;
    recent_.clear();
  }
  std::int64_t credit() const { return credit_; }
  /// Over the last two seconds.
  double BytesPerS(double now_s) const {
    std::int64_t bytes = 0;
    for (const Reading& reading : recent_)
      if (now_s - reading.time_s <= kWindow_s) bytes += reading.bytes;
    return static_cast<double>(bytes) / kWindow_s;
  }
  /// The path's own rate, known where the head had more to send for two seconds.
  std::optional<double> PathBytesPerS(double now_s) const {
    if (now_s - backlog_since_s_ < kWindow_s) return std::nullopt;
    return BytesPerS(now_s);
  }

 private:
  struct Reading {
    double time_s = 0.0;
    std::int64_t bytes = 0;
  };
  void Drop(double now_s) {
    while (!recent_.empty() && now_s - recent_.front().time_s > kWindow_s) recent_.pop_front();
  }

  std::deque<Reading> recent_;
  std::int64_t credit_ = kLeastCredit;
  std::int64_t since_change_ = 0;
  double changed_s_ = 0.0;
  double backlog_since_s_ = 0.0;
};

}  // namespace foresight
