#include "core/mission/merge_missions.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/publish_file.h"
#include "core/mission/mission_file.h"
#include "core/mission/mission_schema.h"
#include "core/mission/stored_tables.h"

namespace foresight {
namespace {

using Row = std::vector<StoredValue>;

/// A mission that is read row by row; of format 1 a migrated copy, which goes with this.
class Source {
 public:
  static Result<Source> Open(const std::filesystem::path& path,
                             const std::filesystem::path& scratch) {
    Source source;
    FORESIGHT_TRY(source.mission_, MissionFile::OpenReadOnly(path));
    FORESIGHT_TRY(SqliteDatabase database, OpenRows(path));
    FORESIGHT_TRY(const int format, MissionFormat(database, path.string()));
    if (format == kMissionFormatVersion) {
      source.database_ = std::make_unique<SqliteDatabase>(std::move(database));
      return source;
    }
    source.scratch_ = scratch;
    FORESIGHT_CHECK(source.mission_->ExportTo(scratch));
    FORESIGHT_TRY(const auto migrated, MissionFile::Open(scratch));
    FORESIGHT_CHECK(migrated->Close());
    FORESIGHT_TRY(source.mission_, MissionFile::OpenReadOnly(scratch));
    FORESIGHT_TRY(SqliteDatabase copy, OpenRows(scratch));
    source.database_ = std::make_unique<SqliteDatabase>(std::move(copy));
    return source;
  }
  Source(Source&&) = default;
  Source& operator=(Source&&) = delete;
  ~Source() {
    if (scratch_.empty()) return;
    database_.reset();
    mission_.reset();
    std::error_code ignored;
    std::filesystem::remove(scratch_, ignored);
  }

  const MissionFile& mission() const { return *mission_; }
  const SqliteDatabase& database() const { return *database_; }

 private:
  Source() = default;
  static Result<SqliteDatabase> OpenRows(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::path real = std::filesystem::weakly_canonical(path, error);
    const bool log = std::filesystem::exists((error ? path : real).string() + "-wal", error);
    return SqliteDatabase::Open(
        path, log ? SqliteDatabase::Mode::kReadOnly : SqliteDatabase::Mode::kImmutable);
  }

  std::unique_ptr<MissionFile> mission_;
  std::unique_ptr<SqliteDatabase> database_;
  std::filesystem::path scratch_;
};

class Merger {
 public:
  Merger(SqliteDatabase& target, const std::vector<StoredTable>& tables,
         const MergeOptions& options)
      : target_(target), tables_(tables), options_(options) {}

  Status Add(const Source& source, const RunContext& context) {
    file_ = source.mission().path().string();
    detections_.clear();
    FORESIGHT_TRY(const std::vector<ScanSummary> scans, source.mission().ListScans());
    double done = 0.0;
    for (const ScanSummary& scan : scans) {
      if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the merge was cancelled");
      context.Report(done++ / static_cast<double>(scans.size()), "copying scans");
      FORESIGHT_CHECK(AddScan(source.database(), scan));
    }
    FORESIGHT_CHECK(AddRigsWithoutScan(source.database()));
    FORESIGHT_CHECK(AddRecords(source.database(), "detection", report_.detections));
    FORESIGHT_CHECK(AddRecords(source.database(), "depth", report_.depth_maps));
    FORESIGHT_CHECK(AddDetectionEvents(source.database()));
    FORESIGHT_CHECK(AddNotes(source.database()));
    return AddEvents(source.database());
  }

  const MergeReport& report() const { return report_; }

 private:
  const StoredTable& Named(std::string_view name) const { return TableNamed(tables_, name); }

  Status CheckRow(const StoredTable& table, const Row& row) const {
    if (!table.checksum || HasGoodChecksum(table, row)) return {};
    return Fail(ErrorCode::kBadData,
                "{}: a row of its table '{}' is damaged (checksum): recover the file first "
                "(foresightctl mission recover)",
                file_, table.name);
  }

  Result<std::int64_t> NextId(const char* table) {
    return target_.Integer(fmt::format("SELECT coalesce(max(id), 0) + 1 FROM {}", table).c_str());
  }

  Status Put(const StoredTable& table, Row& row) {
    if (table.checksum) row[*table.checksum] = ChecksumOf(table, row);
    FORESIGHT_CHECK(InsertStored(target_, table, row));
    return {};
  }

