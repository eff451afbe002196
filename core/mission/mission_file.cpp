#include "core/mission/mission_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <optional>
#include <type_traits>

#include "core/base/atomic_file.h"
#include "core/base/log.h"
#include "core/base/publish_file.h"
#include "core/io/png.h"
#include "core/mission/damaged_rows.h"
#include "core/mission/file_handle.h"
#include "core/mission/migrations.h"
#include "core/mission/mission_schema.h"
#include "core/mission/record_rows.h"
#include "core/mission/scan_rows.h"
#include "core/mission/thumbnail.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

constexpr const char* kLeftRunning = "the recording program ended before the scan did";
constexpr const char* kCopiedRunning = "the mission was copied while the scan was running";
constexpr const char* kReviewKey = "review_of";  ///< in the table meta of a review
constexpr std::string_view kReviewSuffix = ".review.foresight";

bool SaysNoRoom(const std::string& message) {
  const auto says = [&](const std::string& text) {
    return message.find(text) != std::string::npos;
  };
  return says("disk is full") || says(std::strerror(EFBIG)) || says(std::strerror(EDQUOT));
}

/// SQLite puts its files beside the real one.
std::filesystem::path Neighbour(const std::filesystem::path& path, const char* suffix) {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::weakly_canonical(path, error);
  return (error ? path : real).string() + suffix;
}

bool Exists(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

/// What SQLite writes at the beginning of every file.
struct DatabaseHeader {
  bool write_ahead = false;  ///< the last writer did not close it, or is still there
};

/// Catches what is no database at all before SQLite would make one of it.
Result<DatabaseHeader> ReadHeader(const MissionFileHandle& handle, const std::string& file) {
  constexpr std::string_view kMagic("SQLite format 3\0", 16);
  constexpr std::size_t kReadVersion = 19;  // 2 = write-ahead log
  FORESIGHT_TRY(const std::string bytes, handle.FirstBytes(kReadVersion + 1));
  if (bytes.size() <= kReadVersion || !bytes.starts_with(kMagic))
    return Fail(
        ErrorCode::kBadData,
        "{}: is not a mission file (foresightctl mission import makes one of a point cloud)", file);
  return DatabaseHeader{bytes[kReadVersion] == 2};
}

/// What SQLite finds wrong with the trees of the file, at most `at_most` sentences.
Result<std::vector<std::string>> FaultsOfTrees(const SqliteDatabase& database,
                                               std::size_t at_most) {
  FORESIGHT_TRY(SqliteStatement check,
                database.Prepare(fmt::format("PRAGMA quick_check({})", at_most).c_str()));
  std::vector<std::string> faults;
  for (;;) {
    FORESIGHT_TRY(const bool row, check.Step());
    if (!row) return faults;
    if (check.Text(0) != "ok") faults.push_back(check.Text(0));
  }
}

Status QuickCheck(const SqliteDatabase& database, const std::string& file) {
  FORESIGHT_TRY(SqliteStatement check, database.Prepare("PRAGMA quick_check(1)"));
  FORESIGHT_TRY(const bool row, check.Step());
  if (row && check.Text(0) == "ok") return {};
  return Fail(ErrorCode::kBadData, "{}: the file is damaged: {}", file,
              row ? check.Text(0) : "no answer from its check");
}

/// SQLite fills a last page that was cut with zeros.
Status CheckSize(const SqliteDatabase& database, const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::int64_t page_bytes, database.Integer("PRAGMA page_size"));
  std::error_code error;
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path, error));
  if (error || page_bytes < 512 || size % page_bytes != 0)
    return Fail(ErrorCode::kBadData, "{}: was cut: {} bytes are not whole pages of {}",
                path.string(), size, page_bytes);
  return {};
}

Status SetDurable(SqliteDatabase& database, const std::string& file) {
  FORESIGHT_TRY(SqliteStatement journal, database.Prepare("PRAGMA journal_mode = WAL"));
  FORESIGHT_TRY(const bool row, journal.Step());
  if (!row || journal.Text(0) != "wal")
    return Fail(ErrorCode::kIo, "{}: this file system cannot hold a mission being recorded", file);
  FORESIGHT_CHECK(database.Run("PRAGMA synchronous = FULL"));
  return database.Run("PRAGMA foreign_keys = ON");
}

/// The writes of one call: all of them, or none.
class Savepoint {
 public:
  static Result<Savepoint> Begin(SqliteDatabase& database) {
    FORESIGHT_CHECK(database.Run("SAVEPOINT one_call"));
    return Savepoint(&database);
  }
  Savepoint(Savepoint&& other) noexcept : database_(std::exchange(other.database_, nullptr)) {}
  Savepoint& operator=(Savepoint&&) = delete;
  ~Savepoint() {
    if (database_ == nullptr) return;
    // A disk that is full has already rolled everything back; there is nobody left to tell.
    (void)database_->Run("ROLLBACK TO one_call");
    (void)database_->Run("RELEASE one_call");
  }
  Status Commit() {
    FORESIGHT_CHECK(database_->Run("RELEASE one_call"));
    database_ = nullptr;
    return {};
  }

 private:
  explicit Savepoint(SqliteDatabase* database) : database_(database) {}
  SqliteDatabase* database_;
};

