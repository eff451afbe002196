#include "app/ctl/command.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace foresight {

Status MakeOutputFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    return Fail(ErrorCode::kIo, "{}: cannot make the folder: {}", folder,
                error ? error.message() : "a file of that name is in the way");
  return {};
}

void PrintJson(const nlohmann::ordered_json& json) {
  PrintLine(json.dump(2));
}

void PrintLine(const std::string& line) {
  std::fputs((line + "\n").c_str(), stdout);
  std::fflush(stdout);
}

nlohmann::ordered_json Finite(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace foresight