  Status AddScan(const SqliteDatabase& from, const ScanSummary& scan) {
    const StoredTable& table = Named("scan");
    if (options_.keep && !options_.keep(scan)) {
      ++report_.left_out;
      left_out_.insert(scan.uuid);
      return {};
    }
    FORESIGHT_TRY(std::vector<Row> rows, ReadStored(from, table, fmt::format("id = {}", scan.id)));
    FORESIGHT_CHECK(CheckRow(table, rows.front()));
    Row& row = rows.front();
    if (scan_ids_.contains(scan.uuid)) return CheckSame(scan);
    FORESIGHT_TRY(const std::int64_t id, NextId("scan"));
    FORESIGHT_TRY(const std::int64_t rig, AddRig(from, WholeOf(table, row, "calibration_id")));
    row[*table.rowid] = id;
    row[table.ColumnOf("calibration_id")] = rig;
    for (const char* part : {"line", "given_line", "motor", "image", "image_data", "thumbnail"})
      FORESIGHT_CHECK(CopyPart(from, Named(part), scan.id, id));
    // A scan that is being recorded, or was left so, ends here with what it has.
    if (row[table.ColumnOf("state")] == StoredValue(std::string("running"))) {
      row[table.ColumnOf("state")] = std::string(ToString(ScanState::kInterrupted));
      row[table.ColumnOf("reason")] =
          scan.reason.empty() ? std::string("copied while it was being recorded") : scan.reason;
      FORESIGHT_TRY(row[table.ColumnOf("lines")], Count(scan.imported ? "given_line" : "line", id));
      FORESIGHT_TRY(row[table.ColumnOf("motor_batches")], Count("motor", id));
      FORESIGHT_TRY(row[table.ColumnOf("frames")], Count("image", id));
    }
    FORESIGHT_CHECK(Put(table, row));
    scan_ids_[scan.uuid] = id;
    fingerprints_[scan.uuid] = Fingerprint(scan);
    ++report_.scans;
    return {};
  }

  Result<StoredValue> Count(const char* table, std::int64_t scan_id) {
    FORESIGHT_TRY(
        const std::int64_t count,
        target_.Integer(
            fmt::format("SELECT count(*) FROM {} WHERE scan_id = {}", table, scan_id).c_str()));
    return StoredValue(count);
  }

  /// What two copies of one scan agree in.
  static std::string Fingerprint(const ScanSummary& scan) {
    return fmt::format("{} {} {} lines, {} images, {}", scan.start_utc_ns, scan.source, scan.lines,
                       scan.images, ToString(scan.state));
  }

  Status CheckSame(const ScanSummary& scan) {
    ++report_.already_there;
    if (fingerprints_.at(scan.uuid) == Fingerprint(scan)) return {};
    return Fail(ErrorCode::kInvalidInput,
                "{}: scan {} ({}) is also in an earlier file, but differs there: {} here, {} "
                "there. Leave one of them out",
                file_, scan.id, scan.uuid, Fingerprint(scan), fingerprints_.at(scan.uuid));
  }

  Result<std::int64_t> AddRig(const SqliteDatabase& from, std::int64_t id) {
    const StoredTable& table = Named("calibration");
    FORESIGHT_TRY(std::vector<Row> rows, ReadStored(from, table, fmt::format("id = {}", id)));
    if (rows.empty()) return Fail(ErrorCode::kBadData, "{}: calibration {} is missing", file_, id);
    FORESIGHT_CHECK(CheckRow(table, rows.front()));
    const std::string yaml = std::get<std::string>(rows.front()[table.ColumnOf("rig_yaml")]);
    const auto known = rigs_.find(yaml);
    if (known != rigs_.end()) return known->second;
    FORESIGHT_TRY(const std::int64_t next, NextId("calibration"));
    rows.front()[*table.rowid] = next;
    FORESIGHT_CHECK(Put(table, rows.front()));
    rigs_[yaml] = next;
    return next;
  }

