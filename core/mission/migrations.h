#pragma once

#include <span>
#include <string>

#include "core/mission/sqlite.h"

namespace foresight {

/// Brings a mission file from one format to the next. Runs inside a transaction; `file` names the
/// file in errors.
struct MissionMigration {
  int from = 0;  ///< to from + 1
  Status (*run)(SqliteDatabase& database, const std::string& file) = nullptr;
};

/// All of them, from format 1 on, without a gap.
std::span<const MissionMigration> MissionMigrations();

/// Brings the file from format `from` to the present one, in one transaction: all steps or none.
/// Fails with kBadData where a row that must be copied is damaged; the file is unchanged then.
Status MigrateMission(SqliteDatabase& database, int from, const std::string& file);

}  // namespace foresight
