#include "core/mission/salvage_mission.h"

#include <map>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/publish_file.h"
#include "core/mission/mend_salvaged.h"
#include "core/mission/migrations.h"
#include "core/mission/mission_file.h"
#include "core/mission/mission_schema.h"
#include "core/mission/row_checksum.h"
#include "core/mission/sqlite_pages.h"
#include "core/mission/stored_tables.h"

namespace foresight {
namespace {

using Row = std::vector<StoredValue>;

/// Puts every row with a good checksum into the tables of a new, empty file.
class Collector {
 public:
  Collector(const SqlitePages& pages, SqliteDatabase& database,
            const std::vector<StoredTable>& tables)
      : pages_(pages), database_(database), tables_(tables) {}

  Status Run(const RunContext& context) {
    FORESIGHT_CHECK(VisitAll(context.Part(0.0, 0.6),
                             [this](const StoredRow& row) { return TakeChecked(row); }));
    for (const auto& [id, row] : scans_) Insert(Named("scan"), row);
    // Pixels carry no checksum themselves, their image does: so they come second.
    FORESIGHT_CHECK(ReadPixelChecksums());
    FORESIGHT_CHECK(
        VisitAll(context.Part(0.6, 1.0), [this](const StoredRow& row) { return TakePixels(row); }));
    return {};
  }

  std::int64_t rows() const { return rows_; }

 private:
  const StoredTable& Named(std::string_view name) const { return TableNamed(tables_, name); }

  Status VisitAll(const RunContext& context, const SqlitePages::Accept& accept) {
    for (std::uint32_t page = 1; page <= pages_.count(); ++page) {
      if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the recovery was cancelled");
      if (page % 64 == 1)
        context.Report(static_cast<double>(page) / pages_.count(), "reading pages");
      FORESIGHT_CHECK(pages_.VisitRows(page, accept));
      FORESIGHT_CHECK(status_);
    }
    return {};
  }

  bool TakeChecked(const StoredRow& stored) {
    for (const StoredTable& table : tables_) {
      const auto row = AsRowOf(table, stored);
      if (!row) continue;
      if (!table.checksum) {
        if (table.name == "meta") return TakeMeta(table, *row);
        if (table.name == "image_data") return true;  // for the second time round
        continue;
      }
      if (!HasGoodChecksum(table, *row)) continue;
      if (table.name == "scan")
        TakeScan(*row);
      else
        Insert(table, *row);
      return true;
    }
    return false;
  }

  /// What a review says of itself; nothing else stands there.
  bool TakeMeta(const StoredTable& table, const Row& row) {
    if (row != Row{"review_of", row.back()}) return false;
    Insert(table, row);
    return true;
  }

  /// A page that SQLite no longer uses may hold an older state of the row: the ended one counts.
  void TakeScan(const Row& row) {
    const StoredTable& table = Named("scan");
    const auto id = std::get<std::int64_t>(row[*table.rowid]);
    const auto [known, is_new] = scans_.try_emplace(id, row);
    const StoredValue running = std::string(ToString(ScanState::kRunning));
    const std::size_t state = table.ColumnOf("state");
    if (!is_new && known->second[state] == running) known->second = row;
  }

  Status ReadPixelChecksums() {
    const StoredTable& table = Named("image");
    FORESIGHT_TRY(const std::vector<Row> images, ReadStored(database_, table, "true"));
    for (const Row& image : images)
      pixels_[{std::get<std::int64_t>(image[0]), std::get<std::int64_t>(image[1])}] =
          std::get<std::int64_t>(image[table.ColumnOf("data_crc32")]);
    return {};
  }

  bool TakePixels(const StoredRow& stored) {
    const StoredTable& table = Named("image_data");
    const auto row = AsRowOf(table, stored);
    if (!row) return TakeNothing(stored);
    const auto* scan = std::get_if<std::int64_t>(&row->at(0));
    const auto* position = std::get_if<std::int64_t>(&row->at(1));
    const auto* png = std::get_if<StoredBlob>(&row->at(2));
    if (scan == nullptr || position == nullptr || png == nullptr) return TakeNothing(stored);
    const auto wanted = pixels_.find({*scan, *position});
    if (wanted == pixels_.end() || RowChecksum().Add(png->bytes).value() != wanted->second)
      return false;
    Insert(table, *row);
    return true;
  }

