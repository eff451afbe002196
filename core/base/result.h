#pragma once

#include <fmt/format.h>

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace foresight {

/// What kind of failure of the world this is. Programs turn it into an exit code, panels into an
/// icon.
enum class ErrorCode {
  kInvalidOptions,  ///< an option is out of its range; the message names the member
  kInvalidInput,    ///< inputs do not fit each other (sizes, frames, calibration)
  kBadData,        ///< a file's or a device's bytes are damaged, truncated or of an unknown version
  kIo,             ///< a file could not be opened, read or written
  kDevice,         ///< a device refused, vanished or timed out
  kState,          ///< the request does not fit the present state (e.g. scan while homing)
  kTooFewPoints,   ///< not enough measurements for an answer
  kNoConvergence,  ///< a solver did not reach an answer
  kCancelled,      ///< the caller asked to stop
};

/// Short lower-case name, e.g. "bad data".
const char* ToString(ErrorCode code);

/// A failure of the world: what happened, where, and the value, in one line without a final full
/// stop.
struct Error {
  ErrorCode code;
  std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;
using Status = Result<void>;

/// Builds the error side of a Result: `return Fail(ErrorCode::kIo, "{}: cannot open", path);`
template <class... Args>
tl::unexpected<Error> Fail(ErrorCode code, fmt::format_string<Args...> format, Args&&... args) {
  return tl::unexpected<Error>(Error{code, fmt::format(format, std::forward<Args>(args)...)});
}

}  // namespace foresight

#define FORESIGHT_CONCAT_INNER(a, b) a##b
#define FORESIGHT_CONCAT(a, b) FORESIGHT_CONCAT_INNER(a, b)

/// Evaluates a Result; on failure returns its error from the enclosing function, else declares
/// `variable`.
#define FORESIGHT_TRY(variable, expression)                                     \
  auto FORESIGHT_CONCAT(try_, __LINE__) = (expression);                         \
  if (!FORESIGHT_CONCAT(try_, __LINE__))                                        \
    return tl::unexpected(std::move(FORESIGHT_CONCAT(try_, __LINE__)).error()); \
  variable = std::move(*FORESIGHT_CONCAT(try_, __LINE__))

/// Same for a Status.
#define FORESIGHT_CHECK(expression)                           \
  do {                                                        \
    if (auto check_status = (expression); !check_status)      \
      return tl::unexpected(std::move(check_status).error()); \
  } while (false)
