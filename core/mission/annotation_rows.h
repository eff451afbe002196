#pragma once

#include "core/mission/mission_file.h"
#include "core/mission/sqlite.h"

namespace foresight {

/// Detections and events: rows <-> values, each with its checksum. Ids are given here; `file` names
/// the file in errors.
Result<std::int64_t> InsertDetection(SqliteDatabase& database, DetectionRecord detection);
Result<std::vector<DetectionRecord>> ReadDetections(const SqliteDatabase& database,
                                                    const std::string& file);
Result<std::int64_t> InsertEvent(SqliteDatabase& database, EventRecord event);
Result<std::vector<EventRecord>> ReadEvents(const SqliteDatabase& database,
                                            const std::string& file);

}  // namespace foresight
