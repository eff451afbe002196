#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "core/base/result.h"

namespace foresight {

/// Which file a name stands for: device and number.
using FileId = std::pair<::dev_t, ::ino_t>;
/// nullopt where there is none. Fails with kIo where the file system does not answer.
Result<std::optional<FileId>> FileIdAt(const std::filesystem::path& path);

/// This process's own descriptor of a mission file: reads its first bytes, holds the lock of the
/// one writer, and tells whether there is a writer.
///
/// Closing any descriptor of a file drops the locks that SQLite has on it in the same process. So a
/// process has one descriptor for a file, shared by all handles, and it is closed with the last of
/// them. A handle must outlive the connections to its file.
class MissionFileHandle {
 public:
  /// Fails with kIo where there is no such file, or it is no regular one.
  static Result<MissionFileHandle> Open(const std::filesystem::path& path);
  /// Makes the file, empty. Fails with kIo where there is one.
  static Result<MissionFileHandle> Create(const std::filesystem::path& path);

  ~MissionFileHandle();
  MissionFileHandle(MissionFileHandle&& other) noexcept;
  MissionFileHandle& operator=(MissionFileHandle&&) = delete;

  FileId Id() const;
  /// Becomes the file's writer until the handle is destroyed or unlocked. Fails with kIo where
  /// another handle is, in this process or another one, or the file is write-protected.
  Status LockForWriting();
  void Unlock();
  /// Whether any handle, in any process, is the file's writer.
  bool HasWriter() const;
  /// The first bytes, fewer where the file is shorter.
  Result<std::string> FirstBytes(std::size_t count) const;

 private:
  struct Shared;
  struct Registry;
  MissionFileHandle(Shared* shared, std::string file) : shared_(shared), file_(std::move(file)) {}
  static Result<MissionFileHandle> Acquire(const std::filesystem::path& path, bool create);

  Shared* shared_;
  std::string file_;
  bool locked_ = false;
};

}  // namespace foresight
