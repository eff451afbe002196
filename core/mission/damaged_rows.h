#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/mission/mission_damage.h"
#include "core/mission/sqlite_pages.h"
#include "core/mission/stored_tables.h"

namespace foresight {

/// Takes the rows of a mission file, whoever read them, and finds out which are damaged and which
/// are missing.
class DamagedRows {
 public:
  /// A row is known by its scan (0 in tables whose rows have a number of their own) and its number.
  using Key = std::pair<std::int64_t, std::int64_t>;
  using Row = std::vector<StoredValue>;

  DamagedRows(const std::vector<StoredTable>& tables, std::size_t at_most)
      : tables_(tables), at_most_(at_most) {}

  /// A row as it was read. Images come before their pixels. One that comes again counts as good
  /// where it once was.
  void Take(const StoredTable& table, const Row& row);
  /// There is such a row, but it cannot be read.
  void TakeUnreadable(const StoredTable& table, Key key, const std::string& why);
  /// Whether the row's checksum is right; of pixels: whether they are those that their image names.
  bool IsGood(const StoredTable& table, const Row& row) const;
  /// Whether the file can have a row of that key, as far as its scans and its good rows tell.
  bool MayBe(const StoredTable& table, Key key) const;
  /// Something that is about no single row.
  void Tell(DamagedRecord record);
  bool Has(const StoredTable& table, Key key) const;
  bool AnyGood() const;
  /// Ids of scans whose own row is good, with how many rows of a table they say that they have;
  /// -1 = it is not known.
  std::map<std::int64_t, std::int64_t> CountsIn(const std::string& table) const;
  /// Says what the counts of the scans miss.
  DamageReport Report();

 private:
  struct Seen {
    std::set<Key> good;
    std::map<Key, std::string> bad;  ///< with what is wrong
  };

  void TellMissing();

  const std::vector<StoredTable>& tables_;
  std::size_t at_most_;
  std::map<std::string, Seen> seen_;
  std::map<Key, std::int64_t> pixels_;  ///< CRC of an image's pixels, as its row has it
  std::map<std::int64_t, Row> scans_;
  std::vector<DamagedRecord> told_;
};

/// The key of a row; 0 for columns that hold something else.
DamagedRows::Key KeyOf(const StoredTable& table, const DamagedRows::Row& row);

/// Reads all tables of an open mission through SQLite. Where a tree is damaged its rows are asked
/// for one by one, by the keys that its scans or its other rows say there are.
Status ReadThroughTables(const SqliteDatabase& database, const std::vector<StoredTable>& tables,
                         DamagedRows& rows, const RunContext& context);

/// Reads all pages of a file, each on its own.
Status ReadThroughPages(const SqlitePages& pages, const std::vector<StoredTable>& tables,
                        DamagedRows& rows, const RunContext& context);

}  // namespace foresight
