#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace foresight {

/// A ZIP archive that is being written (libarchive). The same entries give the same bytes: all have
/// the time 1980-01-01. The whole archive or nothing: without Finish no file is left. Fails with
/// kIo.
class ZipFile {
 public:
  static Result<ZipFile> Create(const std::filesystem::path& path);
  ZipFile(ZipFile&&) noexcept;
  ZipFile& operator=(ZipFile&&) = delete;
  ~ZipFile();

  /// `name` with slashes between folders.
  Status Add(const std::string& name, std::string_view bytes);
  Status Finish();

 private:
  struct Impl;
  explicit ZipFile(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foresight
