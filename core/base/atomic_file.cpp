#include "core/base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>

namespace foresight {
namespace {

namespace fs = std::filesystem;

/// An open file of the system; -1 = none.
class FileHandle {
 public:
  explicit FileHandle(int handle) : handle_(handle) {}
  ~FileHandle() {
    if (handle_ >= 0) close(handle_);
  }
  FileHandle(const FileHandle&) = delete;
  FileHandle& operator=(const FileHandle&) = delete;

  int get() const { return handle_; }
  /// What a write may only report now, e.g. over a network.
  bool Close() { return close(std::exchange(handle_, -1)) == 0; }

 private:
  int handle_;
};

/// "a folder", "a device", ...: what stands where a file should.
const char* NameOf(fs::file_type type) {
  switch (type) {
    case fs::file_type::directory:
      return "a folder";
    case fs::file_type::character:
    case fs::file_type::block:
      return "a device";
    case fs::file_type::fifo:
      return "a pipe";
    case fs::file_type::socket:
      return "a socket";
    default:
      return "something else";
  }
}

fs::file_type TypeOf(const struct stat& status) {
  switch (status.st_mode & S_IFMT) {
    case S_IFREG:
      return fs::file_type::regular;
    case S_IFDIR:
      return fs::file_type::directory;
    case S_IFCHR:
      return fs::file_type::character;
    case S_IFBLK:
      return fs::file_type::block;
    case S_IFIFO:
      return fs::file_type::fifo;
    case S_IFSOCK:
      return fs::file_type::socket;
    default:
      return fs::file_type::unknown;
  }
}

/// The links of /proc/self/fd, where /dev/stdout points to, name open streams, not places.
bool IsOpenStream(const fs::path& path) {
  const std::string text = path.lexically_normal().string();
  return text.starts_with("/proc/") && text.find("/fd/") != std::string::npos;
}

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

/// Some file systems have no fsync; that is not the writer's failure.
bool ReachesDisk(int handle) {
  return fsync(handle) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

/// Writes the neighbour of the target whole. False leaves the reason in errno.
bool WriteNeighbour(const fs::path& neighbour, const fs::path& target, std::string_view bytes) {
  FileHandle file(
      open(neighbour.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (file.get() < 0) return false;
  struct stat replaced {};
  if (stat(target.c_str(), &replaced) == 0 && fchmod(file.get(), replaced.st_mode & 07777) != 0)
    return false;
  return WriteAll(file.get(), bytes) && ReachesDisk(file.get()) && file.Close();
}

Status Sync(const fs::path& path, int flags) {
  const FileHandle file(open(path.c_str(), O_RDONLY | O_CLOEXEC | flags));
  if (file.get() >= 0 && ReachesDisk(file.get())) return {};
  return SystemFailure(path, "cannot make sure that it is on the disk");
}

/// The bytes of an open file from where it stands, at most one more than `limit`.
bool ReadAll(int handle, std::size_t limit, std::string& bytes) {
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  std::size_t size = 0;
  for (;;) {
    // The size was known when the file was opened; only a file that grows meanwhile has more.
    if (bytes.size() == size) bytes.resize(std::min(limit + 1, size + kPiece));
    const ssize_t count = read(handle, bytes.data() + size, bytes.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    size += static_cast<std::size_t>(count);
    if (count == 0 || size > limit) break;
  }
  bytes.resize(size);
  return true;
}

}  // namespace

Result<fs::path> ResolveOutput(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as the kernel
  fs::path target = path;
  std::error_code error;
  for (int i = 0; i <= kMostLinks; ++i) {
    if (IsOpenStream(fs::absolute(target, error)))
      return Fail(ErrorCode::kIo,
                  "{}: is an open stream, not a file: name a file, which is written whole or not "
                  "at all",
                  path.string());
    const fs::file_status status = fs::symlink_status(target, error);
    if (status.type() == fs::file_type::symlink) {
      const fs::path next = fs::read_symlink(target, error);
      if (error)
        return Fail(ErrorCode::kIo, "{}: cannot follow the link: {}", path.string(),
                    error.message());
      target = next.is_absolute() ? next : target.parent_path() / next;
      continue;
    }
    if (!fs::exists(status) || fs::is_regular_file(status)) return target;
    return Fail(ErrorCode::kIo, "{}: is {}, not a file that could be replaced: name a file",
                path.string(), NameOf(status.type()));
  }
  return Fail(ErrorCode::kIo, "{}: its symbolic links lead in a circle", path.string());
}

Status SyncFile(const fs::path& path) {
  return Sync(path, 0);
}

Status SyncFolderOf(const fs::path& path) {
  const fs::path folder = path.parent_path();
  return Sync(folder.empty() ? "." : folder, O_DIRECTORY);
}

Status WriteFileAtomically(const fs::path& path, std::string_view bytes) {
  static std::atomic<int> counter{0};
  FORESIGHT_TRY(const fs::path target, ResolveOutput(path));
  const fs::path neighbour =
      target.string() + fmt::format(".{}-{}.part", getpid(), counter.fetch_add(1));
  if (!WriteNeighbour(neighbour, target, bytes)) {
    const auto failure = SystemFailure(path, "cannot write");
    unlink(neighbour.c_str());
    return failure;
  }
  if (rename(neighbour.c_str(), target.c_str()) != 0) {
    const auto failure = SystemFailure(path, "cannot replace");
    unlink(neighbour.c_str());
    return failure;
  }
  return SyncFolderOf(target);
}

Status AppendToFile(const fs::path& path, std::string_view bytes) {
  FORESIGHT_TRY(const fs::path target, ResolveOutput(path));
  FileHandle file(open(target.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (file.get() < 0 || !WriteAll(file.get(), bytes) || !file.Close())
    return SystemFailure(path, "cannot write");
  return {};
}

Result<std::string> ReadFile(const fs::path& path, std::size_t limit_bytes) {
  // A pipe without a writer would keep an ordinary open waiting.
  const FileHandle file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (file.get() < 0) return SystemFailure(path, "cannot open");
  struct stat status {};
  if (fstat(file.get(), &status) != 0) return SystemFailure(path, "cannot read");
  if (!S_ISREG(status.st_mode))
    return Fail(ErrorCode::kIo, "{}: is {}, not a file", path.string(), NameOf(TypeOf(status)));
  const auto too_large = [&](std::size_t size) {
    return Fail(ErrorCode::kBadData, "{}: {} bytes, more than the {} this reads", path.string(),
                size, limit_bytes);
  };
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > limit_bytes) return too_large(size);
  try {
    std::string bytes(size + 1, '\0');
    if (!ReadAll(file.get(), limit_bytes, bytes)) return SystemFailure(path, "cannot read");
    if (bytes.size() > limit_bytes) return too_large(bytes.size());
    return bytes;
  } catch (const std::bad_alloc&) {
    return Fail(ErrorCode::kIo, "{}: its {} bytes do not fit into memory", path.string(), size);
  }
}

}  // namespace foresight
