#include "hardware/link/wire/grpc_log.h"

#include <grpc/support/log.h>

#include <string_view>

#include "core/base/log.h"
#include "core/base/printable.h"
#include "hardware/link/wire/line_limit.h"

namespace foresight {
namespace {

LineLimit& Limit() {
  static LineLimit limit;
  return limit;
}

/// An attempt to connect that was given up, because another one got through: no error of anybody.
bool IsOfAnAttempt(std::string_view message) {
  return message.find("cancel_check_peer error") != std::string_view::npos;
}

void LogLine(gpr_log_func_args* line) {
  if (line->severity != GPR_LOG_SEVERITY_ERROR || IsOfAnAttempt(line->message)) return;
  if (const auto text = Limit().Pass(line->message, std::chrono::steady_clock::now()))
    LogWarning("gRPC: {}", Printable(*text));
}

}  // namespace

void SendGrpcLogToOurs() {
  Limit().Reset();
  gpr_set_log_function(LogLine);
}

}  // namespace foresight