/// Everything that is read during its life is of one moment.
class Snapshot {
 public:
  static Result<Snapshot> Begin(SqliteDatabase& database) {
    if (database.InTransaction()) return Snapshot(nullptr);
    FORESIGHT_CHECK(database.Run("BEGIN"));
    return Snapshot(&database);
  }
  Snapshot(Snapshot&& other) noexcept : database_(std::exchange(other.database_, nullptr)) {}
  Snapshot& operator=(Snapshot&&) = delete;
  ~Snapshot() {
    // Nothing was written: there is nothing that could be lost.
    if (database_ != nullptr) (void)database_->Run("ROLLBACK");
  }

 private:
  explicit Snapshot(SqliteDatabase* database) : database_(database) {}
  SqliteDatabase* database_;
};

/// Leaves one file where a writer could not, because somebody was still reading. SQLite refuses it
/// where anybody still is.
void MergeLog(const std::filesystem::path& path) {
  auto database = SqliteDatabase::Open(path, SqliteDatabase::Mode::kReadWrite);
  if (database) (void)database->Run("PRAGMA journal_mode = DELETE");
}

/// A scan that runs goes on in the file that was copied, and ends in its copy.
Status EndScansOfCopy(const std::filesystem::path& path) {
  FORESIGHT_TRY(SqliteDatabase database,
                SqliteDatabase::Open(path, SqliteDatabase::Mode::kReadWrite));
  const std::string file = path.string();  // rows refer to it
  ScanRows rows(database, file);
  FORESIGHT_TRY(const std::vector<ScanRow> scans, rows.ReadScanRows());
  for (const ScanRow& scan : scans)
    if (scan.state == ScanState::kRunning)
      FORESIGHT_CHECK(rows.EndScan(scan.id, ScanState::kInterrupted, kCopiedRunning));
  return {};
}

void RemoveNeighbours(const std::filesystem::path& path) {
  std::error_code ignored;
  for (const char* suffix : {"-wal", "-shm", "-journal"})
    std::filesystem::remove(Neighbour(path, suffix), ignored);
}

Status MarkAsReview(SqliteDatabase& database, const std::filesystem::path& path) {
  FORESIGHT_TRY(SqliteStatement insert,
                database.Prepare("INSERT INTO meta(key, value) VALUES(?, ?)"));
  return insert.BindText(kReviewKey).BindText(path.filename().string()).Run();
}

/// Where the review of a mission lies, if the folder can be written.
Result<std::filesystem::path> BesideMission(const std::filesystem::path& mission) {
  std::string name = mission.filename().string();
  if (name.ends_with(kReviewSuffix))
    return Fail(ErrorCode::kInvalidInput, "{}: is a review itself", mission.string());
  constexpr std::string_view kSuffix = ".foresight";
  if (name.ends_with(kSuffix) && name.size() > kSuffix.size())
    name.resize(name.size() - kSuffix.size());
  name += kReviewSuffix;
  return mission.parent_path() / name;
}

bool CanWriteTo(const std::filesystem::path& folder) {
  return ::access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) == 0;
}

}  // namespace

struct MissionFile::Impl {
  Impl(std::filesystem::path where, MissionFileHandle the_handle, SqliteDatabase opened,
       bool may_write)
      : path(std::move(where)),
        file(path.string()),
        file_id(the_handle.Id()),
        handle(std::move(the_handle)),
        database(std::move(opened)),
        writable(may_write) {}

  /// Recursive: Batch holds it while its body appends.
  std::recursive_mutex mutex;
  const std::filesystem::path path;
  const std::string file;
  const FileId file_id;                     ///< whatever lies at `path` by now
  std::optional<MissionFileHandle> handle;  ///< outlives the connection
  std::optional<SqliteDatabase> database;   ///< empty once closed
  const bool writable;
  bool review = false;
  bool closed_properly = true;
  /// A log that was there before anybody recorded: a crash left it, and a reader leaves it alone.
  bool found_log = false;
  std::int64_t running_scan = 0;  ///< 0 = none; ids begin at 1
  std::atomic<bool> wants_thumbnail{false};
  std::optional<std::int64_t> last_seq;
  std::optional<double> last_sample_s;
  bool in_batch = false;

  ScanRows Rows() { return {*database, file}; }

  Status CheckOpen() const {
    if (database) return {};
    return Fail(ErrorCode::kState, "{}: the mission file is closed", file);
  }

  Status CheckWritable() const {
    FORESIGHT_CHECK(CheckOpen());
    if (writable) return {};
    return Fail(ErrorCode::kState, "{}: was opened for reading only", file);
  }

  Status CheckRunning(std::int64_t scan_id) const {
    FORESIGHT_CHECK(CheckWritable());
    if (running_scan != 0 && scan_id == running_scan) return {};
    return Fail(ErrorCode::kState, "{}: scan {} is not being recorded", file, scan_id);
  }

