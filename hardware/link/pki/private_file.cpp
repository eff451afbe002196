#include "hardware/link/pki/private_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/atomic_file.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> SystemFailure(const fs::path& path, const char* what) {
  return Fail(ErrorCode::kIo, "{}: {}: {}", path.string(), what, std::strerror(errno));
}

bool WriteAll(int handle, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(handle, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

Status WritePrivateFile(const fs::path& path, std::string_view bytes) {
  // core's WriteFileAtomically() makes its neighbour with the permissions of any other file.
  std::string neighbour = path.string() + ".XXXXXX";
  const int handle = mkostemp(neighbour.data(), O_CLOEXEC);  // 0600
  if (handle < 0) return SystemFailure(path, "cannot write");
  bool written = WriteAll(handle, bytes) && fsync(handle) == 0;
  written = close(handle) == 0 && written;
  if (!written || rename(neighbour.c_str(), path.c_str()) != 0) {
    const auto failure = SystemFailure(path, "cannot write");
    unlink(neighbour.c_str());
    return failure;
  }
  return SyncFolderOf(path);
}

Status CheckIsPrivate(const fs::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return SystemFailure(path, "cannot open");
  const unsigned mode = status.st_mode & 07777;
  if ((mode & 077) == 0) return {};
  return Fail(ErrorCode::kBadData,
              "{}: others may read this private key (permissions {:03o}); run chmod 600 on it",
              path.string(), mode);
}

}  // namespace foresight
