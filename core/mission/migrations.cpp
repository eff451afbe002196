#include "core/mission/migrations.h"

#include <array>

#include "core/mission/mission_schema.h"
#include "core/mission/record_rows.h"

namespace foresight {
namespace {

/// Detections get a uuid, their scan's uuid, an author and a provenance; both stay empty.
Status RecordsGetProvenance(SqliteDatabase& database, const std::string& file) {
  FORESIGHT_TRY(const std::vector<DetectionRecord> detections,
                ReadDetections(database, 1, std::nullopt, file));
  FORESIGHT_CHECK(database.Run("DROP TABLE detection"));
  for (const char* table : {"detection", "detection_event", "depth", "thumbnail"})
    FORESIGHT_CHECK(CreateMissionTable(database, table));
  for (const DetectionRecord& detection : detections)
    FORESIGHT_CHECK(InsertDetection(database, detection));
  return {};
}

/// A table for the clouds of imported scans, of which there are none yet.
Status ScansMayBeGiven(SqliteDatabase& database, const std::string& /*file*/) {
  return CreateMissionTable(database, "given_line");
}

/// A table for notes and measurements, of which there are none yet.
Status NotesAreKept(SqliteDatabase& database, const std::string& /*file*/) {
  return CreateMissionTable(database, "note");
}

constexpr std::array<MissionMigration, 3> kMigrations = {
    {{1, RecordsGetProvenance}, {2, ScansMayBeGiven}, {3, NotesAreKept}}};
static_assert(kMigrations.back().from + 1 == kMissionFormatVersion);

Status RunAll(SqliteDatabase& database, int from, const std::string& file) {
  for (const MissionMigration& migration : kMigrations) {
    if (migration.from < from) continue;
    if (const Status done = migration.run(database, file); !done)
      return Fail(
          done.error().code,
          "{}: cannot be brought from mission format {} to {}: {}. Open it for reading only", file,
          migration.from, migration.from + 1, done.error().message);
    FORESIGHT_CHECK(
        database.Run(fmt::format("PRAGMA user_version = {}", migration.from + 1).c_str()));
  }
  FORESIGHT_CHECK(CheckMissionSchema(database, file));
  return {};
}

}  // namespace

std::span<const MissionMigration> MissionMigrations() {
  return kMigrations;
}

Status MigrateMission(SqliteDatabase& database, int from, const std::string& file) {
  if (from == kMissionFormatVersion) return {};
  FORESIGHT_CHECK(database.Run("BEGIN IMMEDIATE"));
  Status done = RunAll(database, from, file);
  if (done) done = database.Run("COMMIT");
  if (!done && database.InTransaction()) (void)database.Run("ROLLBACK");
  return done;
}

}  // namespace foresight
