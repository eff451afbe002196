#pragma once

#include <vector>

#include "core/mission/kept_check.h"
#include "core/mission/mission_file.h"
#include "core/mission/new_records.h"
#include "ui/viewmodels/session_model.h"

namespace foresight {

/// A found object as a mission keeps it. `scan_id` is left for the file to fill in.
DetectionRecord RecordOf(const FoundObject& object, const std::string& author);
DetectionEvent EventOf(const ObjectEvent& event, const std::string& author);

/// The reverse, of an object found in a scan that began at `scan_begin_utc_ns` and has this rig.
Result<FoundObject> ObjectOf(const DetectionRecord& record, const SensorRig& rig,
                             std::int64_t scan_begin_utc_ns);

/// Writes the record into the file, or the event into the object's record there. A record that is
/// there already is left as it is.
Status KeepObject(MissionFile* file, const FoundObject& object, const std::string& author);
Status KeepObjectEvent(MissionFile* file, const ObjectEvent& event, const std::string& author);

/// Adds the state of a note or a measurement. Its scan is found by its uuid.
Status KeepNote(MissionFile* file, NoteRecord note);

/// Adds what a scan said about itself. kInvalidInput: the file does not have the scan.
Status KeepCheck(MissionFile* file, const KeptCheck& check);

/// Notes how a depth map of the scan is made again, with its checksum.
Status KeepDepth(MissionFile* file, const Scan& scan, const DepthResult& depth);

/// Writes what the file does not have of a scan that has ended: all of it where its file could not
/// be written, the end where the disk was full, lines that came late. Fails as CompleteScan does;
/// the next try goes on where the file is then.
Status AppendScan(MissionFile* file, const Scan& scan, const RunContext& context);

}  // namespace foresight