  /// Second time round: rows that were taken at the first are no reason to look closer.
  bool TakeNothing(const StoredRow& stored) const {
    for (const StoredTable& table : tables_) {
      const auto row = AsRowOf(table, stored);
      if (row && table.checksum && HasGoodChecksum(table, *row)) return true;
    }
    return false;
  }

  void Insert(const StoredTable& table, const Row& row) {
    if (!status_) return;
    const auto inserted = InsertStored(database_, table, row);
    if (!inserted)
      status_ = tl::unexpected(inserted.error());
    else if (*inserted)
      ++rows_;
  }

  const SqlitePages& pages_;
  SqliteDatabase& database_;
  const std::vector<StoredTable>& tables_;
  std::map<std::int64_t, Row> scans_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> pixels_;  ///< CRC by scan, position
  std::int64_t rows_ = 0;
  Status status_;
};

Status Quick(SqliteDatabase& database) {
  // The file is new and gets its name at the very end: it needs no journal.
  FORESIGHT_TRY(SqliteStatement journal, database.Prepare("PRAGMA journal_mode = OFF"));
  FORESIGHT_CHECK(journal.Run());
  FORESIGHT_CHECK(database.Run("PRAGMA synchronous = OFF"));
  return database.Run("PRAGMA foreign_keys = OFF");
}

Result<SalvageReport> SalvageInto(const std::filesystem::path& part, const SqlitePages& pages,
                                  const std::filesystem::path& damaged,
                                  const SalvageOptions& options, const RunContext& context) {
  FORESIGHT_TRY(SqliteDatabase database, SqliteDatabase::Open(part, SqliteDatabase::Mode::kCreate));
  FORESIGHT_CHECK(database.Run("PRAGMA page_size = 8192"));
  FORESIGHT_CHECK(Quick(database));
  const int format = pages.user_version() == 1 ? 1 : kMissionFormatVersion;
  FORESIGHT_CHECK(CreateMissionSchema(database, format));
  FORESIGHT_TRY(const std::vector<StoredTable> tables, ReadStoredTables(database));
  FORESIGHT_CHECK(database.Run("BEGIN"));
  Collector collector(pages, database, tables);
  FORESIGHT_CHECK(collector.Run(context.Part(0.0, 0.9)));
  if (collector.rows() == 0)
    return Fail(ErrorCode::kBadData, "{}: nothing of a mission was found in {} pages",
                damaged.string(), pages.count());
  SalvageReport report;
  FORESIGHT_CHECK(MendSalvaged(database, tables, options, report));
  FORESIGHT_CHECK(database.Run("COMMIT"));
  FORESIGHT_CHECK(MigrateMission(database, format, part.string()));
  return report;
}

/// What was written is read again by who will read it.
Status VerifySalvaged(const std::filesystem::path& part, const RunContext& context) {
  FORESIGHT_TRY(const std::unique_ptr<MissionFile> mission, MissionFile::OpenReadOnly(part));
  return mission->Verify(context);
}

}  // namespace

Result<SalvageReport> SalvageMission(const std::filesystem::path& damaged,
                                     const std::filesystem::path& target,
                                     const SalvageOptions& options, const RunContext& context) {
  if (options.rig) FORESIGHT_CHECK(options.rig->Check());
  FORESIGHT_TRY(const SqlitePages pages, SqlitePages::Open(damaged));
  FORESIGHT_TRY(const std::filesystem::path resolved, ResolveOutput(target));
  std::error_code error;
  if (std::filesystem::equivalent(resolved, damaged, error))
    return Fail(ErrorCode::kInvalidInput, "{}: cannot be recovered onto itself", damaged.string());
  const std::filesystem::path part = resolved.string() + ".part";
  std::filesystem::remove(part, error);
  auto report = SalvageInto(part, pages, damaged, options, context);
  Status status = report ? Status() : Status(tl::unexpected(report.error()));
  if (status) status = VerifySalvaged(part, context.Part(0.9, 1.0));
  if (!status) {
    std::filesystem::remove(part, error);
    return tl::unexpected(status.error());
  }
  FORESIGHT_CHECK(PublishFile(part, resolved));
  return report;
}

}  // namespace foresight
