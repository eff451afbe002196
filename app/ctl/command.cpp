#include "app/ctl/command.h"

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

}  // namespace foresight