  /// Takes back what a batch wrote, and where the scan stood before it, unless it was committed.
  class BatchGuard {
   public:
    explicit BatchGuard(Impl* impl)
        : impl_(impl),
          running_scan_(impl->running_scan),
          wants_thumbnail_(impl->wants_thumbnail),
          last_seq_(impl->last_seq),
          last_sample_s_(impl->last_sample_s) {
      impl->in_batch = true;
    }
    BatchGuard(BatchGuard&& other) noexcept
        : impl_(std::exchange(other.impl_, nullptr)),
          running_scan_(other.running_scan_),
          wants_thumbnail_(other.wants_thumbnail_),
          last_seq_(other.last_seq_),
          last_sample_s_(other.last_sample_s_) {}
    BatchGuard& operator=(BatchGuard&&) = delete;
    ~BatchGuard() {
      if (impl_ == nullptr) return;
      if (impl_->database->InTransaction()) (void)impl_->database->Run("ROLLBACK");
      impl_->in_batch = false;
      impl_->running_scan = running_scan_;
      impl_->wants_thumbnail = wants_thumbnail_;
      impl_->last_seq = last_seq_;
      impl_->last_sample_s = last_sample_s_;
    }
    Status Commit() {
      FORESIGHT_CHECK(impl_->CheckBatch());
      FORESIGHT_CHECK(impl_->database->Run("COMMIT"));
      impl_->in_batch = false;
      impl_ = nullptr;
      return {};
    }

   private:
    Impl* impl_;
    std::int64_t running_scan_;
    bool wants_thumbnail_;
    std::optional<std::int64_t> last_seq_;
    std::optional<double> last_sample_s_;
  };

  Result<BatchGuard> BeginBatch() {
    FORESIGHT_CHECK(database->Run("BEGIN IMMEDIATE"));
    return BatchGuard(this);
  }

  /// A write that the disk does not take makes SQLite take the whole batch back.
  Status CheckBatch() const {
    if (!in_batch || database->InTransaction()) return {};
    return Fail(ErrorCode::kIo, "{}: the disk did not take it", file);
  }

  /// Runs `body` as one call that is written whole or not at all.
  Status Write(const std::function<Status()>& body) {
    FORESIGHT_CHECK(CheckBatch());
    FORESIGHT_TRY(Savepoint savepoint, Savepoint::Begin(*database));
    FORESIGHT_CHECK(body());
    return savepoint.Commit();
  }

  Status EndScan(std::int64_t scan_id, ScanState state, const std::string& reason) {
    // A scan of which the end could not be written does not block the next one: it reads as
    // interrupted, and can be continued.
    running_scan = 0;
    return Write([&] { return Rows().EndScan(scan_id, state, reason); });
  }

  /// Runs `body(format)` on one moment of the file.
  template <class Body>
  auto Read(const Body& body) -> std::invoke_result_t<Body, int> {
    const std::lock_guard lock(mutex);
    FORESIGHT_CHECK(CheckOpen());
    FORESIGHT_TRY(const Snapshot snapshot, Snapshot::Begin(*database));
    // A writer may have brought the file to another format since it was opened.
    FORESIGHT_TRY(const int format, MissionFormat(*database, file));
    return body(format);
  }

  /// A row in state running when nobody records: read as what it is. `recorded_before` = there was
  /// a writer before the row was read.
  void TellWhatWasLeftRunning(ScanRow& row, bool recorded_before) const {
    if (row.state != ScanState::kRunning || row.id == running_scan) return;
    if (!writable && (recorded_before || handle->HasWriter())) return;
    row.state = ScanState::kInterrupted;
    row.reason = kLeftRunning;
  }

  bool Recorded() const { return handle && handle->HasWriter(); }

  Result<ScanRow> ReadRow(std::int64_t id, bool recorded_before) {
    FORESIGHT_TRY(ScanRow row, Rows().ReadScanRow(id));
    TellWhatWasLeftRunning(row, recorded_before);
    return row;
  }

  Result<std::vector<ScanSummary>> Summaries(std::optional<std::int64_t> id, int format,
                                             bool recorded_before) {
    std::vector<ScanRow> rows;
    if (id) {
      FORESIGHT_TRY(ScanRow row, Rows().ReadScanRow(*id));
      rows.push_back(std::move(row));
    } else {
      FORESIGHT_TRY(rows, Rows().ReadScanRows());
    }
    FORESIGHT_TRY(const auto objects, CountObjects(*database, format));
    FORESIGHT_TRY(const auto given, Rows().ScansWithGiven());
    std::map<std::int64_t, std::string> thumbnails;
    if (format > 1) {
      FORESIGHT_TRY(thumbnails, Rows().ReadThumbnails(id, false));
    }
    std::vector<ScanSummary> scans;
    for (ScanRow& row : rows) {
      if (row.lines < 0) {
        FORESIGHT_TRY(row.lines, Rows().CountLines(row.id));
        FORESIGHT_TRY(row.frames, Rows().CountFrames(row.id));
      }
      TellWhatWasLeftRunning(row, recorded_before);
      const auto count = objects.find(row.id);
      FORESIGHT_TRY(const double begin_s, Rows().FirstTime(row.id));
      const std::int64_t begin_utc_ns = row.start_utc_ns + static_cast<std::int64_t>(1e9 * begin_s);
      scans.push_back({row.id, row.uuid, row.start_utc_ns, begin_utc_ns, row.source, row.simulated,
                       row.plan, row.state, row.reason, given.contains(row.id), row.lines,
                       row.frames, count == objects.end() ? 0 : count->second,
                       std::move(thumbnails[row.id])});
    }
    return scans;
  }

