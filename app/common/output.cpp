#include "app/common/output.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "core/base/printable.h"

namespace foresight {
namespace {

int g_output_errno = 0;  ///< of the first write to standard output that failed

void Print(const std::string& text) {
  errno = 0;
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written && g_output_errno == 0) g_output_errno = errno != 0 ? errno : EIO;
}

}  // namespace

void PrintJson(const nlohmann::ordered_json& json) {
  // A path may hold bytes that are no UTF-8; JSON may not.
  Print(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void PrintLine(const std::string& line) {
  Print(PrintableLines(line) + "\n");
}

Status CheckOutput() {
  if (std::fflush(stdout) != 0 && g_output_errno == 0) g_output_errno = errno;
  if (std::ferror(stdout) != 0 && g_output_errno == 0) g_output_errno = EIO;
  if (g_output_errno == 0) return {};
  return Fail(ErrorCode::kIo, "standard output: cannot write: {}", std::strerror(g_output_errno));
}

void PrintNoteLine(const std::string& line) {
  const std::string text = Printable(line) + "\n";
  (void)std::fwrite(text.data(), 1, text.size(), stderr);
}

void PrintProgress(const std::string& text, ProgressEnd end) {
  const std::string line = "\r" + Printable(text) + (end == ProgressEnd::kLast ? "\n" : "");
  (void)std::fwrite(line.data(), 1, line.size(), stderr);
}

void ErrorReporter::Report(const Error& error) const {
  PrintNote("{}: {}", program_, error.message);
  if (json_)
    PrintJson({{"error", {{"code", CodeName(error.code)}, {"message", Printable(error.message)}}}});
}

std::string CodeName(ErrorCode code) {
  std::string name = ToString(code);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

}  // namespace foresight
