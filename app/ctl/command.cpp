#include "app/ctl/command.h"

#include <cmath>
#include <filesystem>

namespace foresight {

Status MakeOutputFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (std::error_code ignored; error || !std::filesystem::is_directory(folder, ignored))
    return Fail(ErrorCode::kIo, "{}: cannot make the folder: {}", folder,
                error ? error.message() : "a file of that name is in the way");
  return {};
}

nlohmann::ordered_json Finite(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace foresight
