#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/sensor/scan.h"

namespace foresight {

/// What a list of scans shows, without loading them.
struct ScanSummary {
  std::int64_t id = 0;
  std::string uuid;
  std::int64_t start_utc_ns = 0;  ///< when the head's clock began
  std::int64_t begin_utc_ns = 0;  ///< of its first line; as BeginUtc_ns() without one
  std::string source;
  bool simulated = false;
  ScanPlan plan;
  ScanState state = ScanState::kRunning;
  std::string reason;
  bool imported = false;  ///< its cloud was given, not measured by a head
  std::int64_t lines = 0;
  std::int64_t images = 0;
  std::int64_t objects = 0;  ///< detections that are not deleted
  /// The first image, small, as PNG of at most kMaxThumbnailBytes; empty when there is none, and in
  /// missions of format 1.
  std::string thumbnail;
};

/// An image of a scan without its pixels.
struct ImageSummary {
  std::int64_t position = 0;  ///< in the scan, counted from 0
  std::int64_t seq = 0;
  double time_s = 0.0;
  double exposure_s = 0.0;
  double gain_db = 0.0;
  double motor_angle_rad = 0.0;
  double target_angle_rad = 0.0;
  int width = 0;
  int height = 0;
};

/// What the operator decided about a detection.
enum class Decision { kOpen, kAccepted, kRejected };
/// "open", "accepted", "rejected".
const char* ToString(Decision decision);

/// Something that was done to a detection. Such rows are only ever added.
struct DetectionEvent {
  enum class Action { kAccepted, kRejected, kReopened, kRenamed, kDeleted, kRestored, kSent };
  std::int64_t utc_ns = 0;
  std::string author;
  Action action = Action::kAccepted;
  /// The new name for kRenamed, the answer for kSent; for a decision "answer 2", counted from 1,
  /// where it is not about the best one; else a remark; may be empty.
  std::string text;

  bool operator==(const DetectionEvent&) const = default;
};
/// The answer that the text of a decision names, counted from 0; 0 where it names none.
int DecidedCandidateOf(const std::string& text);
/// "accepted", "rejected", "reopened", "renamed", "deleted", "restored",
/// "sent": to the robot.
const char* ToString(DetectionEvent::Action action);
/// The reverse; fails with kBadData.
Result<DetectionEvent::Action> DetectionActionFromString(const std::string& text);

/// An answer found in a scan, as JSON of its kind ("valve", "drill", "terrain",
/// "handle", "cylinder").
struct DetectionRecord {
  std::int64_t id = 0;       ///< given by the file
  std::string uuid;          ///< empty = the file gives one
  std::int64_t scan_id = 0;  ///< in this file; 0 = the scan is in another one (a review)
  std::string scan_uuid;     ///< may be left empty where scan_id is given
  std::string kind;
  std::int64_t utc_ns = 0;  ///< when it was found
  std::string author;
  std::string json;
  std::string provenance_json;  ///< ProvenanceToJson; empty in missions of format 1

  // The present state, from the detection's events. Not written by AddDetection.
  std::string name;  ///< empty until it is renamed
  Decision decision = Decision::kOpen;
  int decided_candidate = 0;  ///< which answer the decision is about; 0 = the best
  std::int64_t decided_utc_ns = 0;
  std::string decided_by;
  bool deleted = false;

  bool operator==(const DetectionRecord&) const = default;
};

/// A depth map in numbers that can be compared after it was made again.
struct DepthStatistics {
  std::int64_t valid_pixels = 0;   ///< with a depth
  std::int64_t masked_pixels = 0;  ///< of them, hidden by the mask
  /// Quantiles of the depth at 5, 25, 50, 75 and 95 % of the valid pixels, in metres; NaN where no
  /// pixel is valid.
  std::array<double, 5> depth_quantiles_m = {};
  double largest_confidence = 0.0;

  bool operator==(const DepthStatistics&) const = default;
};

/// A depth map that was computed: not its pixels, but how it is made again and what came out.
struct DepthRecord {
  std::int64_t id = 0;       ///< given by the file
  std::string uuid;          ///< empty = the file gives one
  std::int64_t scan_id = 0;  ///< in this file; 0 = the scan is in another one (a review)
  std::string scan_uuid;     ///< may be left empty where scan_id is given
  std::int64_t image_position = 0;
  std::int64_t utc_ns = 0;
  std::string author;
  std::string provenance_json;
  std::string digest;  ///< SHA-256 of depth, confidence and mask (DigestOf)
  DepthStatistics statistics;

  bool operator==(const DepthRecord&) const = default;
};

/// What somebody wrote or measured, about a scan, an object or the whole mission.
struct NoteRecord {
  std::int64_t id = 0;       ///< given by the file; of the state that counts
  std::string uuid;          ///< of the note; empty = the file gives one
  std::int64_t scan_id = 0;  ///< in this file; 0 = none, or in another one (a review)
  std::string scan_uuid;     ///< empty = it is about the mission
  std::string object_uuid;   ///< of the detection it is about; empty = none
  std::string kind;          ///< "note", "measurement"
  std::int64_t utc_ns = 0;   ///< when it got this state
  std::string author;        ///< of this state
  std::string text;          ///< of a measurement its name
  std::string tags;          ///< TagsFrom's words
  std::string json;          ///< MeasurementToJson of a measurement, else empty
  bool deleted = false;

  // From its first state. Not written by AddNote.
  std::int64_t made_utc_ns = 0;
  std::string made_by;

  bool operator==(const NoteRecord&) const = default;
};
/// Of several states of each note the last one, in the order of the first ones, with who made it
/// and when.
std::vector<NoteRecord> CurrentNotes(const std::vector<NoteRecord>& states);
inline constexpr const char* kNoteKind = "note";
inline constexpr const char* kMeasurementKind = "measurement";

/// Short words out of "#crack, left wheel": "crack left wheel", each once, as they came, ASCII
/// letters in lower case. Fails with kInvalidInput where a word is longer than 40 bytes.
Result<std::string> TagsFrom(const std::string& text);

/// Something that happened, for the mission's log.
struct EventRecord {
  std::int64_t id = 0;  ///< given by the file
  std::int64_t utc_ns = 0;
  std::string source;    ///< "head", "operator", ...
  std::string severity;  ///< "info", "warning", "error"
  std::string text;
  std::string json;  ///< more about it, may be empty

  bool operator==(const EventRecord&) const = default;
};

}  // namespace foresight
