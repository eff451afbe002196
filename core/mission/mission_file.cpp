#include "core/mission/mission_file.h"

#include <fstream>
#include <mutex>
#include <optional>

#include "core/base/log.h"
#include "core/io/png.h"
#include "core/mission/annotation_rows.h"
#include "core/mission/mission_schema.h"
#include "core/mission/scan_rows.h"

namespace foresight {
namespace {

constexpr const char* kLeftRunning = "the recording program ended before the scan did";

std::filesystem::path Neighbour(const std::filesystem::path& path, const char* suffix) {
  return path.string() + suffix;
}

bool HasBytes(const std::filesystem::path& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return !error && size > 0;
}

/// Catches what is no database at all before SQLite would make one of it.
Status CheckIsDatabase(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    return Fail(ErrorCode::kIo, "{}: {}", path.string(),
                std::filesystem::exists(path, error) ? "is not a file" : "does not exist");
  std::ifstream stream(path, std::ios::binary);
  std::string magic(16, '\0');
  stream.read(magic.data(), 16);
  if (!stream && stream.gcount() == 0 && std::filesystem::file_size(path, error) > 0)
    return Fail(ErrorCode::kIo, "{}: cannot read", path.string());
  if (magic != std::string("SQLite format 3\0", 16))
    return Fail(ErrorCode::kBadData, "{}: is not a mission file", path.string());
  return {};
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

}  // namespace

struct MissionFile::Impl {
  Impl(std::filesystem::path where, SqliteDatabase opened, bool may_write)
      : path(std::move(where)),
        file(path.string()),
        database(std::move(opened)),
        writable(may_write) {}

  /// Recursive: Batch holds it while its body appends.
  std::recursive_mutex mutex;
  const std::filesystem::path path;
  const std::string file;
  std::optional<SqliteDatabase> database;  ///< empty once closed
  const bool writable;
  std::int64_t running_scan = 0;  ///< 0 = none; ids begin at 1
  std::optional<std::int64_t> last_seq;
  std::optional<double> last_sample_s;

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

  /// Runs `body` as one call that is written whole or not at all.
  Status Write(const std::function<Status()>& body) {
    FORESIGHT_TRY(Savepoint savepoint, Savepoint::Begin(*database));
    FORESIGHT_CHECK(body());
    return savepoint.Commit();
  }

  Status EndScan(std::int64_t scan_id, ScanState state, const std::string& reason) {
    FORESIGHT_CHECK(Write([&] { return Rows().EndScan(scan_id, state, reason); }));
    running_scan = 0;
    return {};
  }

  /// A row in state running when nobody records: read as what it is.
  void TellWhatWasLeftRunning(ScanRow& row) const {
    if (row.state != ScanState::kRunning || row.id == running_scan) return;
    row.state = ScanState::kInterrupted;
    row.reason = kLeftRunning;
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

Result<std::unique_ptr<MissionFile>> MissionFile::OpenForWriting(const std::filesystem::path& path,
                                                                 bool create) {
  using Mode = SqliteDatabase::Mode;
  const std::string file = path.string();
  FORESIGHT_TRY(SqliteDatabase database,
                SqliteDatabase::Open(path, create ? Mode::kCreate : Mode::kReadWrite));
  // One program at a time: two recorders in one file would interrupt each other's scans. It also
  // keeps the write-ahead log's index in memory, so no third file appears.
  FORESIGHT_CHECK(database.Run("PRAGMA locking_mode = EXCLUSIVE"));
  if (!create) {
    FORESIGHT_CHECK(CheckMissionSchema(database, file));
    FORESIGHT_CHECK(CheckSize(database, path));
    FORESIGHT_CHECK(QuickCheck(database, file));
  }
  // Three lines of 1081 beams fill a page; only one would fit into the default size.
  if (create) FORESIGHT_CHECK(database.Run("PRAGMA page_size = 8192"));
  FORESIGHT_CHECK(SetDurable(database, file));
  if (create) FORESIGHT_CHECK(CreateMissionSchema(database));
  auto impl = std::make_unique<Impl>(path, std::move(database), true);
  FORESIGHT_CHECK(impl->InterruptLeftovers());
  return std::unique_ptr<MissionFile>(new MissionFile(std::move(impl)));
}

Result<std::unique_ptr<MissionFile>> MissionFile::Create(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error))
    return Fail(ErrorCode::kIo, "{}: exists already", path.string());
  // A log left by a deleted mission of the same name would be played into the new one.
  std::filesystem::remove(Neighbour(path, "-wal"), error);
  std::filesystem::remove(Neighbour(path, "-journal"), error);
  return OpenForWriting(path, true);
}

Result<std::unique_ptr<MissionFile>> MissionFile::Open(const std::filesystem::path& path) {
  FORESIGHT_CHECK(CheckIsDatabase(path));
  return OpenForWriting(path, false);
}

Result<std::unique_ptr<MissionFile>> MissionFile::OpenReadOnly(const std::filesystem::path& path) {
  FORESIGHT_CHECK(CheckIsDatabase(path));
  // Without a log beside it the file is complete by itself, and can be read where nothing may be
  // written, not even SQLite's lock and index files.
  std::error_code error;
  const bool complete = !std::filesystem::exists(Neighbour(path, "-wal"), error) &&
                        !HasBytes(Neighbour(path, "-journal"));
  using Mode = SqliteDatabase::Mode;
  FORESIGHT_TRY(SqliteDatabase database,
                SqliteDatabase::Open(path, complete ? Mode::kImmutable : Mode::kReadOnly));
  const std::string file = path.string();
  FORESIGHT_CHECK(CheckMissionSchema(database, file));
  FORESIGHT_CHECK(CheckSize(database, path));
  FORESIGHT_CHECK(QuickCheck(database, file));
  return std::unique_ptr<MissionFile>(
      new MissionFile(std::make_unique<Impl>(path, std::move(database), false)));
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
  impl_->last_seq.reset();
  impl_->last_sample_s.reset();
  return id;
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
  FORESIGHT_TRY(const std::string png, EncodePng(frame.image));
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckRunning(scan_id));
  return impl_->Write([&] { return impl_->Rows().InsertFrame(scan_id, frame, png); });
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
  if (impl_->database->InTransaction()) return body();  // a part of the batch around it
  const std::int64_t running_before = impl_->running_scan;
  FORESIGHT_CHECK(impl_->database->Run("BEGIN IMMEDIATE"));
  Status status = body();
  const Status committed =
      impl_->database->InTransaction() ? impl_->database->Run("COMMIT") : Status{};
  if (!committed) {
    (void)impl_->database->Run("ROLLBACK");
    impl_->running_scan = running_before;
    return committed;
  }
  return status;
}

Result<std::vector<ScanSummary>> MissionFile::ListScans() const {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckOpen());
  FORESIGHT_TRY(std::vector<ScanRow> rows, impl_->Rows().ReadScanRows());
  std::vector<ScanSummary> scans;
  for (ScanRow& row : rows) {
    if (row.lines < 0) {
      FORESIGHT_TRY(row.lines, impl_->Rows().CountLines(row.id));
      FORESIGHT_TRY(row.frames, impl_->Rows().CountFrames(row.id));
    }
    impl_->TellWhatWasLeftRunning(row);
    scans.push_back({row.id, row.uuid, row.start_utc_ns, row.source, row.simulated, row.plan,
                     row.state, row.reason, row.lines, row.frames});
  }
  return scans;
}

