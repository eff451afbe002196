#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/result.h"

// SQLite itself is included in sqlite.cpp only.
struct sqlite3;
struct sqlite3_stmt;

namespace foresight {

/// One prepared statement: bind in order, step, read the columns in order. Errors name the file.
/// Only for the .cpp files of this folder.
class SqliteStatement {
 public:
  SqliteStatement& Bind(std::int64_t value);
  SqliteStatement& Bind(double value);  ///< NaN is stored as NULL
  SqliteStatement& BindNull();
  SqliteStatement& BindText(std::string_view text);
  SqliteStatement& BindBlob(std::string_view bytes);

  /// Advances; true = there is a row to read.
  Result<bool> Step();
  /// Runs to the end, for statements without rows.
  Status Run();

  /// Columns of the present row, counted from 0. A column of another type than asked for gives a
  /// zero or an empty value here, and is caught by the row's checksum.
  std::int64_t Integer(int column) const;
  bool IsNull(int column) const;
  double Number(int column) const;  ///< NULL is NaN
  std::string Text(int column) const;
  std::string Blob(int column) const { return Text(column); }

 private:
  friend class SqliteDatabase;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  SqliteStatement(sqlite3_stmt* statement, const std::string& file)
      : statement_(statement), file_(file) {}

  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  std::string file_;
  int bound_ = 0;
  int bind_error_ = 0;
};

/// One connection. Errors of SQLite become kIo (disk, rights, in use) or kBadData (damage), and
/// name the file.
class SqliteDatabase {
 public:
  /// kImmutable: of a file that nobody will change meanwhile; needs and leaves no file beside it.
  enum class Mode { kCreate, kReadWrite, kReadOnly, kImmutable };
  static Result<SqliteDatabase> Open(const std::filesystem::path& path, Mode mode);
  /// An empty one without a file.
  static Result<SqliteDatabase> OpenInMemory();

  Status Run(const char* sql);
  Result<SqliteStatement> Prepare(const char* sql) const;
  /// The first column of the first row.
  Result<std::int64_t> Integer(const char* sql) const;
  bool InTransaction() const;

 private:
  struct Close {
    void operator()(sqlite3* connection) const;
  };

  static Result<SqliteDatabase> OpenUri(const std::string& uri, const std::string& file, int flags);

  std::unique_ptr<sqlite3, Close> connection_;
  std::string file_;
};

}  // namespace foresight
