#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/mission/mission_records.h"
#include "core/mission/sqlite.h"

namespace foresight {

// Detections, depth maps, notes and events: rows <-> values, each with its checksum. `file` names
// the file in errors, `format` is the file's (the writers write the present one).

/// Writes the record as it is; an id of 0 is replaced by a new one. Returns the id.
Result<std::int64_t> InsertDetection(SqliteDatabase& database, DetectionRecord detection);
/// With the state that its events give it. Of one scan of this file, or of all.
Result<std::vector<DetectionRecord>> ReadDetections(const SqliteDatabase& database, int format,
                                                    std::optional<std::int64_t> scan_id,
                                                    const std::string& file);
/// How many detections of each scan are not deleted.
Result<std::map<std::int64_t, std::int64_t>> CountObjects(const SqliteDatabase& database,
                                                          int format);

Status InsertDetectionEvent(SqliteDatabase& database, std::int64_t detection_id,
                            const DetectionEvent& event);
/// Of one detection or of every one, by its id, oldest first.
Result<std::map<std::int64_t, std::vector<DetectionEvent>>> ReadDetectionEvents(
    const SqliteDatabase& database, std::optional<std::int64_t> detection_id,
    const std::string& file);

Result<std::int64_t> InsertDepth(SqliteDatabase& database, DepthRecord depth);
Result<std::vector<DepthRecord>> ReadDepths(const SqliteDatabase& database,
                                            std::optional<std::int64_t> scan_id,
                                            const std::string& file);

Result<std::int64_t> InsertNote(SqliteDatabase& database, NoteRecord note);
/// The state that counts of every note, in the order in which they were made.
Result<std::vector<NoteRecord>> ReadNotes(const SqliteDatabase& database, const std::string& file);

Result<std::int64_t> InsertEvent(SqliteDatabase& database, EventRecord event);
Result<std::vector<EventRecord>> ReadEvents(const SqliteDatabase& database,
                                            const std::string& file);

}  // namespace foresight
