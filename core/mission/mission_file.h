#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/sensor/scan.h"

namespace foresight {

/// What a list of scans shows, without loading them.
struct ScanSummary {
  std::int64_t id = 0;
  std::string uuid;
  std::int64_t start_utc_ns = 0;
  std::string source;
  bool simulated = false;
  ScanPlan plan;
  ScanState state = ScanState::kRunning;
  std::string reason;
  std::int64_t lines = 0;
  std::int64_t frames = 0;
};

/// An answer found in a scan, as JSON of its kind ("valve", "drill", "terrain").
struct DetectionRecord {
  std::int64_t id = 0;  ///< given by the file
  std::int64_t scan_id = 0;
  std::string kind;
  std::int64_t utc_ns = 0;
  std::string json;

  bool operator==(const DetectionRecord&) const = default;
};

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

/// A mission in one SQLite file (docs/formats.md): scans with all their raw data, detections and
/// events. A line, frame or sample that was appended is on the disk when the call returns. Every
/// row carries a checksum: damage becomes an error naming the file and the row, never a wrong
/// number.
///
/// One program writes a file at a time; meanwhile others are told that it is in use. All calls are
/// safe from any thread. Errors: kIo (disk, rights, in use), kBadData (damaged, another format),
/// kState (read-only, or no such scan is running), kInvalidInput (an impossible value or id).
class MissionFile {
 public:
  /// Makes a new file; fails with kIo when there is one.
  static Result<std::unique_ptr<MissionFile>> Create(const std::filesystem::path& path);
  /// Opens for reading and writing. A scan that a crash left running becomes interrupted.
  static Result<std::unique_ptr<MissionFile>> Open(const std::filesystem::path& path);
  /// Opens without ever writing, also on read-only media. A scan left running reads as interrupted.
  static Result<std::unique_ptr<MissionFile>> OpenReadOnly(const std::filesystem::path& path);

  /// Closes as Close() does; a failure is only logged.
  ~MissionFile();
  MissionFile(const MissionFile&) = delete;
  MissionFile& operator=(const MissionFile&) = delete;

  const std::filesystem::path& path() const;

  /// Begins a scan with everything of `header` but its lines, track and frames; returns its id. One
  /// scan runs at a time.
  Result<std::int64_t> BeginScan(const Scan& header);
  /// Lines come in the order of their seq.
  Status AppendLine(std::int64_t scan_id, const LidarLine& line);
  /// Samples that are not later than the last one are dropped, as MotorTrack::Add does.
  Status AppendMotorSamples(std::int64_t scan_id, std::span<const MotorSample> samples);
  Status AppendFrame(std::int64_t scan_id, const CameraFrame& frame);
  Status EndScan(std::int64_t scan_id, ScanState state, const std::string& reason);
  /// Runs `body`, whose appends reach the disk together when it returns: ten times as many lines a
  /// second. What was appended before a failure is kept.
  Status Batch(const std::function<Status()>& body);

  Result<std::vector<ScanSummary>> ListScans() const;
  /// The whole scan: lines, track, frames and plan bit for bit, the rig as SensorRigToYaml keeps
  /// it.
  Result<Scan> LoadScan(std::int64_t id) const;

  /// Returns the new id. `detection.id` is ignored.
  Result<std::int64_t> AddDetection(const DetectionRecord& detection);
  Result<std::vector<DetectionRecord>> ListDetections() const;
  Result<std::int64_t> AddEvent(const EventRecord& event);
  Result<std::vector<EventRecord>> ListEvents() const;

  /// Reads everything there is and checks it.
  Status Verify(const RunContext& context) const;
  /// Writes a compact copy: one file, complete without its neighbours. Replaces `target`.
  Status ExportTo(const std::filesystem::path& target) const;
  /// Ends a running scan as interrupted and leaves one single file. Nothing can be called after it.
  Status Close();

 private:
  struct Impl;
  explicit MissionFile(std::unique_ptr<Impl> impl);
  static Result<std::unique_ptr<MissionFile>> OpenForWriting(const std::filesystem::path& path,
                                                             bool create);

  std::unique_ptr<Impl> impl_;
};

}  // namespace foresight
