#pragma once

#include <stop_token>
#include <string>
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

/// "the program was told to end (SIGTERM)"; empty when it was not.
std::string InterruptReason();

}  // namespace foresight
