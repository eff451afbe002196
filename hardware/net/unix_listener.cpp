#include "hardware/net/unix_listener.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

namespace foresight {
namespace {

constexpr int kUnixBacklog = 4;

Result<sockaddr_un> AddressOf(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string& name = path.native();
  if (name.empty() || name.size() >= sizeof address.sun_path)
    return Fail(ErrorCode::kIo, "{}: a socket's path has 1 to {} bytes, not {}", name,
                sizeof address.sun_path - 1, name.size());
  std::memcpy(address.sun_path, name.data(), name.size());
  return address;
}

Result<UniqueFd> NewSocket(const std::filesystem::path& path) {
  UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!fd.IsOpen())
    return Fail(ErrorCode::kIo, "{}: no socket: {}", path.native(),
                std::generic_category().message(errno));
  return fd;
}

/// 0, or errno.
int Connect(const UniqueFd& fd, const sockaddr_un& address) {
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  return ::connect(fd.Get(), generic, sizeof address) == 0 ? 0 : errno;
}

Status MakeFolderOf(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  std::error_code failure;
  if (folder.empty() || std::filesystem::exists(folder, failure)) return {};
  std::filesystem::create_directories(folder, failure);
  if (!failure && ::chmod(folder.c_str(), S_IRWXU) != 0)
    failure.assign(errno, std::generic_category());
  if (!failure) return {};
  return Fail(ErrorCode::kIo, "{}: cannot make the folder: {}", folder.native(), failure.message());
}

Status InUse(const std::filesystem::path& path) {
  return Fail(ErrorCode::kIo, "{}: another program listens there. End it, or give another path",
              path.native());
}

Result<UniqueFd> Lock(const std::filesystem::path& path) {
  const std::string name = path.native() + ".lock";
  UniqueFd lock(::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, S_IRUSR | S_IWUSR));
  if (!lock.IsOpen())
    return Fail(ErrorCode::kIo, "{}: cannot open: {}", name,
                std::generic_category().message(errno));
  if (::flock(lock.Get(), LOCK_EX | LOCK_NB) == 0) return lock;
  return tl::unexpected(InUse(path).error());
}

/// Removes what a program left that did not close properly.
Status RemoveStale(const std::filesystem::path& path, const sockaddr_un& address) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) return {};
  if (!S_ISSOCK(found.st_mode))
    return Fail(ErrorCode::kIo, "{}: is there and no socket; it is left alone", path.native());
  FORESIGHT_TRY(const UniqueFd caller, NewSocket(path));
  if (Connect(caller, address) != ECONNREFUSED) return InUse(path);
  if (::unlink(path.c_str()) == 0) return {};
  return Fail(ErrorCode::kIo, "{}: cannot remove the old socket: {}", path.native(),
              std::generic_category().message(errno));
}

}  // namespace

UnixListener::~UnixListener() {
  // The lock file stays: who removes it could take it away from a program that just opened it.
  if (fd_.IsOpen()) ::unlink(path_.c_str());
}

UnixListener& UnixListener::operator=(UnixListener&& other) noexcept {
  std::swap(lock_, other.lock_);
  std::swap(fd_, other.fd_);
  std::swap(path_, other.path_);
  return *this;
}

Result<UnixListener> UnixListener::Listen(const std::filesystem::path& path) {
  FORESIGHT_TRY(const sockaddr_un address, AddressOf(path));
  FORESIGHT_CHECK(MakeFolderOf(path));
  UnixListener listener;
  FORESIGHT_TRY(listener.lock_, Lock(path));
  FORESIGHT_CHECK(RemoveStale(path, address));
  FORESIGHT_TRY(UniqueFd fd, NewSocket(path));
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  // Nobody can connect before listen(): until then the rights are not yet those we want.
  if (::bind(fd.Get(), generic, sizeof address) != 0 ||
      ::chmod(path.c_str(), S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP) != 0 ||
      ::listen(fd.Get(), kUnixBacklog) != 0)
    return Fail(ErrorCode::kIo, "{}: cannot listen: {}", path.native(),
                std::generic_category().message(errno));
  listener.path_ = path;
  listener.fd_ = std::move(fd);
  return listener;
}

UniqueFd UnixListener::Accept() const {
  return UniqueFd(::accept4(fd_.Get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
}

Result<UniqueFd> ConnectUnix(const std::filesystem::path& path) {
  FORESIGHT_TRY(const sockaddr_un address, AddressOf(path));
  FORESIGHT_TRY(UniqueFd fd, NewSocket(path));
  const int error = Connect(fd, address);
  if (error == 0) return fd;
  return Fail(ErrorCode::kIo, "{}: cannot connect: {}", path.native(),
              std::generic_category().message(error));
}

}  // namespace foresight
