#include "core/mission/mission_schema.h"

#include <array>

namespace foresight {
namespace {

struct Table {
  std::string_view name;
  std::string_view sql;
};

// SQLite keeps these texts, and CheckMissionSchema compares them: a changed byte here is a new
// format. crc32 covers all other columns of its row (RowChecksum).
constexpr std::array<Table, 9> kTables = {{
    {"meta", "CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT, WITHOUT ROWID"},
    {"calibration",
     "CREATE TABLE calibration(id INTEGER PRIMARY KEY, rig_yaml TEXT NOT NULL, crc32 INTEGER NOT "
     "NULL) STRICT"},
    {"scan",
     "CREATE TABLE scan(id INTEGER PRIMARY KEY, uuid TEXT NOT NULL UNIQUE, calibration_id INTEGER "
     "NOT NULL REFERENCES calibration(id), start_utc_ns INTEGER NOT NULL, source TEXT NOT NULL, "
     "simulated INTEGER NOT NULL, plan_json TEXT NOT NULL, state TEXT NOT NULL, reason TEXT NOT "
     "NULL, lines INTEGER NOT NULL, motor_batches INTEGER NOT NULL, frames INTEGER NOT NULL, crc32 "
     "INTEGER NOT NULL) STRICT"},
    {"line",
     // Not WITHOUT ROWID: such a table keeps a quarter page of a row at most, and every line would
     // take an overflow page of its own.
     "CREATE TABLE line(scan_id INTEGER NOT NULL REFERENCES scan(id), seq INTEGER NOT NULL, time_s "
     "REAL NOT NULL, codec INTEGER NOT NULL, beams INTEGER NOT NULL, has_intensity INTEGER NOT "
     "NULL, data BLOB NOT NULL, crc32 INTEGER NOT NULL, PRIMARY KEY(scan_id, seq)) STRICT"},
    {"motor",
     "CREATE TABLE motor(scan_id INTEGER NOT NULL REFERENCES scan(id), batch INTEGER NOT NULL, "
     "data BLOB NOT NULL, crc32 INTEGER NOT NULL, PRIMARY KEY(scan_id, batch)) STRICT, WITHOUT "
     "ROWID"},
    {"image",
     "CREATE TABLE image(scan_id INTEGER NOT NULL REFERENCES scan(id), position INTEGER NOT NULL, "
     "seq INTEGER NOT NULL, time_s REAL NOT NULL, exposure_s REAL NOT NULL, gain_db REAL NOT NULL, "
     "motor_angle_rad REAL, target_angle_rad REAL NOT NULL, data_crc32 INTEGER NOT NULL, crc32 "
     "INTEGER NOT NULL, PRIMARY KEY(scan_id, position)) STRICT, WITHOUT ROWID"},
    {"image_data",
     "CREATE TABLE image_data(scan_id INTEGER NOT NULL, position INTEGER NOT NULL, png BLOB NOT "
     "NULL, PRIMARY KEY(scan_id, position), FOREIGN KEY(scan_id, position) REFERENCES "
     "image(scan_id, position)) STRICT, WITHOUT ROWID"},
    {"detection",
     "CREATE TABLE detection(id INTEGER PRIMARY KEY, scan_id INTEGER NOT NULL REFERENCES scan(id), "
     "kind TEXT NOT NULL, utc_ns INTEGER NOT NULL, json TEXT NOT NULL, crc32 INTEGER NOT NULL) "
     "STRICT"},
    {"event",
     "CREATE TABLE event(id INTEGER PRIMARY KEY, utc_ns INTEGER NOT NULL, source TEXT NOT NULL, "
     "severity TEXT NOT NULL, text TEXT NOT NULL, json TEXT NOT NULL, crc32 INTEGER NOT NULL) "
     "STRICT"},
}};

}  // namespace

Status CreateMissionSchema(SqliteDatabase& database) {
  FORESIGHT_CHECK(database.Run("BEGIN IMMEDIATE"));
  for (const Table& table : kTables) FORESIGHT_CHECK(database.Run(std::string(table.sql).c_str()));
  FORESIGHT_CHECK(
      database.Run(fmt::format("PRAGMA application_id = {}", kMissionApplicationId).c_str()));
  FORESIGHT_CHECK(
      database.Run(fmt::format("PRAGMA user_version = {}", kMissionFormatVersion).c_str()));
  return database.Run("COMMIT");
}

Status CheckMissionSchema(const SqliteDatabase& database, const std::string& file) {
  FORESIGHT_TRY(const std::int64_t application, database.Integer("PRAGMA application_id"));
  if (application != kMissionApplicationId)
    return Fail(ErrorCode::kBadData, "{}: is not a mission file (application id {:#x})", file,
                application);
  FORESIGHT_TRY(const std::int64_t version, database.Integer("PRAGMA user_version"));
  if (version != kMissionFormatVersion)
    return Fail(ErrorCode::kBadData,
                "{}: mission format {} is not known; this program reads format {}{}", file, version,
                kMissionFormatVersion,
                version > kMissionFormatVersion ? ", a newer Foresight wrote the file" : "");
  FORESIGHT_TRY(SqliteStatement found,
                database.Prepare("SELECT name, sql FROM sqlite_schema WHERE sql IS NOT NULL "
                                 "AND name NOT LIKE 'sqlite!_%' ESCAPE '!'"));
  std::size_t count = 0;
  for (;; ++count) {
    FORESIGHT_TRY(const bool row, found.Step());
    if (!row) break;
    const std::string name = found.Text(0);
    bool known = false;
    for (const Table& table : kTables)
      known = known || (table.name == name && table.sql == found.Text(1));
    if (!known)
      return Fail(ErrorCode::kBadData, "{}: table '{}' is not one of mission format {}", file, name,
                  kMissionFormatVersion);
  }
  if (count != kTables.size())
    return Fail(ErrorCode::kBadData, "{}: {} tables instead of {}", file, count, kTables.size());
  return {};
}

}  // namespace foresight