  /// Completes what names a record's scan; both ids agree afterwards.
  template <class Record>
  Status FindScan(Record& record, const char* what) {
    if (record.scan_id == 0 && record.scan_uuid.empty())
      return Fail(ErrorCode::kInvalidInput, "{}: a {} must name its scan", file, what);
    FORESIGHT_TRY(
        SqliteStatement select,
        database->Prepare(record.scan_id != 0 ? "SELECT id, uuid FROM scan WHERE id = ?"
                                              : "SELECT id, uuid FROM scan WHERE uuid = ?"));
    if (record.scan_id != 0)
      select.Bind(record.scan_id);
    else
      select.BindText(record.scan_uuid);
    FORESIGHT_TRY(const bool found, select.Step());
    if (found) {
      const std::string uuid = select.Text(1);
      if (!record.scan_uuid.empty() && record.scan_uuid != uuid)
        return Fail(ErrorCode::kInvalidInput, "{}: scan {} is {}, not {}", file, record.scan_id,
                    uuid, record.scan_uuid);
      record.scan_id = select.Integer(0);
      record.scan_uuid = uuid;
      return {};
    }
    if (review && record.scan_id == 0) return {};
    if (record.scan_id != 0)
      return Fail(ErrorCode::kInvalidInput, "{}: there is no scan {} for a {}", file,
                  record.scan_id, what);
    return Fail(ErrorCode::kInvalidInput, "{}: there is no scan {} for a {}", file,
                record.scan_uuid, what);
  }

  Result<std::optional<std::int64_t>> IdOfUuid(const char* table, const std::string& uuid) {
    FORESIGHT_TRY(
        SqliteStatement select,
        database->Prepare(fmt::format("SELECT id FROM {} WHERE uuid = ?", table).c_str()));
    select.BindText(uuid);
    FORESIGHT_TRY(const bool found, select.Step());
    if (!found) return std::nullopt;
    return select.Integer(0);
  }

  Result<bool> ReadIsReview() const {
    FORESIGHT_TRY(SqliteStatement select, database->Prepare("SELECT 1 FROM meta WHERE key = ?"));
    return select.BindText(kReviewKey).Step();
  }

  Status InterruptLeftovers() {
    FORESIGHT_TRY(const std::vector<ScanRow> rows, Rows().ReadScanRows());
    for (const ScanRow& row : rows)
      if (row.state == ScanState::kRunning)
        FORESIGHT_CHECK(EndScan(row.id, ScanState::kInterrupted, kLeftRunning));
    return {};
  }
};

MissionFile::MissionFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

MissionFile::~MissionFile() {
  if (const Status status = Close(); !status) LogError("{}", status.error().message);
}

const std::filesystem::path& MissionFile::path() const {
  return impl_->path;
}

bool MissionFile::IsReview() const {
  return impl_->review;
}

bool MissionFile::HasMoved() const {
  const auto now = FileIdAt(impl_->path);
  return now && *now != impl_->file_id;
}

bool MissionFile::IsBeingRecorded() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->Recorded();
}

bool MissionFile::WasClosedProperly() const {
  return impl_->closed_properly;
}

Result<std::unique_ptr<MissionFile>> MissionFile::OpenForWriting(const std::filesystem::path& path,
                                                                 MissionFileHandle handle,
                                                                 OpenHow how) {
  using Mode = SqliteDatabase::Mode;
  const std::string file = path.string();
  const bool create = how != OpenHow::kExisting;
  DatabaseHeader header;
  if (!create) {
    FORESIGHT_TRY(header, ReadHeader(handle, file));
  }
  FORESIGHT_CHECK(handle.LockForWriting());
  FORESIGHT_TRY(SqliteDatabase database,
                SqliteDatabase::Open(path, create ? Mode::kCreate : Mode::kReadWrite));
  // Three lines of 1081 beams fill a page; only one would fit into the default size.
  if (create) FORESIGHT_CHECK(database.Run("PRAGMA page_size = 8192"));
  int format = kMissionFormatVersion;
  if (!create) {
    FORESIGHT_TRY(format, CheckMissionSchema(database, file));
    FORESIGHT_CHECK(CheckSize(database, path));
    FORESIGHT_CHECK(CheckSmallTables(database, format, file));
  }
  FORESIGHT_CHECK(SetDurable(database, file));
  if (create) FORESIGHT_CHECK(CreateMissionSchema(database));
  if (how == OpenHow::kCreateReview) FORESIGHT_CHECK(MarkAsReview(database, path));
  FORESIGHT_CHECK(MigrateMission(database, format, file));
  auto impl = std::make_unique<Impl>(path, std::move(handle), std::move(database), true);
  impl->closed_properly = !header.write_ahead;
  FORESIGHT_TRY(impl->review, impl->ReadIsReview());
  FORESIGHT_CHECK(impl->InterruptLeftovers());
  return std::unique_ptr<MissionFile>(new MissionFile(std::move(impl)));
}

Result<std::unique_ptr<MissionFile>> MissionFile::MakeNew(const std::filesystem::path& path,
                                                          OpenHow how) {
  FORESIGHT_TRY(MissionFileHandle handle, MissionFileHandle::Create(path));
  // A log left by a deleted mission of the same name would be played into the new one.
  RemoveNeighbours(path);
  auto made = OpenForWriting(path, std::move(handle), how);
  Status status = made ? SyncFolderOf(path) : tl::unexpected(made.error());
  if (status) return made;
  made = tl::unexpected(status.error());
  RemoveNeighbours(path);  // no stub is left that would block the path
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return made;
}

Result<std::unique_ptr<MissionFile>> MissionFile::Create(const std::filesystem::path& path) {
  return MakeNew(path, OpenHow::kCreate);
}

