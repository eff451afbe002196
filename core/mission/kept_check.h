#pragma once

#include <string>
#include <vector>

#include "core/mission/mission_file.h"
#include "core/selfcheck/check_scan.h"

namespace foresight {

/// What a scan said about itself, kept with it: an event that names the scan (docs/formats.md,
/// "Self-checks").
struct KeptCheck {
  std::string scan_uuid;
  std::string author;
  std::int64_t utc_ns = 0;
  std::string answer_json;  ///< ScanCheckToJson, bit for bit

  // Of the answer: what is gathered over scans (core/mission/gather_checks.h).
  std::string rig_id;  ///< of the rig that was checked
  RigCheck rig;        ///< its measurements alone, RigMeasurementsFromJson

  // Of the answer: what a lamp shows.
  CheckLight light = CheckLight::kNotSeen;
  std::string advice;
  std::vector<CheckPoint> points;
  std::vector<std::string> cannot_see;
};

/// All that a check found and what it was made with, as one JSON object.
std::string ScanCheckToJson(const ScanCheck& check, const Scan& scan,
                            const ScanCheckOptions& options);

/// A check as it is kept: now, by this operator.
KeptCheck NewKeptCheck(const Scan& scan, const ScanCheck& check, const ScanCheckOptions& options);

/// Adds a check to `file`: the scan's mission, or the review beside it. Fails as
/// MissionFile::AddEvent.
Status AddScanCheck(MissionFile& file, const KeptCheck& check);

/// All that were kept, the oldest first. Fails with kBadData, naming the event at fault.
Result<std::vector<KeptCheck>> ListScanChecks(const MissionFile& file);

/// The newest check of each scan with each rig that it was checked with, in a mission and the
/// review beside it, which may be nullptr. Fails as ListScanChecks does.
Result<std::vector<KeptCheck>> NewestScanChecks(const MissionFile& mission,
                                                const MissionFile* review);

/// What was accepted in a scan, ready to be made again: detections that are not deleted, with a
/// provenance that names this scan's rig. `left_out` gets a sentence for each that cannot be made
/// again. The frames are those of `scan`, which must outlive the answer.
std::vector<KeptObject> AcceptedObjects(const Scan& scan,
                                        const std::vector<DetectionRecord>& records,
                                        std::vector<std::string>& left_out);

}  // namespace foresight
