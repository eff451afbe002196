#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "core/base/result.h"

namespace foresight {

/// Bytes that are no text.
struct StoredBlob {
  std::string bytes;
  auto operator<=>(const StoredBlob&) const = default;
};

/// A value as SQLite keeps it in a record; monostate = NULL, std::string = text.
using StoredValue = std::variant<std::monostate, std::int64_t, double, std::string, StoredBlob>;

/// One record found on a page. A column that is the rowid is NULL in `values`.
struct StoredRow {
  std::optional<std::int64_t> rowid;  ///< none = of a table WITHOUT ROWID, or of an index
  std::vector<StoredValue> values;
};

/// The pages of an SQLite file, read without SQLite: of a damaged file each page is looked at on
/// its own, whatever happened to the tree above it (https://www.sqlite.org/fileformat2.html). What
/// a
/// `-wal` beside the file has committed lies over the pages. Nothing is written.
class SqlitePages {
 public:
  /// Fails with kIo. A damaged header is no failure: the page size of our own files is taken then.
  static Result<SqlitePages> Open(const std::filesystem::path& path);

  /// Pages have the numbers 1 to count().
  std::uint32_t count() const { return count_; }
  /// PRAGMA user_version, as it stands in the header; 0 = unknown.
  std::uint32_t user_version() const { return user_version_; }

  /// Called with a record that decodes; returns whether it is one. Whoever knows what belongs into
  /// the tables decides: bytes that are no record decode now and then.
  using Accept = std::function<bool(StoredRow row)>;

  /// Calls `accept` with every record that begins on the page. Where the page's own list of cells
  /// is damaged, or does not lead to records only, every byte of it is tried as a beginning, so
  /// that a record may come twice. Records of more than 256 MiB are left out. Fails with kIo.
  Status VisitRows(std::uint32_t page, const Accept& accept) const;

 private:
  struct CloseFile {
    void operator()(const int* descriptor) const;
  };
  using File = std::unique_ptr<int, CloseFile>;
  enum class CellKind { kTable, kIndex };
  struct ListedCells;

  SqlitePages() = default;
  static Result<File> OpenFile(const std::filesystem::path& path);
  void ReadHeader();
  Status OverlayLog(const std::filesystem::path& log);
  Result<std::string> PageBytes(std::uint32_t page) const;
  /// The record whose cell begins at `offset` of a page's bytes.
  Result<std::optional<StoredRow>> CellAt(std::string_view bytes, std::size_t offset,
                                          CellKind kind) const;
  Result<bool> VisitListed(std::string_view bytes, std::size_t header, const Accept& accept) const;
  Status VisitEveryByte(std::string_view bytes, const Accept& accept) const;

  std::string name_;
  File file_;
  File log_;
  std::unordered_map<std::uint32_t, std::int64_t> in_log_;  ///< page -> where its bytes are in log_
  std::uint32_t page_bytes_ = 0;
  std::uint32_t usable_bytes_ = 0;  ///< of a page, without what is reserved at its end
  std::uint32_t count_ = 0;
  std::uint32_t user_version_ = 0;
};

}  // namespace foresight
