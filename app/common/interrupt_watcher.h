#pragma once

#include <stop_token>
#include <thread>

namespace foresight {

/// SIGINT and SIGTERM ask a program to stop; it ends tidily and leaves nothing half written. One a
/// process.
class InterruptWatcher {
 public:
  /// Requests a stop of `source`, which lives longer.
  explicit InterruptWatcher(std::stop_source& source);

 private:
  std::jthread thread_;
};

}  // namespace foresight
