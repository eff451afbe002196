#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace foresight {

/// Keeps strangers from filling a log: a line that was let through is let through again after a
/// minute, then with how often it was held back, and of all lines together 20 in a second. Safe
/// from any thread.
class LineLimit {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// What to log now; nothing where the line is held back.
  std::optional<std::string> Pass(const std::string& line, Time now);

  /// Forgets what it let through.
  void Reset();

 private:
  struct Repeats {
    Time since;
    int held_back = 0;
  };

  std::mutex mutex_;
  std::map<std::string, Repeats> lines_;
  Time second_;
  int in_second_ = 0;
};

}  // namespace foresight
