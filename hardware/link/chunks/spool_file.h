#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hardware/link/chunks/chunk.h"

namespace foresight {

/// A file that keeps the chunks of one scan while they come (docs/formats.md): records that are
/// only appended, each with a checksum. What Append returned for is on the disk, whatever dies
/// then. One program at a time. Nothing throws. Not for several threads at a time.
class SpoolFile {
 public:
  /// Opens or makes the scan's spool in the folder, which is made where it is missing. Calls `read`
  /// with each chunk that it holds, in the order of appending; what a crash left half written
  /// behind them is cut off. Fails with kIo (also where another program has it open), kInvalidInput
  /// where the id cannot be a file's name, kBadData where the file is no spool or of another scan.
  static Result<std::unique_ptr<SpoolFile>> Open(const std::filesystem::path& folder,
                                                 const std::string& scan_id,
                                                 const std::function<void(const Chunk&)>& read);
  ~SpoolFile();
  SpoolFile(const SpoolFile&) = delete;
  SpoolFile& operator=(const SpoolFile&) = delete;

  /// Keeps the chunks: on the disk when it returns (one fdatasync for all). Fails with kIo (a full
  /// disk): then none of them is kept, those before are, and the next call may succeed.
  Status Append(std::span<const Chunk> chunks);

  const std::filesystem::path& path() const { return path_; }
  std::int64_t size_bytes() const { return size_; }
  /// Bytes that Open cut off.
  std::int64_t cut_bytes() const { return cut_; }
  /// Deletes the file: the scan is complete elsewhere. Only the destructor may be called then.
  Status Remove();

 private:
  SpoolFile(std::filesystem::path path, int descriptor)
      : path_(std::move(path)), descriptor_(descriptor) {}
  Status Begin(const std::string& scan_id);
  Status ReadAll(const std::string& scan_id, const std::function<void(const Chunk&)>& read);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
  std::int64_t cut_ = 0;
};

struct SpoolSummary {
  std::string scan_id;
  std::filesystem::path path;
  std::int64_t bytes = 0;
};
/// The spools of a folder by scan id; none where there is no folder. Files that are no spools are
/// left out. Fails with kIo.
Result<std::vector<SpoolSummary>> ListSpools(const std::filesystem::path& folder);

/// Records of a spool in memory, for tests and fuzzers: calls `read` for each whole one; returns
/// the length of the clean prefix.
std::size_t ReadSpoolRecords(std::string_view bytes, const std::function<void(const Chunk&)>& read);

}  // namespace foresight
