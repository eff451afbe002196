#pragma once

#include "core/mission/sqlite.h"

namespace foresight {

inline constexpr int kMissionApplicationId = 0x48434431;  ///< "HCD1", in the file's header
inline constexpr int kMissionFormatVersion = 1;           ///< user_version

/// Makes the tables of format 1 in an empty database, in one transaction.
Status CreateMissionSchema(SqliteDatabase& database);

/// Whether this is a mission file of the format that this program knows, with exactly its tables.
/// Fails with kBadData naming `file`.
Status CheckMissionSchema(const SqliteDatabase& database, const std::string& file);

}  // namespace foresight
