#include "core/mission/file_handle.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace foresight {
namespace {

/// Behind the bytes that SQLite locks (512 from 0x40000000 on). Advisory: no data is meant.
constexpr off_t kLockedByte = 0x40001000;

struct flock LockOf(short type) {
  struct flock lock = {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = kLockedByte;
  lock.l_len = 1;
  return lock;
}

FileId IdOf(const struct stat& status) {
  return {status.st_dev, status.st_ino};
}

}  // namespace

Result<std::optional<FileId>> FileIdAt(const std::filesystem::path& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) == 0) return IdOf(status);
  if (errno == ENOENT || errno == ENOTDIR) return std::nullopt;
  return Fail(ErrorCode::kIo, "{}: {}", path.string(), std::strerror(errno));
}

struct MissionFileHandle::Shared {
  FileId id;
  std::vector<int>
      descriptors;  ///< more than one only after a file was replaced while it was opened
  int handles = 0;
  bool has_writer = false;
};

struct MissionFileHandle::Registry {
  std::mutex mutex;
  std::map<FileId, Shared> files;

  static Registry& Get() {
    static Registry registry;
    return registry;
  }
};

Result<MissionFileHandle> MissionFileHandle::Acquire(const std::filesystem::path& path,
                                                     bool create) {
  const std::string file = path.string();
  Registry& registry = Registry::Get();
  const std::lock_guard lock(registry.mutex);
  struct stat status = {};
  if (!create) {
    if (::stat(file.c_str(), &status) != 0)
      return Fail(ErrorCode::kIo, "{}: {}", file,
                  errno == ENOENT ? "does not exist" : std::strerror(errno));
    if (!S_ISREG(status.st_mode)) return Fail(ErrorCode::kIo, "{}: is not a file", file);
    if (const auto found = registry.files.find(IdOf(status)); found != registry.files.end()) {
      ++found->second.handles;
      return MissionFileHandle(&found->second, file);
    }
  }
  constexpr int kFlags = O_CLOEXEC | O_NONBLOCK;
  int descriptor = create ? ::open(file.c_str(), kFlags | O_RDWR | O_CREAT | O_EXCL, 0644)
                          : ::open(file.c_str(), kFlags | O_RDWR);
  if (descriptor < 0 && !create && errno != ENOENT)
    descriptor = ::open(file.c_str(), kFlags | O_RDONLY);
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0)
    return Fail(ErrorCode::kIo, "{}: {}", file,
                create && errno == EEXIST ? std::string("exists already")
                                          : std::string("cannot open: ") + std::strerror(errno));
  Shared& shared = registry.files[IdOf(status)];
  shared.id = IdOf(status);
  shared.descriptors.push_back(descriptor);
  ++shared.handles;
  return MissionFileHandle(&shared, file);
}

Result<MissionFileHandle> MissionFileHandle::Open(const std::filesystem::path& path) {
  return Acquire(path, false);
}

Result<MissionFileHandle> MissionFileHandle::Create(const std::filesystem::path& path) {
  return Acquire(path, true);
}

MissionFileHandle::MissionFileHandle(MissionFileHandle&& other) noexcept
    : shared_(std::exchange(other.shared_, nullptr)),
      file_(std::move(other.file_)),
      locked_(std::exchange(other.locked_, false)) {}

MissionFileHandle::~MissionFileHandle() {
  if (shared_ == nullptr) return;
  Unlock();
  Registry& registry = Registry::Get();
  const std::lock_guard lock(registry.mutex);
  if (--shared_->handles > 0) return;
  for (const int descriptor : shared_->descriptors) ::close(descriptor);
  registry.files.erase(FileId(shared_->id));
}

Status MissionFileHandle::LockForWriting() {
  const std::lock_guard lock(Registry::Get().mutex);
  if (locked_) return {};
  if (shared_->has_writer)
    return Fail(ErrorCode::kIo, "{}: is in use: this program is recording into it already", file_);
  struct flock wanted = LockOf(F_WRLCK);
  if (::fcntl(shared_->descriptors.front(), F_OFD_SETLK, &wanted) != 0) {
    if (errno == EAGAIN || errno == EACCES)
      return Fail(ErrorCode::kIo, "{}: is in use by another program, which writes it", file_);
    if (errno == EBADF) return Fail(ErrorCode::kIo, "{}: is write-protected", file_);
    return Fail(ErrorCode::kIo, "{}: cannot be locked: {}", file_, std::strerror(errno));
  }
  shared_->has_writer = locked_ = true;
  return {};
}

void MissionFileHandle::Unlock() {
  if (shared_ == nullptr || !locked_) return;
  const std::lock_guard lock(Registry::Get().mutex);
  struct flock none = LockOf(F_UNLCK);
  ::fcntl(shared_->descriptors.front(), F_OFD_SETLK, &none);
  shared_->has_writer = locked_ = false;
}

FileId MissionFileHandle::Id() const {
  return shared_->id;
}

bool MissionFileHandle::HasWriter() const {
  const std::lock_guard lock(Registry::Get().mutex);
  if (shared_->has_writer) return true;
  struct flock asked = LockOf(F_RDLCK);
  return ::fcntl(shared_->descriptors.front(), F_OFD_GETLK, &asked) == 0 && asked.l_type != F_UNLCK;
}

Result<std::string> MissionFileHandle::FirstBytes(std::size_t count) const {
  std::string bytes(count, '\0');
  const ssize_t got = ::pread(shared_->descriptors.front(), bytes.data(), count, 0);
  if (got < 0) return Fail(ErrorCode::kIo, "{}: cannot read: {}", file_, std::strerror(errno));
  bytes.resize(static_cast<std::size_t>(got));
  return bytes;
}

}  // namespace foresight