  /// Rigs that side results were made with in place of their scan's own.
  Status AddRigsWithoutScan(const SqliteDatabase& from) {
    FORESIGHT_TRY(SqliteStatement select,
                  from.Prepare("SELECT id FROM calibration WHERE id NOT IN (SELECT calibration_id "
                               "FROM scan) ORDER BY id"));
    for (;;) {
      FORESIGHT_TRY(const bool more, select.Step());
      if (!more) return {};
      FORESIGHT_CHECK(AddRig(from, select.Integer(0)));
    }
  }

  /// In pieces: the pixels of a scan need not fit into memory.
  Status CopyPart(const SqliteDatabase& from, const StoredTable& table, std::int64_t scan_id,
                  std::int64_t new_scan_id) {
    const std::size_t scan = table.ColumnOf("scan_id");
    const int at_a_time = table.name == "image_data" ? 1 : 200;
    for (std::int64_t offset = 0;; offset += at_a_time) {
      FORESIGHT_TRY(std::vector<Row> rows,
                    ReadStored(from, table,
                               fmt::format("scan_id = {} ORDER BY 1, 2 LIMIT {} OFFSET {}", scan_id,
                                           at_a_time, offset)));
      for (Row& row : rows) {
        FORESIGHT_CHECK(CheckRow(table, row));
        row[scan] = new_scan_id;
        FORESIGHT_CHECK(Put(table, row));
      }
      if (rows.size() < static_cast<std::size_t>(at_a_time)) return {};
    }
  }

  /// Detections or depth maps. A record that is there already, by its uuid, stays.
  Status AddRecords(const SqliteDatabase& from, const char* name, std::int64_t& count) {
    const StoredTable& table = Named(name);
    FORESIGHT_TRY(std::vector<Row> rows, ReadStored(from, table, "true ORDER BY id"));
    for (Row& row : rows) {
      FORESIGHT_CHECK(CheckRow(table, row));
      const std::int64_t old_id = WholeOf(table, row, "id");
      const std::string scan_uuid = std::get<std::string>(row[table.ColumnOf("scan_uuid")]);
      const auto scan = scan_ids_.find(scan_uuid);
      if (scan == scan_ids_.end() && left_out_.contains(scan_uuid)) continue;
      row[table.ColumnOf("scan_id")] =
          scan == scan_ids_.end() ? StoredValue() : StoredValue(scan->second);
      FORESIGHT_TRY(const std::int64_t id, NextId(name));
      row[*table.rowid] = id;
      row[*table.checksum] = ChecksumOf(table, row);
      FORESIGHT_TRY(const bool inserted, InsertStored(target_, table, row));
      if (inserted) ++count;
      if (std::string_view(name) != "detection") continue;
      const std::string uuid = std::get<std::string>(row[table.ColumnOf("uuid")]);
      if (inserted) detection_ids_[uuid] = id;
      detections_[old_id] = detection_ids_.at(uuid);
    }
    return {};
  }

  Status AddDetectionEvents(const SqliteDatabase& from) {
    const StoredTable& table = Named("detection_event");
    FORESIGHT_TRY(std::vector<Row> rows, ReadStored(from, table, "true ORDER BY id"));
    for (Row& row : rows) {
      FORESIGHT_CHECK(CheckRow(table, row));
      const auto detection = detections_.find(WholeOf(table, row, "detection_id"));
      if (detection == detections_.end()) continue;
      row[table.ColumnOf("detection_id")] = detection->second;
      FORESIGHT_CHECK(PutOnce(table, row));
    }
    return {};
  }

  /// Every state of every note, but for those of scans that are left out.
  Status AddNotes(const SqliteDatabase& from) {
    const StoredTable& table = Named("note");
    FORESIGHT_TRY(std::vector<Row> rows, ReadStored(from, table, "true ORDER BY id"));
    for (Row& row : rows) {
      FORESIGHT_CHECK(CheckRow(table, row));
      const std::string scan_uuid = std::get<std::string>(row[table.ColumnOf("scan_uuid")]);
      const auto scan = scan_ids_.find(scan_uuid);
      if (scan == scan_ids_.end() && left_out_.contains(scan_uuid)) continue;
      row[table.ColumnOf("scan_id")] =
          scan == scan_ids_.end() ? StoredValue() : StoredValue(scan->second);
      FORESIGHT_CHECK(PutOnce(table, row));
    }
    FORESIGHT_TRY(report_.notes, target_.Integer("SELECT count(DISTINCT uuid) FROM note"));
    return {};
  }