Result<std::unique_ptr<MissionFile>> MissionFile::Open(const std::filesystem::path& path) {
  FORESIGHT_TRY(MissionFileHandle handle, MissionFileHandle::Open(path));
  return OpenForWriting(path, std::move(handle), OpenHow::kExisting);
}

Result<std::unique_ptr<MissionFile>> MissionFile::OpenReadOnly(const std::filesystem::path& path) {
  using Mode = SqliteDatabase::Mode;
  const std::string file = path.string();
  FORESIGHT_TRY(MissionFileHandle handle, MissionFileHandle::Open(path));
  const bool recorded = handle.HasWriter();
  FORESIGHT_TRY(const DatabaseHeader header, ReadHeader(handle, file));
  const bool log = Exists(Neighbour(path, "-wal"));
  // A copy of a recording without its log: SQLite would make one, which a reader may not.
  const bool alone = header.write_ahead && !log && !recorded;
  FORESIGHT_TRY(SqliteDatabase database,
                SqliteDatabase::Open(path, alone ? Mode::kImmutable : Mode::kReadOnly));
  FORESIGHT_TRY(const int format, CheckMissionSchema(database, file));
  if (!recorded) FORESIGHT_CHECK(CheckSize(database, path));
  FORESIGHT_CHECK(CheckSmallTables(database, format, file));
  auto impl = std::make_unique<Impl>(path, std::move(handle), std::move(database), false);
  impl->closed_properly = !header.write_ahead;
  impl->found_log = log && !recorded;
  FORESIGHT_TRY(impl->review, impl->ReadIsReview());
  return std::unique_ptr<MissionFile>(new MissionFile(std::move(impl)));
}

Result<std::filesystem::path> MissionFile::ReviewPathOf(const std::filesystem::path& mission,
                                                        const std::filesystem::path& folder) {
  FORESIGHT_TRY(const std::filesystem::path beside, BesideMission(mission));
  if (::access(beside.c_str(), W_OK) == 0) return beside;
  if (!Exists(beside) && CanWriteTo(mission.parent_path())) return beside;
  if (!folder.empty() && CanWriteTo(folder)) return folder / beside.filename();
  return Fail(ErrorCode::kIo, "{}: cannot be written; give a folder for the review",
              beside.string());
}

Result<std::unique_ptr<MissionFile>> MissionFile::FindReviewOf(
    const std::filesystem::path& mission, const std::filesystem::path& folder) {
  FORESIGHT_TRY(const std::filesystem::path beside, BesideMission(mission));
  const auto written = ReviewPathOf(mission, folder);
  if (written && Exists(*written)) return OpenReadOnly(*written);
  if (Exists(beside)) return OpenReadOnly(beside);
  return nullptr;
}

Result<std::unique_ptr<MissionFile>> MissionFile::OpenReviewOf(
    const std::filesystem::path& mission, const std::filesystem::path& folder) {
  FORESIGHT_TRY(const std::filesystem::path path, ReviewPathOf(mission, folder));
  if (!Exists(path)) {
    // Who looks for the review meanwhile finds none, or a whole one.
    const std::filesystem::path part = Neighbour(path, ".part");
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    FORESIGHT_TRY(std::unique_ptr<MissionFile> made, MakeNew(part, OpenHow::kCreateReview));
    FORESIGHT_CHECK(made->Close());
    made.reset();
    FORESIGHT_CHECK(PublishFile(part, path));
  }
  FORESIGHT_TRY(std::unique_ptr<MissionFile> review, Open(path));
  if (!review->IsReview())
    return Fail(ErrorCode::kBadData, "{}: is a mission, not the review of one", path.string());
  return review;
}

Result<std::int64_t> MissionFile::BeginScan(const Scan& header) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckWritable());
  if (impl_->running_scan != 0)
    return Fail(ErrorCode::kState, "{}: scan {} is still being recorded", impl_->file,
                impl_->running_scan);
  FORESIGHT_CHECK(header.plan.Check());
  FORESIGHT_CHECK(header.rig.Check());
  std::int64_t id = 0;
  FORESIGHT_CHECK(impl_->Write([&]() -> Status {
    FORESIGHT_TRY(id, impl_->Rows().InsertScan(header));
    return {};
  }));
  impl_->running_scan = id;
  impl_->wants_thumbnail = true;
  impl_->last_seq.reset();
  impl_->last_sample_s.reset();
  return id;
}

Status MissionFile::ContinueScan(std::int64_t scan_id) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckWritable());
  if (impl_->running_scan != 0)
    return Fail(ErrorCode::kState, "{}: scan {} is still being recorded", impl_->file,
                impl_->running_scan);
  FORESIGHT_TRY(const MotorTrack track, LoadTrack(scan_id));
  FORESIGHT_TRY(const ScanSummary kept, Summary(scan_id));
  FORESIGHT_TRY(const std::optional<std::int64_t> last_seq, impl_->Rows().LastLine(scan_id));
  FORESIGHT_CHECK(impl_->Write([&] { return impl_->Rows().ReopenScan(scan_id); }));
  impl_->running_scan = scan_id;
  impl_->wants_thumbnail = kept.images == 0;
  impl_->last_seq = last_seq;
  impl_->last_sample_s.reset();
  if (!track.samples().empty()) impl_->last_sample_s = track.samples().back().time_s;
  return {};
}