Result<Scan> MissionFile::LoadScan(std::int64_t id) const {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckOpen());
  FORESIGHT_TRY(Scan scan, impl_->Rows().ReadScan(id));
  if (scan.state == ScanState::kRunning && id != impl_->running_scan) {
    scan.state = ScanState::kInterrupted;
    scan.reason = kLeftRunning;
  }
  return scan;
}

Result<std::int64_t> MissionFile::AddDetection(const DetectionRecord& detection) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckWritable());
  return InsertDetection(*impl_->database, detection);
}

Result<std::vector<DetectionRecord>> MissionFile::ListDetections() const {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckOpen());
  return ReadDetections(*impl_->database, impl_->file);
}

Result<std::int64_t> MissionFile::AddEvent(const EventRecord& event) {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckWritable());
  return InsertEvent(*impl_->database, event);
}

Result<std::vector<EventRecord>> MissionFile::ListEvents() const {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckOpen());
  return ReadEvents(*impl_->database, impl_->file);
}

Status MissionFile::Verify(const RunContext& context) const {
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, ListScans());
  {
    const std::lock_guard lock(impl_->mutex);
    FORESIGHT_CHECK(impl_->CheckOpen());
    FORESIGHT_CHECK(QuickCheck(*impl_->database, impl_->file));
  }
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (context.Cancelled())
      return Fail(ErrorCode::kCancelled, "{}: the check was cancelled", impl_->file);
    context.Report(static_cast<double>(i) / static_cast<double>(scans.size()), "checking scans");
    FORESIGHT_CHECK(LoadScan(scans[i].id));
  }
  FORESIGHT_CHECK(ListDetections());
  FORESIGHT_CHECK(ListEvents());
  return {};
}

Status MissionFile::ExportTo(const std::filesystem::path& target) const {
  const std::lock_guard lock(impl_->mutex);
  FORESIGHT_CHECK(impl_->CheckOpen());
  std::error_code error;
  if (std::filesystem::equivalent(target, impl_->path, error))
    return Fail(ErrorCode::kInvalidInput, "{}: cannot be exported onto itself", impl_->file);
  const std::filesystem::path part = Neighbour(target, ".part");
  std::filesystem::remove(part, error);
  FORESIGHT_TRY(SqliteStatement copy, impl_->database->Prepare("VACUUM INTO ?"));
  if (Status status = copy.BindText(part.string()).Run(); !status) {
    std::filesystem::remove(part, error);
    return Fail(ErrorCode::kIo, "{}: cannot export: {}", target.string(), status.error().message);
  }
  std::filesystem::rename(part, target, error);
  if (error)
    return Fail(ErrorCode::kIo, "{}: cannot replace: {}", target.string(), error.message());
  return {};
}

Status MissionFile::Close() {
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->database) return {};
  Status status;
  if (impl_->running_scan != 0)
    status = impl_->EndScan(impl_->running_scan, ScanState::kInterrupted,
                            "the mission file was closed during the scan");
  if (impl_->writable && status) status = impl_->database->Run("PRAGMA wal_checkpoint(TRUNCATE)");
  if (impl_->writable && status) status = impl_->database->Run("PRAGMA journal_mode = DELETE");
  impl_->database.reset();
  return status;
}

}  // namespace foresight
