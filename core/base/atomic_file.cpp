#include "core/base/atomic_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace foresight {

Status WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
  static std::atomic<int> counter{0};
  const std::filesystem::path neighbour =
      path.string() + fmt::format(".{}-{}.part", getpid(), counter.fetch_add(1));
  const auto fail = [&](const char* what) {
    const std::string reason = std::strerror(errno);
    std::error_code ignored;
    std::filesystem::remove(neighbour, ignored);
    return Fail(ErrorCode::kIo, "{}: {}: {}", path.string(), what, reason);
  };
  {
    std::ofstream stream(neighbour, std::ios::binary | std::ios::trunc);
    if (!stream) return fail("cannot write");
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream) return fail("cannot write");
  }
  std::error_code error;
  std::filesystem::rename(neighbour, path, error);
  if (error) {
    errno = error.value();
    return fail("cannot replace");
  }
  return {};
}

Result<std::string> ReadFile(const std::filesystem::path& path, std::size_t limit_bytes) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    return Fail(ErrorCode::kIo, "{}: is a folder, not a file", path.string());
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  if (!stream) return Fail(ErrorCode::kIo, "{}: cannot open: {}", path.string(), strerror(errno));
  const auto size = static_cast<std::size_t>(stream.tellg());
  if (size > limit_bytes)
    return Fail(ErrorCode::kBadData, "{}: {} bytes, more than the {} this reads", path.string(),
                size, limit_bytes);
  std::string bytes(size, '\0');
  stream.seekg(0);
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) return Fail(ErrorCode::kIo, "{}: cannot read", path.string());
  return bytes;
}

}  // namespace foresight
