#pragma once

#include <cstddef>
#include <filesystem>

#include "core/base/result.h"

namespace foresight {

/// Room on a disk that is kept free while something is recorded, so that what was written can still
/// be ended and closed when the disk is full. It has no name: nothing of it is left after a crash.
class DiskReserve {
 public:
  DiskReserve() = default;
  ~DiskReserve() { Release(); }
  DiskReserve(const DiskReserve&) = delete;
  DiskReserve& operator=(const DiskReserve&) = delete;

  /// Takes `bytes` of the disk that holds `folder`; keeps what it has already. Fails with kIo when
  /// the disk has no room for it. Where a file system knows no such reserve there is none.
  Status Take(const std::filesystem::path& folder, std::size_t bytes);
  void Release();

 private:
  int file_ = -1;
};

}  // namespace foresight
