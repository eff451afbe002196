#include "core/base/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <mutex>

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

}  // namespace foresight
