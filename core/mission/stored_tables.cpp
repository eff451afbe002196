#include "core/mission/stored_tables.h"

#include <algorithm>
#include <limits>

#include "core/base/contract.h"
#include "core/mission/row_checksum.h"

namespace foresight {
namespace {

using Kind = StoredTable::Kind;

Kind KindOfType(const std::string& type) {
  if (type == "REAL") return Kind::kReal;
  if (type == "TEXT") return Kind::kText;
  return type == "BLOB" ? Kind::kBlob : Kind::kInteger;
}

/// The value as a column of that kind holds it; false where it cannot.
bool Fits(StoredValue& value, Kind kind) {
  if (std::holds_alternative<std::monostate>(value)) return kind != Kind::kBlob;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    if (kind == Kind::kInteger) return true;
    if (kind != Kind::kReal) return false;
    value = static_cast<double>(*whole);  // SQLite keeps a REAL without a fraction as an integer
    return true;
  }
  if (std::holds_alternative<double>(value)) return kind == Kind::kReal;
  return kind == (std::holds_alternative<StoredBlob>(value) ? Kind::kBlob : Kind::kText);
}

std::string_view BytesOf(const StoredValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* blob = std::get_if<StoredBlob>(&value)) return blob->bytes;
  return {};
}

void Add(RowChecksum& checksum, const StoredValue& value, Kind kind) {
  switch (kind) {
    case Kind::kInteger: {
      const auto* whole = std::get_if<std::int64_t>(&value);
      checksum.Add(whole != nullptr ? *whole : std::int64_t{0});
      return;
    }
    case Kind::kReal: {
      const auto* number = std::get_if<double>(&value);
      checksum.Add(number != nullptr ? *number : std::numeric_limits<double>::quiet_NaN());
      return;
    }
    default:
      checksum.Add(BytesOf(value));
  }
}

void Bind(SqliteStatement& statement, const StoredValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value))
    statement.Bind(*whole);
  else if (const auto* number = std::get_if<double>(&value))
    statement.Bind(*number);
  else if (const auto* text = std::get_if<std::string>(&value))
    statement.BindText(*text);
  else if (const auto* blob = std::get_if<StoredBlob>(&value))
    statement.BindBlob(blob->bytes);
  else
    statement.BindNull();
}

Result<StoredTable> ReadTable(const SqliteDatabase& database, const std::string& name) {
  StoredTable table{name, {}, {}, {}};
  std::size_t keys = 0;
  FORESIGHT_TRY(SqliteStatement info,
                database.Prepare(fmt::format("PRAGMA table_info({})", name).c_str()));
  for (;;) {
    FORESIGHT_TRY(const bool more, info.Step());
    if (!more) break;
    const std::size_t index = table.columns.size();
    table.columns.push_back({info.Text(1), KindOfType(info.Text(2))});
    if (info.Integer(5) > 0) {
      ++keys;
      if (table.columns.back().kind == Kind::kInteger) table.rowid = index;
    }
    if (table.columns.back().name == "crc32") table.checksum = index;
  }
  if (keys != 1) table.rowid.reset();  // only a single INTEGER PRIMARY KEY is the rowid
  return table;
}

}  // namespace

std::size_t StoredTable::ColumnOf(std::string_view column) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [column](const Column& each) { return each.name == column; });
  FORESIGHT_EXPECTS(found != columns.end(), "no such column");
  return static_cast<std::size_t>(found - columns.begin());
}

Result<std::vector<StoredTable>> ReadStoredTables(const SqliteDatabase& database) {
  FORESIGHT_TRY(SqliteStatement names,
                database.Prepare("SELECT name FROM sqlite_schema WHERE type = 'table' AND name "
                                 "NOT LIKE 'sqlite!_%' ESCAPE '!' ORDER BY rowid"));
  std::vector<StoredTable> tables;
  for (;;) {
    FORESIGHT_TRY(const bool more, names.Step());
    if (!more) return tables;
    FORESIGHT_TRY(StoredTable table, ReadTable(database, names.Text(0)));
    tables.push_back(std::move(table));
  }
}

const StoredTable& TableNamed(const std::vector<StoredTable>& tables, std::string_view name) {
  const auto found = std::find_if(tables.begin(), tables.end(),
                                  [name](const StoredTable& table) { return table.name == name; });
  FORESIGHT_EXPECTS(found != tables.end(), "no such table");
  return *found;
}

std::int64_t WholeOf(const StoredTable& table, const std::vector<StoredValue>& values,
                     std::string_view column) {
  const auto* value = std::get_if<std::int64_t>(&values[table.ColumnOf(column)]);
  return value != nullptr ? *value : 0;
}

std::optional<std::vector<StoredValue>> AsRowOf(const StoredTable& table, const StoredRow& row) {
  if (row.values.size() != table.columns.size()) return std::nullopt;
  std::vector<StoredValue> values = row.values;
  if (table.rowid) {
    if (!row.rowid || !std::holds_alternative<std::monostate>(values[*table.rowid]))
      return std::nullopt;
    values[*table.rowid] = *row.rowid;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!Fits(values[i], table.columns[i].kind)) return std::nullopt;
  return values;
}

std::int64_t ChecksumOf(const StoredTable& table, const std::vector<StoredValue>& values) {
  RowChecksum checksum;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i != table.checksum) Add(checksum, values[i], table.columns[i].kind);
  return checksum.value();
}

bool HasGoodChecksum(const StoredTable& table, const std::vector<StoredValue>& values) {
  const auto* stored = std::get_if<std::int64_t>(&values[table.checksum.value()]);
  return stored != nullptr && *stored == ChecksumOf(table, values);
}

Result<bool> InsertStored(SqliteDatabase& database, const StoredTable& table,
                          const std::vector<StoredValue>& values) {
  std::string places = "?";
  for (std::size_t i = 1; i < values.size(); ++i) places += ", ?";
  FORESIGHT_TRY(SqliteStatement insert,
                database.Prepare(fmt::format("INSERT OR IGNORE INTO {} VALUES({}) RETURNING 1",
                                             table.name, places)
                                     .c_str()));
  for (const StoredValue& value : values) Bind(insert, value);
  FORESIGHT_TRY(const bool inserted, insert.Step());
  FORESIGHT_CHECK(insert.Run());
  return inserted;
}

std::vector<StoredValue> StoredValuesOf(const SqliteStatement& row, const StoredTable& table) {
  std::vector<StoredValue> values;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const int column = static_cast<int>(i);
    if (row.IsNull(column))
      values.emplace_back();
    else if (table.columns[i].kind == Kind::kInteger)
      values.emplace_back(row.Integer(column));
    else if (table.columns[i].kind == Kind::kReal)
      values.emplace_back(row.Number(column));
    else if (table.columns[i].kind == Kind::kText)
      values.emplace_back(row.Text(column));
    else
      values.emplace_back(StoredBlob{row.Blob(column)});
  }
  return values;
}

Result<std::vector<std::vector<StoredValue>>> ReadStored(const SqliteDatabase& database,
                                                         const StoredTable& table,
                                                         const std::string& condition) {
  FORESIGHT_TRY(
      SqliteStatement select,
      database.Prepare(fmt::format("SELECT * FROM {} WHERE {}", table.name, condition).c_str()));
  std::vector<std::vector<StoredValue>> rows;
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) return rows;
    rows.push_back(StoredValuesOf(select, table));
  }
}

}  // namespace foresight