Status MissionFile::AppendLine(std::int64_t scan_id, const LidarLine& line) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckRunning(scan_id));
  if (impl_->last_seq && line.seq <= *impl_->last_seq)
    return Fail(ErrorCode::kInvalidInput, "{}: scan {}: line {} comes after line {}", impl_->file,
                scan_id, line.seq, *impl_->last_seq);
  FORESIGHT_CHECK(impl_->Write([&] { return impl_->Rows().InsertLine(scan_id, line); }));
  impl_->last_seq = line.seq;
  return {};
}

Status MissionFile::AppendMotorSamples(std::int64_t scan_id, std::span<const MotorSample> samples) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckRunning(scan_id));
  std::vector<MotorSample> later;
  std::optional<double> last_s = impl_->last_sample_s;
  for (const MotorSample& sample : samples) {
    if (last_s && sample.time_s <= *last_s) continue;
    later.push_back(sample);
    last_s = sample.time_s;
  }
  if (later.empty()) return {};
  FORESIGHT_CHECK(impl_->Write([&] { return impl_->Rows().InsertMotorSamples(scan_id, later); }));
  impl_->last_sample_s = last_s;
  return {};
}

Status MissionFile::AppendFrame(std::int64_t scan_id, const CameraFrame& frame) {
  // Before the lock: it takes as long as a line's period.
  FORESIGHT_TRY(const std::string png, EncodePng(frame.image, PngContent::kCapture));
  std::string thumbnail;
  if (impl_->wants_thumbnail) {
    FORESIGHT_TRY(thumbnail, ThumbnailOf(frame.image));
  }
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckRunning(scan_id));
  const bool first = impl_->wants_thumbnail && !thumbnail.empty();
  const Status written = impl_->Write([&]() -> Status {
    FORESIGHT_CHECK(impl_->Rows().InsertFrame(scan_id, frame, png));
    return first ? impl_->Rows().InsertThumbnail(scan_id, thumbnail) : Status{};
  });
  if (written && first) impl_->wants_thumbnail = false;
  return written;
}

Status MissionFile::SetGivenCloud(std::int64_t scan_id, const GivenCloud& cloud) {
  FORESIGHT_CHECK(cloud.Check());
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckRunning(scan_id));
  FORESIGHT_TRY(const std::int64_t lines, impl_->Rows().CountLines(scan_id));
  if (lines > 0)
    return Fail(ErrorCode::kState, "{}: scan {} has {} lines already", impl_->file, scan_id, lines);
  return impl_->Write([&] { return impl_->Rows().InsertGiven(scan_id, cloud); });
}

Status MissionFile::EndScan(std::int64_t scan_id, ScanState state, const std::string& reason) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckRunning(scan_id));
  if (state == ScanState::kRunning)
    return Fail(ErrorCode::kInvalidInput, "{}: scan {} cannot end as running", impl_->file,
                scan_id);
  return impl_->EndScan(scan_id, state, reason);
}

Status MissionFile::Batch(const std::function<Status()>& body) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckWritable());
  if (impl_->in_batch) return body();  // a part of the batch around it
  FORESIGHT_TRY(Impl::BatchGuard guard, impl_->BeginBatch());
  FORESIGHT_CHECK(body());
  return guard.Commit();
}

Result<std::vector<ScanSummary>> MissionFile::ListScans() const {
  const bool recorded = IsBeingRecorded();
  return impl_->Read([&](int format) { return impl_->Summaries(std::nullopt, format, recorded); });
}

Result<ScanSummary> MissionFile::Summary(std::int64_t id) const {
  const bool recorded = IsBeingRecorded();
  return impl_->Read([&](int format) -> Result<ScanSummary> {
    FORESIGHT_TRY(std::vector<ScanSummary> scans, impl_->Summaries(id, format, recorded));
    return std::move(scans.front());
  });
}

Result<std::optional<std::int64_t>> MissionFile::FindScan(const std::string& uuid) const {
  return impl_->Read([&](int) { return impl_->IdOfUuid("scan", uuid); });
}

Result<std::optional<std::int64_t>> MissionFile::FindDetection(const std::string& uuid) const {
  using Found = Result<std::optional<std::int64_t>>;
  return impl_->Read([&](int format) -> Found {
    if (format > 1) return impl_->IdOfUuid("detection", uuid);
    // Format 1 has no uuid in its rows: what stands for it is made when they are read.
    FORESIGHT_TRY(const std::vector<DetectionRecord> records,
                  ReadDetections(*impl_->database, format, std::nullopt, impl_->file));
    for (const DetectionRecord& record : records)
      if (record.uuid == uuid) return record.id;
    return std::nullopt;
  });
}

Result<Scan> MissionFile::LoadHeader(std::int64_t id) const {
  const bool recorded = IsBeingRecorded();
  return impl_->Read([&](int) -> Result<Scan> {
    FORESIGHT_TRY(const ScanRow row, impl_->ReadRow(id, recorded));
    return impl_->Rows().ReadHeader(row);
  });
}

Result<Scan> MissionFile::LoadScan(std::int64_t id) const {
  const bool recorded = IsBeingRecorded();
  return impl_->Read([&](int) -> Result<Scan> {
    FORESIGHT_TRY(ScanRow row, impl_->Rows().ReadScanRow(id));
    FORESIGHT_TRY(Scan scan, impl_->Rows().ReadScan(row));
    impl_->TellWhatWasLeftRunning(row, recorded);
    scan.state = row.state;
    scan.reason = row.reason;
    return scan;
  });
}

