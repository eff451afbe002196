#include "core/mission/sqlite.h"

#include <sqlite3.h>

#include <limits>
#include <system_error>

namespace foresight {
namespace {

/// The largest value that a row may claim to hold: a raw 20000 x 20000 image does not belong
/// here, and a damaged length must not become an allocation.
constexpr int kMaxValueBytes = 256 << 20;
/// A writer waits for readers only while it opens and closes the file.
constexpr int kBusyTimeout_ms = 5000;

tl::unexpected<Error> SqliteFailure(sqlite3* connection, int code, const std::string& file) {
  const char* detail = connection != nullptr ? sqlite3_errmsg(connection) : sqlite3_errstr(code);
  switch (code & 0xff) {
    case SQLITE_NOTADB:
      return Fail(ErrorCode::kBadData, "{}: is not a mission file", file);
    case SQLITE_CORRUPT:
    case SQLITE_MISMATCH:
    case SQLITE_ERROR:
    case SQLITE_TOOBIG:
    case SQLITE_SCHEMA:
      return Fail(ErrorCode::kBadData, "{}: the file is damaged: {}", file, detail);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return Fail(ErrorCode::kIo, "{}: is in use by another program", file);
    case SQLITE_READONLY:
      return Fail(ErrorCode::kIo, "{}: is write-protected", file);
    case SQLITE_FULL:
      return Fail(ErrorCode::kIo, "{}: the disk is full (make room there)", file);
    case SQLITE_IOERR: {
      const int system = connection != nullptr ? sqlite3_system_errno(connection) : 0;
      if (system == 0) return Fail(ErrorCode::kIo, "{}: {}", file, detail);
      return Fail(ErrorCode::kIo, "{}: {}: {}", file, detail,
                  std::generic_category().message(system));
    }
    case SQLITE_CONSTRAINT:
      return Fail(ErrorCode::kInvalidInput, "{}: {}", file, detail);
    default:
      return Fail(ErrorCode::kIo, "{}: {}", file, detail);
  }
}

/// A file: URI; SQLite takes '?', '#' and '%' in it as its own.
std::string Uri(const std::filesystem::path& path, bool immutable) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    if (c == '?' || c == '#' || c == '%')
      fmt::format_to(std::back_inserter(uri), "%{:02x}", static_cast<unsigned char>(c));
    else
      uri += c;
  }
  return immutable ? uri + "?immutable=1" : uri;
}

int OpenFlags(SqliteDatabase::Mode mode) {
  // Our own mutex serialises the calls, so SQLite's is not needed.
  constexpr int kCommon = SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE;
  switch (mode) {
    case SqliteDatabase::Mode::kCreate:
      return kCommon | SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    case SqliteDatabase::Mode::kReadWrite:
      return kCommon | SQLITE_OPEN_READWRITE;
    default:
      return kCommon | SQLITE_OPEN_READONLY;
  }
}

}  // namespace

void SqliteStatement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

SqliteStatement& SqliteStatement::Bind(std::int64_t value) {
  const int code = sqlite3_bind_int64(statement_.get(), ++bound_, value);
  if (code != SQLITE_OK) bind_error_ = code;
  return *this;
}

SqliteStatement& SqliteStatement::Bind(double value) {
  const int code = sqlite3_bind_double(statement_.get(), ++bound_, value);
  if (code != SQLITE_OK) bind_error_ = code;
  return *this;
}

SqliteStatement& SqliteStatement::BindNull() {
  const int code = sqlite3_bind_null(statement_.get(), ++bound_);
  if (code != SQLITE_OK) bind_error_ = code;
  return *this;
}

SqliteStatement& SqliteStatement::BindText(std::string_view text) {
  // The text outlives the statement's run in every use here, but a copy costs nothing worth a trap.
  const int code = sqlite3_bind_text64(statement_.get(), ++bound_, text.data(), text.size(),
                                       SQLITE_TRANSIENT, SQLITE_UTF8);
  if (code != SQLITE_OK) bind_error_ = code;
  return *this;
}

SqliteStatement& SqliteStatement::BindBlob(std::string_view bytes) {
  // A null pointer would be stored as NULL, not as an empty blob.
  const char* data = bytes.empty() ? "" : bytes.data();
  const int code =
      sqlite3_bind_blob64(statement_.get(), ++bound_, data, bytes.size(), SQLITE_TRANSIENT);
  if (code != SQLITE_OK) bind_error_ = code;
  return *this;
}

Result<bool> SqliteStatement::Step() {
  sqlite3* connection = sqlite3_db_handle(statement_.get());
  if (bind_error_ != SQLITE_OK) return SqliteFailure(nullptr, bind_error_, file_);
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  return SqliteFailure(connection, code, file_);
}

Status SqliteStatement::Run() {
  for (;;) {
    FORESIGHT_TRY(const bool row, Step());
    if (!row) return {};
  }
}

std::int64_t SqliteStatement::Integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

bool SqliteStatement::IsNull(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

double SqliteStatement::Number(int column) const {
  if (IsNull(column)) return std::numeric_limits<double>::quiet_NaN();
  return sqlite3_column_double(statement_.get(), column);
}

std::string SqliteStatement::Text(int column) const {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return bytes == nullptr || size <= 0 ? std::string()
                                       : std::string(bytes, static_cast<std::size_t>(size));
}

void SqliteDatabase::Close::operator()(sqlite3* connection) const {
  sqlite3_close_v2(connection);
}

bool SqliteDatabase::InTransaction() const {
  return sqlite3_get_autocommit(connection_.get()) == 0;
}

Result<SqliteDatabase> SqliteDatabase::Open(const std::filesystem::path& path, Mode mode) {
  return OpenUri(Uri(path, mode == Mode::kImmutable), path.string(), OpenFlags(mode));
}

Result<SqliteDatabase> SqliteDatabase::OpenInMemory() {
  return OpenUri("file::memory:", "memory", OpenFlags(Mode::kCreate));
}

Result<SqliteDatabase> SqliteDatabase::OpenUri(const std::string& uri, const std::string& file,
                                               int flags) {
  SqliteDatabase database;
  database.file_ = file;
  sqlite3* connection = nullptr;
  const int code = sqlite3_open_v2(uri.c_str(), &connection, flags, nullptr);
  database.connection_.reset(connection);
  if (code != SQLITE_OK) return SqliteFailure(connection, code, database.file_);
  sqlite3_busy_timeout(connection, kBusyTimeout_ms);
  sqlite3_limit(connection, SQLITE_LIMIT_LENGTH, kMaxValueBytes);
  // A file from elsewhere is data: nothing in its schema may run.
  sqlite3_db_config(connection, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  FORESIGHT_CHECK(database.Run("PRAGMA trusted_schema = OFF"));
  FORESIGHT_CHECK(database.Run("PRAGMA cell_size_check = ON"));
  return database;
}

Status SqliteDatabase::Run(const char* sql) {
  const int code = sqlite3_exec(connection_.get(), sql, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) return SqliteFailure(connection_.get(), code, file_);
  return {};
}

Result<SqliteStatement> SqliteDatabase::Prepare(const char* sql) const {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(connection_.get(), sql, -1, &statement, nullptr);
  if (code != SQLITE_OK) return SqliteFailure(connection_.get(), code, file_);
  return SqliteStatement(statement, file_);
}

Result<std::int64_t> SqliteDatabase::Integer(const char* sql) const {
  FORESIGHT_TRY(SqliteStatement statement, Prepare(sql));
  FORESIGHT_TRY(const bool row, statement.Step());
  return row ? statement.Integer(0) : 0;
}

}  // namespace foresight
