#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/mission/mission_file.h"

namespace foresight {

/// Which row of the timeline something belongs to.
enum class TimelineLane { kScans, kDepth, kFits, kDecisions, kSends, kAlarms, kLink };
inline constexpr int kTimelineLanes = 7;

/// Something that happened in a mission, or took a while.
struct TimelineEntry {
  enum class Kind {
    kScan,         ///< from its first line to its last one
    kCutScan,      ///< a scan that was aborted or interrupted
    kDepth,        ///< a depth map was computed
    kFound,        ///< an object was fitted
    kAccepted,     ///< the operator decided so
    kRejected,     ///< the same
    kOtherAction,  ///< reopened, renamed, deleted, restored
    kSent,         ///< the robot's side answered
    kWarning,      ///< of the mission's log
    kError,        ///< the same
    kLinkUp,       ///< from then to the next change
    kLinkLost      ///< the same
  };
  TimelineLane lane = TimelineLane::kScans;
  Kind kind = Kind::kScan;
  std::int64_t begin_utc_ns = 0;
  std::int64_t end_utc_ns = 0;  ///< equals begin_utc_ns for what takes no time
  std::string scan_uuid;        ///< of the scan that it belongs to; empty = none
  std::string object_uuid;      ///< of the object; empty = none
  std::string text;             ///< what it is, in one line
  bool in_review = false;       ///< it was made while the mission was reviewed

  bool operator==(const TimelineEntry&) const = default;
};

/// All that happened in a mission, in time.
struct MissionTimeline {
  std::vector<TimelineEntry> entries;  ///< by their begin
  /// Of the mission itself: what was made in a review later does not count.
  std::int64_t begin_utc_ns = 0;
  std::int64_t end_utc_ns = 0;

  bool operator==(const MissionTimeline&) const = default;
};

/// When the scan's last line or image was measured, as UTC. Reads a few lines. Fails as LoadLines
/// and ListImages do.
Result<std::int64_t> LastMeasurement(const MissionFile& mission, const ScanSummary& scan);

/// When each scan was really over, as UTC, given its last measurements: a head that is simulated
/// faster than real time has clocks that run ahead, and a scan ends at the latest when the next one
/// begins, when its depth was computed, or when an object was found in the whole of it.
/// @returns one end a scan, not before its begin.
std::vector<std::int64_t> ScanEnds(const std::vector<ScanSummary>& scans,
                                   std::vector<std::int64_t> last_measured_utc_ns,
                                   const std::vector<DepthRecord>& depths,
                                   const std::vector<DetectionRecord>& objects);

/// Reads scans, depth maps, objects with what was done to them, warnings, errors and the link's
/// state. `review` is the file beside the mission; nullptr = there is none. Decodes a few lines a
/// scan and no image; a scan whose lines are damaged is listed without a length. Fails as the lists
/// of MissionFile do.
Result<MissionTimeline> ReadTimeline(const MissionFile& mission, const MissionFile* review);

/// "link": source of the events that tell when the link to the head came and went; their text is
/// one of these two.
inline constexpr const char* kLinkEventSource = "link";
inline constexpr const char* kLinkUpText = "the link is there";
inline constexpr const char* kLinkLostText = "the link is lost";

}  // namespace foresight