  Status AddEvents(const SqliteDatabase& from) {
    const StoredTable& table = Named("event");
    FORESIGHT_TRY(std::vector<Row> rows, ReadStored(from, table, "true ORDER BY id"));
    for (Row& row : rows) {
      FORESIGHT_CHECK(CheckRow(table, row));
      FORESIGHT_CHECK(PutOnce(table, row));
    }
    FORESIGHT_TRY(report_.events, target_.Integer("SELECT count(*) FROM event"));
    return {};
  }

  /// Under a new id, unless a row with the same contents came from an earlier source.
  Status PutOnce(const StoredTable& table, Row& row) {
    Row contents = row;
    contents[*table.rowid] = StoredValue();
    contents[*table.checksum] = StoredValue();
    if (!told_[table.name].insert(contents).second) return {};
    FORESIGHT_TRY(const std::int64_t id, NextId(table.name.c_str()));
    row[*table.rowid] = id;
    return Put(table, row);
  }

  SqliteDatabase& target_;
  const std::vector<StoredTable>& tables_;
  const MergeOptions& options_;
  MergeReport report_;
  std::string file_;  ///< the source at hand
  std::map<std::string, std::int64_t> scan_ids_;
  std::map<std::string, std::string> fingerprints_;
  std::set<std::string> left_out_;
  std::map<std::string, std::int64_t> rigs_;
  std::map<std::string, std::int64_t> detection_ids_;  ///< by uuid, in the target
  std::map<std::int64_t, std::int64_t> detections_;    ///< ids of the source -> of the target
  std::map<std::string, std::set<Row>> told_;          ///< by table
};

Result<MergeReport> MergeInto(const std::filesystem::path& part,
                              std::span<const std::filesystem::path> sources,
                              const MergeOptions& options, const RunContext& context) {
  FORESIGHT_TRY(SqliteDatabase database, SqliteDatabase::Open(part, SqliteDatabase::Mode::kCreate));
  FORESIGHT_CHECK(database.Run("PRAGMA page_size = 8192"));
  FORESIGHT_TRY(SqliteStatement journal, database.Prepare("PRAGMA journal_mode = OFF"));
  FORESIGHT_CHECK(journal.Run());
  FORESIGHT_CHECK(database.Run("PRAGMA synchronous = OFF"));
  FORESIGHT_CHECK(database.Run("PRAGMA foreign_keys = OFF"));
  FORESIGHT_CHECK(CreateMissionSchema(database));
  FORESIGHT_TRY(const std::vector<StoredTable> tables, ReadStoredTables(database));
  FORESIGHT_CHECK(database.Run("BEGIN"));
  Merger merger(database, tables, options);
  const auto all = static_cast<double>(sources.size());
  // Missions before reviews: what a review holds belongs to scans that must be there.
  for (const bool reviews : {false, true}) {
    for (std::size_t i = 0; i < sources.size(); ++i) {
      FORESIGHT_TRY(const Source source, Source::Open(sources[i], part.string() + ".format1"));
      if (source.mission().IsReview() != reviews) continue;
      const double done = static_cast<double>(i);
      FORESIGHT_CHECK(merger.Add(source, context.Part(done / all, (done + 1.0) / all)));
    }
  }
  FORESIGHT_CHECK(database.Run("COMMIT"));
  return merger.report();
}

}  // namespace

Result<MergeReport> MergeMissions(std::span<const std::filesystem::path> sources,
                                  const std::filesystem::path& target, const MergeOptions& options,
                                  const RunContext& context) {
  FORESIGHT_TRY(const std::filesystem::path resolved, ResolveOutput(target));
  std::error_code error;
  for (const std::filesystem::path& source : sources)
    if (std::filesystem::equivalent(resolved, source, error))
      return Fail(ErrorCode::kInvalidInput, "{}: is one of the missions that are read",
                  target.string());
  const std::filesystem::path part = resolved.string() + ".part";
  std::filesystem::remove(part, error);
  auto report = MergeInto(part, sources, options, context);
  if (!report) {
    std::filesystem::remove(part, error);
    return report;
  }
  FORESIGHT_CHECK(PublishFile(part, resolved));
  return report;
}

}  // namespace foresight
