#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/base/result.h"

namespace foresight {

/// Results go to standard output, all of a result in one piece; control characters of its texts are
/// escaped (core/base/printable.h). What cannot be written is remembered for CheckOutput().
void PrintJson(const nlohmann::ordered_json& json);
/// One line, or several with line feeds between them.
void PrintLine(const std::string& line);

/// Whether everything that was printed so far has been written. Fails with kIo, naming the reason:
/// a disk that is full, a reader that is gone, a standard output that was closed.
Status CheckOutput();

/// One line on standard error, escaped; nobody is told where that cannot be written.
void PrintNoteLine(const std::string& line);
template <class... Args>
void PrintNote(fmt::format_string<Args...> format, Args&&... args) {
  PrintNoteLine(fmt::format(format, std::forward<Args>(args)...));
}

/// How far work has come, on standard error: "\r", the text, and a line feed where it is the last.
enum class ProgressEnd { kMore, kLast };
void PrintProgress(const std::string& text, ProgressEnd end);

/// What a program says when it fails: one line on standard error that begins with its name and, for
/// who asked for JSON, {"error": {"code", "message"}} on standard output.
class ErrorReporter {
 public:
  ErrorReporter(std::string program, bool json) : program_(std::move(program)), json_(json) {}

  void Report(const Error& error) const;

 private:
  std::string program_;
  bool json_;
};

/// An error's code in JSON: "bad_data".
std::string CodeName(ErrorCode code);

}  // namespace foresight
