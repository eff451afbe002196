#include "core/base/log.h"

#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <mutex>
#include <system_error>

#include "core/base/log_file.h"
#include "core/base/printable.h"

namespace foresight {
namespace {

spdlog::level::level_enum ToSpdlog(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return spdlog::level::debug;
    case LogLevel::kInfo:
      return spdlog::level::info;
    case LogLevel::kWarning:
      return spdlog::level::warn;
    case LogLevel::kError:
      return spdlog::level::err;
  }
  return spdlog::level::info;
}

spdlog::logger& Logger() {
  static const auto logger = [] {
    auto created = std::make_shared<spdlog::logger>(
        "foresight", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    created->set_pattern("%H:%M:%S.%e %^%l%$ %v");
    return created;
  }();
  return *logger;
}

struct Listener {
  std::mutex mutex;
  std::function<void(LogLevel, std::string_view)> function;
};

Listener& TheListener() {
  static Listener listener;
  return listener;
}

}  // namespace

void Log(LogLevel level, std::string_view message) {
  Logger().log(ToSpdlog(level), Printable(message));
  const std::lock_guard lock(TheListener().mutex);
  if (TheListener().function) TheListener().function(level, message);
}

void SetLogLevel(LogLevel level) {
  Logger().set_level(ToSpdlog(level));
}

void SetLogListener(std::function<void(LogLevel, std::string_view)> listener) {
  const std::lock_guard lock(TheListener().mutex);
  TheListener().function = std::move(listener);
}

std::filesystem::path LogFileOf(const std::string& program) {
  const auto folder = []() -> std::filesystem::path {
    const char* state = std::getenv("XDG_STATE_HOME");
    if (state != nullptr && *state != '\0') return state;
    const char* home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') return std::filesystem::path(home) / ".local" / "state";
    return {};
  }();
  return folder.empty() ? folder : folder / "foresight" / (program + ".log");
}

Status KeepLogFile(const std::filesystem::path& file) {
  constexpr std::size_t kBytes = 1 << 20, kOlderFiles = 2;
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  try {
    const auto sink =
        std::make_shared<spdlog::sinks::rotating_file_sink_mt>(file.string(), kBytes, kOlderFiles);
    sink->set_pattern("%Y-%m-%dT%H:%M:%S.%e %l %v");
    Logger().sinks().push_back(sink);
    Logger().flush_on(spdlog::level::info);
  } catch (const spdlog::spdlog_ex& failure) {
    return Fail(ErrorCode::kIo, "{}: {}", file.string(), failure.what());
  }
  return {};
}

}  // namespace foresight
