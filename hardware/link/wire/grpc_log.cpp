#include "hardware/link/wire/grpc_log.h"

#include <grpc/support/log.h>

#include <chrono>
#include <mutex>

#include "core/base/log.h"
#include "core/base/printable.h"

namespace foresight {
namespace {

/// Lets so many lines pass in each second.
class LineLimit {
 public:
  /// The count of lines that were dropped in the second before, -1 where this one is to be dropped.
  int Pass(std::chrono::steady_clock::time_point now) {
    constexpr int kMost = 20;
    const std::lock_guard lock(mutex_);
    int dropped = 0;
    if (now - begin_ >= std::chrono::seconds(1)) {
      dropped = lines_ > kMost ? lines_ - kMost : 0;
      begin_ = now;
      lines_ = 0;
    }
    return ++lines_ > kMost ? -1 : dropped;
  }

 private:
  std::mutex mutex_;
  std::chrono::steady_clock::time_point begin_;
  int lines_ = 0;
};

void LogLine(gpr_log_func_args* line) {
  static LineLimit limit;
  if (line->severity != GPR_LOG_SEVERITY_ERROR) return;
  const int dropped = limit.Pass(std::chrono::steady_clock::now());
  if (dropped < 0) return;
  if (dropped > 0) LogWarning("gRPC: {} more lines in a second", dropped);
  LogWarning("gRPC: {}", Printable(line->message));
}

}  // namespace

void SendGrpcLogToOurs() {
  gpr_set_log_function(LogLine);
}

}  // namespace foresight