Result<std::vector<LidarLine>> MissionFile::LoadLines(std::int64_t id, std::int64_t first_seq,
                                                      std::size_t at_most) const {
  return impl_->Read([&](int) -> Result<std::vector<LidarLine>> {
    FORESIGHT_CHECK(impl_->Rows().ReadScanRow(id));
    return impl_->Rows().ReadLines(id, first_seq, at_most);
  });
}

Result<MotorTrack> MissionFile::LoadTrack(std::int64_t id) const {
  return impl_->Read([&](int) -> Result<MotorTrack> {
    FORESIGHT_TRY(const ScanRow row, impl_->Rows().ReadScanRow(id));
    return impl_->Rows().ReadTrack(row);
  });
}

Result<std::vector<ImageSummary>> MissionFile::ListImages(std::int64_t id) const {
  return impl_->Read([&](int) -> Result<std::vector<ImageSummary>> {
    FORESIGHT_TRY(const ScanRow row, impl_->Rows().ReadScanRow(id));
    return impl_->Rows().ReadImageList(row);
  });
}

Result<CameraFrame> MissionFile::LoadImage(std::int64_t id, std::int64_t position) const {
  return impl_->Read([&](int) -> Result<CameraFrame> {
    FORESIGHT_CHECK(impl_->Rows().ReadScanRow(id));
    return impl_->Rows().ReadImage(id, position);
  });
}

Result<std::int64_t> MissionFile::AddDetection(const DetectionRecord& detection) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckWritable());
  DetectionRecord record = detection;
  record.id = 0;
  if (record.uuid.empty()) record.uuid = NewUuid();
  FORESIGHT_TRY(const auto known, impl_->IdOfUuid("detection", record.uuid));
  if (known) return *known;
  FORESIGHT_CHECK(impl_->FindScan(record, "detection"));
  return InsertDetection(*impl_->database, record);
}

Status MissionFile::AddDetectionEvent(std::int64_t detection_id, const DetectionEvent& event) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckWritable());
  FORESIGHT_TRY(SqliteStatement select,
                impl_->database->Prepare("SELECT 1 FROM detection WHERE id = ?"));
  FORESIGHT_TRY(const bool found, select.Bind(detection_id).Step());
  if (!found)
    return Fail(ErrorCode::kInvalidInput, "{}: there is no detection {}", impl_->file,
                detection_id);
  return InsertDetectionEvent(*impl_->database, detection_id, event);
}

Result<std::vector<DetectionRecord>> MissionFile::ListDetections(
    std::optional<std::int64_t> scan_id) const {
  return impl_->Read(
      [&](int format) { return ReadDetections(*impl_->database, format, scan_id, impl_->file); });
}

Result<std::vector<DetectionEvent>> MissionFile::ListDetectionEvents(
    std::int64_t detection_id) const {
  return impl_->Read([&](int format) -> Result<std::vector<DetectionEvent>> {
    if (format == 1) return std::vector<DetectionEvent>();
    FORESIGHT_TRY(auto events, ReadDetectionEvents(*impl_->database, detection_id, impl_->file));
    return std::move(events[detection_id]);
  });
}

Result<std::int64_t> MissionFile::AddDepth(const DepthRecord& depth) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckWritable());
  DepthRecord record = depth;
  if (record.uuid.empty()) record.uuid = NewUuid();
  FORESIGHT_TRY(const auto known, impl_->IdOfUuid("depth", record.uuid));
  if (known) return *known;
  FORESIGHT_CHECK(impl_->FindScan(record, "depth map"));
  return InsertDepth(*impl_->database, record);
}

Result<std::vector<DepthRecord>> MissionFile::ListDepths(
    std::optional<std::int64_t> scan_id) const {
  return impl_->Read([&](int format) -> Result<std::vector<DepthRecord>> {
    if (format == 1) return std::vector<DepthRecord>();
    return ReadDepths(*impl_->database, scan_id, impl_->file);
  });
}

Result<std::int64_t> MissionFile::AddNote(const NoteRecord& note) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckWritable());
  NoteRecord record = note;
  if (record.kind != kNoteKind && record.kind != kMeasurementKind)
    return Fail(ErrorCode::kInvalidInput, "{}: '{}' is no kind of note", impl_->file, record.kind);
  if (record.uuid.empty()) record.uuid = NewUuid();
  FORESIGHT_TRY(record.tags, TagsFrom(record.tags));
  if (record.scan_id != 0 || !record.scan_uuid.empty())
    FORESIGHT_CHECK(impl_->FindScan(record, "note"));
  return InsertNote(*impl_->database, record);
}

Result<std::vector<NoteRecord>> MissionFile::ListNotes() const {
  return impl_->Read([&](int format) -> Result<std::vector<NoteRecord>> {
    if (format < 4) return std::vector<NoteRecord>();
    return ReadNotes(*impl_->database, impl_->file);
  });
}

Status MissionFile::AddRig(const SensorRig& rig) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckWritable());
  FORESIGHT_CHECK(rig.Check());
  return impl_->Write([&] { return impl_->Rows().InsertRig(rig); });
}

