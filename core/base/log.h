#pragma once

#include <fmt/format.h>

#include <functional>
#include <string_view>

namespace foresight {

enum class LogLevel { kDebug, kInfo, kWarning, kError };

/// Writes one line to the log (standard error, and the listener if one is set). Safe from any
/// thread.
void Log(LogLevel level, std::string_view message);

/// Lines below this level are dropped. Default kInfo.
void SetLogLevel(LogLevel level);

/// Also hands every line to `listener`, on the thread that logs; an empty function removes it.
void SetLogListener(std::function<void(LogLevel, std::string_view)> listener);

template <class... Args>
void LogInfo(fmt::format_string<Args...> format, Args&&... args) {
  Log(LogLevel::kInfo, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void LogWarning(fmt::format_string<Args...> format, Args&&... args) {
  Log(LogLevel::kWarning, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void LogError(fmt::format_string<Args...> format, Args&&... args) {
  Log(LogLevel::kError, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace foresight
