#include "core/mission/mission_schema.h"

#include <array>
#include <span>

namespace foresight {
namespace {

struct Table {
  std::string_view name;
  std::string_view sql;
  bool small = true;  ///< does not grow with lines or pixels
};

// SQLite keeps these texts, and CheckMissionSchema compares them: a changed byte here is a new
// format. crc32 covers all other columns of its row (RowChecksum).
constexpr Table kMeta = {
    "meta", "CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT, WITHOUT ROWID"};
constexpr Table kCalibration = {
    "calibration",
    "CREATE TABLE calibration(id INTEGER PRIMARY KEY, rig_yaml TEXT NOT NULL, crc32 INTEGER NOT "
    "NULL) STRICT"};
constexpr Table kScan = {
    "scan",
    "CREATE TABLE scan(id INTEGER PRIMARY KEY, uuid TEXT NOT NULL UNIQUE, calibration_id INTEGER "
    "NOT NULL REFERENCES calibration(id), start_utc_ns INTEGER NOT NULL, source TEXT NOT NULL, "
    "simulated INTEGER NOT NULL, plan_json TEXT NOT NULL, state TEXT NOT NULL, reason TEXT NOT "
    "NULL, lines INTEGER NOT NULL, motor_batches INTEGER NOT NULL, frames INTEGER NOT NULL, crc32 "
    "INTEGER NOT NULL) STRICT"};
constexpr Table kLine = {
    // Not WITHOUT ROWID: such a table keeps a quarter page of a row at most, and every line would
    // take an overflow page of its own.
    "line",
    "CREATE TABLE line(scan_id INTEGER NOT NULL REFERENCES scan(id), seq INTEGER NOT NULL, time_s "
    "REAL NOT NULL, codec INTEGER NOT NULL, beams INTEGER NOT NULL, has_intensity INTEGER NOT "
    "NULL, data BLOB NOT NULL, crc32 INTEGER NOT NULL, PRIMARY KEY(scan_id, seq)) STRICT",
    false};
constexpr Table kMotor = {
    "motor",
    "CREATE TABLE motor(scan_id INTEGER NOT NULL REFERENCES scan(id), batch INTEGER NOT NULL, "
    "data BLOB NOT NULL, crc32 INTEGER NOT NULL, PRIMARY KEY(scan_id, batch)) STRICT, WITHOUT "
    "ROWID",
    false};
constexpr Table kImage = {
    "image",
    "CREATE TABLE image(scan_id INTEGER NOT NULL REFERENCES scan(id), position INTEGER NOT NULL, "
    "seq INTEGER NOT NULL, time_s REAL NOT NULL, exposure_s REAL NOT NULL, gain_db REAL NOT NULL, "
    "motor_angle_rad REAL, target_angle_rad REAL NOT NULL, data_crc32 INTEGER NOT NULL, crc32 "
    "INTEGER NOT NULL, PRIMARY KEY(scan_id, position)) STRICT, WITHOUT ROWID"};
constexpr Table kImageData = {
    "image_data",
    "CREATE TABLE image_data(scan_id INTEGER NOT NULL, position INTEGER NOT NULL, png BLOB NOT "
    "NULL, PRIMARY KEY(scan_id, position), FOREIGN KEY(scan_id, position) REFERENCES "
    "image(scan_id, position)) STRICT, WITHOUT ROWID",
    false};
constexpr Table kDetection1 = {
    "detection",
    "CREATE TABLE detection(id INTEGER PRIMARY KEY, scan_id INTEGER NOT NULL REFERENCES scan(id), "
    "kind TEXT NOT NULL, utc_ns INTEGER NOT NULL, json TEXT NOT NULL, crc32 INTEGER NOT NULL) "
    "STRICT"};
constexpr Table kEvent = {
    "event",
    "CREATE TABLE event(id INTEGER PRIMARY KEY, utc_ns INTEGER NOT NULL, source TEXT NOT NULL, "
    "severity TEXT NOT NULL, text TEXT NOT NULL, json TEXT NOT NULL, crc32 INTEGER NOT NULL) "
    "STRICT"};

// New in format 2. scan_id is NULL in a review, whose scans are in another file.
constexpr Table kThumbnail = {
    "thumbnail",
    "CREATE TABLE thumbnail(scan_id INTEGER PRIMARY KEY REFERENCES scan(id), png BLOB NOT NULL, "
    "crc32 INTEGER NOT NULL) STRICT"};
constexpr Table kDetection2 = {
    "detection",
    "CREATE TABLE detection(id INTEGER PRIMARY KEY, uuid TEXT NOT NULL UNIQUE, scan_id INTEGER "
    "REFERENCES scan(id), scan_uuid TEXT NOT NULL, kind TEXT NOT NULL, utc_ns INTEGER NOT NULL, "
    "author TEXT NOT NULL, json TEXT NOT NULL, provenance_json TEXT NOT NULL, crc32 INTEGER NOT "
    "NULL) STRICT"};
constexpr Table kDetectionEvent = {
    "detection_event",
    "CREATE TABLE detection_event(id INTEGER PRIMARY KEY, detection_id INTEGER NOT NULL REFERENCES "
    "detection(id), utc_ns INTEGER NOT NULL, author TEXT NOT NULL, action TEXT NOT NULL, text TEXT "
    "NOT NULL, crc32 INTEGER NOT NULL) STRICT"};
constexpr Table kDepth = {
    "depth",
    "CREATE TABLE depth(id INTEGER PRIMARY KEY, uuid TEXT NOT NULL UNIQUE, scan_id INTEGER "
    "REFERENCES scan(id), scan_uuid TEXT NOT NULL, image_position INTEGER NOT NULL, utc_ns INTEGER "
    "NOT NULL, author TEXT NOT NULL, provenance_json TEXT NOT NULL, digest TEXT NOT NULL, "
    "statistics_json TEXT NOT NULL, crc32 INTEGER NOT NULL) STRICT"};

// New in format 3: the cloud of an imported scan, which has no rows in line and motor.
constexpr Table kGivenLine = {
    "given_line",
    "CREATE TABLE given_line(scan_id INTEGER NOT NULL REFERENCES scan(id), line INTEGER NOT NULL, "
    "time_s REAL, beams INTEGER NOT NULL, parts INTEGER NOT NULL, data BLOB NOT NULL, crc32 "
    "INTEGER NOT NULL, PRIMARY KEY(scan_id, line)) STRICT",
    false};

// New in format 4. Every row is a whole state of a note or a measurement, rows are only ever added,
// and the last one of a uuid counts. scan_uuid is empty where it is about the mission.
constexpr Table kNote = {
    "note",
    "CREATE TABLE note(id INTEGER PRIMARY KEY, uuid TEXT NOT NULL, scan_id INTEGER REFERENCES "
    "scan(id), scan_uuid TEXT NOT NULL, object_uuid TEXT NOT NULL, kind TEXT NOT NULL, utc_ns "
    "INTEGER NOT NULL, author TEXT NOT NULL, text TEXT NOT NULL, tags TEXT NOT NULL, json TEXT NOT "
    "NULL, deleted INTEGER NOT NULL, crc32 INTEGER NOT NULL) STRICT"};

constexpr std::array kTables1 = {kMeta,  kCalibration, kScan,       kLine, kMotor,
                                 kImage, kImageData,   kDetection1, kEvent};
constexpr std::array kTables2 = {kMeta,           kCalibration, kScan,      kLine,
                                 kMotor,          kImage,       kImageData, kDetection2,
                                 kDetectionEvent, kDepth,       kEvent,     kThumbnail};
constexpr std::array kTables3 = {kMeta,  kCalibration, kScan,       kLine,           kMotor,
                                 kImage, kImageData,   kDetection2, kDetectionEvent, kDepth,
                                 kEvent, kThumbnail,   kGivenLine};
constexpr std::array kTables4 = {
    kMeta,       kCalibration,    kScan,  kLine,  kMotor,     kImage,     kImageData,
    kDetection2, kDetectionEvent, kDepth, kEvent, kThumbnail, kGivenLine, kNote};

std::span<const Table> TablesOf(int format) {
  if (format == 1) return kTables1;
  if (format == 2) return kTables2;
  if (format == 3) return kTables3;
  return kTables4;
}

}  // namespace

Status CreateMissionTable(SqliteDatabase& database, std::string_view name) {
  for (const Table& table : TablesOf(kMissionFormatVersion))
    if (table.name == name) return database.Run(std::string(table.sql).c_str());
  return Fail(ErrorCode::kInvalidInput, "'{}' is no table of mission format {}", name,
              kMissionFormatVersion);
}

Status CreateMissionSchema(SqliteDatabase& database, int format) {
  FORESIGHT_CHECK(database.Run("BEGIN IMMEDIATE"));
  for (const Table& table : TablesOf(format))
    FORESIGHT_CHECK(database.Run(std::string(table.sql).c_str()));
  FORESIGHT_CHECK(
      database.Run(fmt::format("PRAGMA application_id = {}", kMissionApplicationId).c_str()));
  FORESIGHT_CHECK(database.Run(fmt::format("PRAGMA user_version = {}", format).c_str()));
  return database.Run("COMMIT");
}

Result<int> MissionFormat(const SqliteDatabase& database, const std::string& file) {
  FORESIGHT_TRY(const std::int64_t format, database.Integer("PRAGMA user_version"));
  if (format > kMissionFormatVersion)
    return Fail(ErrorCode::kBadData,
                "{}: was written by a newer Foresight (mission format {}; this program reads up to "
                "{}): update this program",
                file, format, kMissionFormatVersion);
  if (format < 1)
    return Fail(ErrorCode::kBadData,
                "{}: mission format {} is not known; this program reads 1 to {}", file, format,
                kMissionFormatVersion);
  return static_cast<int>(format);
}

Result<int> CheckMissionSchema(const SqliteDatabase& database, const std::string& file) {
  FORESIGHT_TRY(const std::int64_t application, database.Integer("PRAGMA application_id"));
  if (application != kMissionApplicationId)
    return Fail(ErrorCode::kBadData, "{}: is not a mission file (application id {:#x})", file,
                application);
  FORESIGHT_TRY(const int format, MissionFormat(database, file));
  const std::span<const Table> tables = TablesOf(format);
  FORESIGHT_TRY(SqliteStatement found,
                database.Prepare("SELECT name, sql FROM sqlite_schema WHERE sql IS NOT NULL "
                                 "AND name NOT LIKE 'sqlite!_%' ESCAPE '!'"));
  std::size_t count = 0;
  for (;; ++count) {
    FORESIGHT_TRY(const bool row, found.Step());
    if (!row) break;
    const std::string name = found.Text(0);
    bool known = false;
    for (const Table& table : tables)
      known = known || (table.name == name && table.sql == found.Text(1));
    if (!known)
      return Fail(ErrorCode::kBadData, "{}: table '{}' is not one of mission format {}", file, name,
                  format);
  }
  if (count != tables.size())
    return Fail(ErrorCode::kBadData, "{}: {} tables instead of {}", file, count, tables.size());
  return format;
}

Status CheckSmallTables(const SqliteDatabase& database, int format, const std::string& file) {
  for (const Table& table : TablesOf(format)) {
    if (!table.small) continue;
    FORESIGHT_TRY(SqliteStatement check,
                  database.Prepare(fmt::format("PRAGMA quick_check({})", table.name).c_str()));
    FORESIGHT_TRY(const bool row, check.Step());
    if (!row || check.Text(0) != "ok")
      return Fail(ErrorCode::kBadData, "{}: the file is damaged: {}", file,
                  row ? check.Text(0) : "no answer from its check");
  }
  return {};
}

}  // namespace foresight