Result<std::optional<SensorRig>> MissionFile::FindRig(const std::string& rig_id) const {
  return impl_->Read([&](int) -> Result<std::optional<SensorRig>> {
    FORESIGHT_TRY(const std::vector<SensorRig> rigs, impl_->Rows().ReadRigs());
    for (const SensorRig& rig : rigs)
      if (RigId(rig) == rig_id) return rig;
    return std::nullopt;
  });
}

Result<std::int64_t> MissionFile::AddEvent(const EventRecord& event) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckWritable());
  return InsertEvent(*impl_->database, event);
}

Result<std::vector<EventRecord>> MissionFile::ListEvents() const {
  return impl_->Read([&](int) { return ReadEvents(*impl_->database, impl_->file); });
}

Status MissionFile::Verify(const RunContext& context) const {
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, ListScans());
  const Status structure = impl_->Read([&](int format) -> Status {
    FORESIGHT_CHECK(QuickCheck(*impl_->database, impl_->file));
    if (format > 1) FORESIGHT_CHECK(impl_->Rows().ReadThumbnails(std::nullopt, true));
    return {};
  });
  FORESIGHT_CHECK(structure);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (context.Cancelled())
      return Fail(ErrorCode::kCancelled, "{}: the check was cancelled", impl_->file);
    context.Report(static_cast<double>(i) / static_cast<double>(scans.size()), "checking scans");
    FORESIGHT_CHECK(LoadScan(scans[i].id));
  }
  FORESIGHT_CHECK(ListDetections());
  FORESIGHT_CHECK(ListDepths());
  FORESIGHT_CHECK(ListNotes());
  FORESIGHT_CHECK(ListEvents());
  return {};
}

Result<DamageReport> MissionFile::FindDamage(std::size_t at_most, const RunContext& context) const {
  const Status whole = Verify(context.Part(0.0, 0.5));
  if (whole) return DamageReport();
  if (whole.error().code != ErrorCode::kBadData) return tl::unexpected(whole.error());
  const auto name_rows = [&](int) -> Result<DamageReport> {
    FORESIGHT_TRY(const std::vector<StoredTable> tables, ReadStoredTables(*impl_->database));
    DamagedRows rows(tables, at_most);
    if (const auto faults = FaultsOfTrees(*impl_->database, at_most))
      for (const std::string& fault : *faults) rows.Tell({"file", "", fault});
    FORESIGHT_CHECK(ReadThroughTables(*impl_->database, tables, rows, context.Part(0.5, 0.9)));
    return rows.Report();
  };
  FORESIGHT_TRY(DamageReport report, impl_->Read(name_rows));
  // Rows with a good checksum can still contradict each other.
  for (const std::int64_t id : report.sound_scans)
    if (const auto scan = LoadScan(id); !scan)
      report.Add({"scan", fmt::format("scan {}", id), scan.error().message}, at_most);
  if (report.count == 0) report.Add({"file", "", whole.error().message}, at_most);
  return report;
}

Status MissionFile::ExportTo(const std::filesystem::path& path) const {
  if (impl_->writable && !HasMoved()) {  // the recording goes on meanwhile
    FORESIGHT_TRY(const std::unique_ptr<MissionFile> reader, OpenReadOnly(impl_->path));
    return reader->ExportTo(path);
  }
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckOpen());
  FORESIGHT_TRY(const std::filesystem::path target, ResolveOutput(path));
  std::error_code error;
  if (const auto there = FileIdAt(target); there && *there == impl_->file_id)
    return Fail(ErrorCode::kInvalidInput, "{}: cannot be exported onto itself", impl_->file);
  const std::filesystem::path part = Neighbour(target, ".part");
  std::filesystem::remove(part, error);
  const bool recorded = impl_->writable || impl_->Recorded();
  FORESIGHT_TRY(SqliteStatement copy, impl_->database->Prepare("VACUUM INTO ?"));
  Status status = copy.BindText(part.string()).Run();
  if (status && recorded) {
    // A copy whose scan reads as left running is worth more than none.
    if (const Status ended = EndScansOfCopy(part); !ended) LogWarning("{}", ended.error().message);
  }
  if (!status) {
    std::filesystem::remove(part, error);
    std::string why = status.error().message;
    // A reader writes nothing: what has no room is the copy, whatever file SQLite names.
    if (const std::string named = impl_->file + ": "; why.starts_with(named) && SaysNoRoom(why))
      why.erase(0, named.size());
    return Fail(ErrorCode::kIo, "{}: cannot export: {}", target.string(), why);
  }
  return PublishFile(part, target);
}

Status MissionFile::Close() {
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->database) return {};
  Status status;
  if (impl_->running_scan != 0)
    status = impl_->EndScan(impl_->running_scan, ScanState::kInterrupted,
                            "the mission file was closed during the scan");
  if (impl_->writable && status) status = impl_->database->Run("PRAGMA wal_checkpoint(TRUNCATE)");
  // Refused while somebody reads; then the last reader does it.
  // It takes the log away by its name, which may be another file's by now.
  if (impl_->writable && status && !HasMoved())
    (void)impl_->database->Run("PRAGMA journal_mode = DELETE");
  impl_->database.reset();
  if (!impl_->writable && !impl_->found_log && !impl_->handle->HasWriter() &&
      Exists(Neighbour(impl_->path, "-wal")))
    MergeLog(impl_->path);
  impl_->handle.reset();
  return status;
}

}  // namespace foresight
