#pragma once

#include "core/mission/sqlite.h"

namespace foresight {

inline constexpr int kMissionApplicationId = 0x48434431;  ///< "HCD1", in the file's header
inline constexpr int kMissionFormatVersion = 4;           ///< user_version of what is written now

/// Makes the tables of a format in an empty database, in one transaction.
Status CreateMissionSchema(SqliteDatabase& database, int format = kMissionFormatVersion);

/// Runs the statement that makes a table or index of the present format.
Status CreateMissionTable(SqliteDatabase& database, std::string_view name);

/// Which format the file says it has. Fails with kBadData naming `file` where a newer program wrote
/// it.
Result<int> MissionFormat(const SqliteDatabase& database, const std::string& file);

/// Whether this is a mission file of a format that this program knows, with exactly its tables;
/// returns the format. Fails with kBadData naming `file`.
Result<int> CheckMissionSchema(const SqliteDatabase& database, const std::string& file);

/// Checks the structure of all tables but those of lines, motor samples and pixels, which row
/// counts and checksums guard: milliseconds however large the mission is.
Status CheckSmallTables(const SqliteDatabase& database, int format, const std::string& file);

}  // namespace foresight
