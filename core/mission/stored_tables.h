#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mission/sqlite.h"
#include "core/mission/sqlite_pages.h"

namespace foresight {

/// A table of the mission file as its own schema describes it, for who handles rows of any table.
struct StoredTable {
  enum class Kind { kInteger, kReal, kText, kBlob };
  struct Column {
    std::string name;
    Kind kind = Kind::kInteger;
  };
  std::string name;
  std::vector<Column> columns;
  std::optional<std::size_t> rowid;     ///< the column that is the rowid
  std::optional<std::size_t> checksum;  ///< the column crc32

  /// @pre the table has the column
  std::size_t ColumnOf(std::string_view column) const;
};

/// All tables of an open mission file.
Result<std::vector<StoredTable>> ReadStoredTables(const SqliteDatabase& database);

/// @pre one of the tables has the name
const StoredTable& TableNamed(const std::vector<StoredTable>& tables, std::string_view name);

/// A whole number of a row; 0 where it is NULL or something else.
std::int64_t WholeOf(const StoredTable& table, const std::vector<StoredValue>& values,
                     std::string_view column);

/// The row's values as the table has them (its rowid in place, whole numbers of REAL columns as
/// numbers); nullopt where it cannot be a row of the table: another number or another kind of
/// columns.
std::optional<std::vector<StoredValue>> AsRowOf(const StoredTable& table, const StoredRow& row);

/// RowChecksum over everything but the checksum itself, as all writers of the table compute it.
std::int64_t ChecksumOf(const StoredTable& table, const std::vector<StoredValue>& values);
/// @pre the table has a checksum
bool HasGoodChecksum(const StoredTable& table, const std::vector<StoredValue>& values);

/// Inserts the row; one with the same key stays, and false is returned.
Result<bool> InsertStored(SqliteDatabase& database, const StoredTable& table,
                          const std::vector<StoredValue>& values);

/// The values of the row that a statement `SELECT *` stands at.
std::vector<StoredValue> StoredValuesOf(const SqliteStatement& row, const StoredTable& table);

/// All rows for which the condition holds ("scan_id = 3 ORDER BY batch"). For tables without
/// pixels.
Result<std::vector<std::vector<StoredValue>>> ReadStored(const SqliteDatabase& database,
                                                         const StoredTable& table,
                                                         const std::string& condition);

}  // namespace foresight
