#include "hardware/head/disk_reserve.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace foresight {

Status DiskReserve::Take(const std::filesystem::path& folder, std::size_t bytes) {
  if (file_ >= 0) return {};
  const std::filesystem::path where = folder.empty() ? std::filesystem::path(".") : folder;
  file_ = open(where.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file_ < 0) return {};
  // fallocate and not posix_fallocate: the latter writes byte by byte where it is not supported.
  if (fallocate(file_, 0, 0, static_cast<off_t>(bytes)) == 0) return {};
  const bool full = errno == ENOSPC || errno == EDQUOT;
  Release();
  if (!full) return {};
  return Fail(ErrorCode::kIo,
              "{}: the disk is full ({} MB must be free to record; make room there)",
              where.string(), bytes >> 20);
}

void DiskReserve::Release() {
  if (file_ >= 0) close(file_);
  file_ = -1;
}

}  // namespace foresight
