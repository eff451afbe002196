#pragma once

#include "core/mission/salvage_mission.h"
#include "core/mission/sqlite.h"
#include "core/mission/stored_tables.h"

namespace foresight {

/// Makes a mission of rows that were saved one by one, with gaps between them: scans say how much
/// they have, positions count up again, rows of what is lost go, and `report` tells each loss.
/// @param tables of the database, whose rows all have good checksums
Status MendSalvaged(SqliteDatabase& database, const std::vector<StoredTable>& tables,
                    const SalvageOptions& options, SalvageReport& report);

}  // namespace foresight
