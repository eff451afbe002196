#include "core/base/publish_file.h"

#include <system_error>

#include "core/base/atomic_file.h"

namespace foresight {

Status PublishFile(const std::filesystem::path& part, const std::filesystem::path& target) {
  Status status = SyncFile(part);
  std::error_code error;
  if (status) std::filesystem::rename(part, target, error);
  if (status && error)
    status = Fail(ErrorCode::kIo, "{}: cannot replace: {}", target.string(), error.message());
  if (status) return SyncFolderOf(target);
  std::filesystem::remove(part, error);
  return status;
}

}  // namespace foresight
