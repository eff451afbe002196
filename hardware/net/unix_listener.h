#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "hardware/net/unique_fd.h"

namespace foresight {

/// A Unix domain socket that programs of this computer connect to: of the same user or group. The
/// file goes with its owner. One thread at a time.
class UnixListener {
 public:
  UnixListener() = default;
  ~UnixListener();
  UnixListener(UnixListener&& other) noexcept = default;
  UnixListener& operator=(UnixListener&& other) noexcept;

  /// Makes the folder, readable by its owner alone, where there is none. A socket file that nobody
  /// listens on is taken over. Fails with kIo where somebody does, where another file has the name,
  /// and where the path is longer than the system's 107 bytes.
  static Result<UnixListener> Listen(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  /// Readable when somebody connects.
  int fd() const { return fd_.Get(); }
  /// The next one who connected, non-blocking; not open where nobody did.
  UniqueFd Accept() const;

 private:
  UniqueFd lock_;  ///< held while somebody listens, so that two who begin at once do not both do
  UniqueFd fd_;
  std::filesystem::path path_;
};

/// A connection to a listener there, non-blocking. Fails with kIo.
Result<UniqueFd> ConnectUnix(const std::filesystem::path& path);

}  // namespace foresight
