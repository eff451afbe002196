#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/mission/mission_damage.h"
#include "core/mission/mission_records.h"
#include "core/sensor/scan.h"

namespace foresight {

class MissionFileHandle;

/// A mission in one SQLite file (docs/formats.md): scans with all their raw data, detections, depth
/// maps and events. What was appended or added is on the disk when the call returns. Every row
/// carries a checksum: damage becomes an error naming the file and the row, never a wrong number.
///
/// One program writes a file at a time; another writer is told that it is in use. Any number of
/// readers, each with a MissionFile of its own (OpenReadOnly), read meanwhile, in this program and
/// in others, and never wait for the writer nor make it wait. All calls are safe from any thread.
/// Errors: kIo (disk, rights, in use), kBadData (damaged, a newer format), kState (read-only, or no
/// such scan is running), kInvalidInput (an impossible value or id).
class MissionFile {
 public:
  /// Makes a new file; fails with kIo when there is one.
  static Result<std::unique_ptr<MissionFile>> Create(const std::filesystem::path& path);
  /// Opens for reading and writing. A scan that a crash left running becomes interrupted, and a
  /// file of an earlier format gets the present one.
  static Result<std::unique_ptr<MissionFile>> Open(const std::filesystem::path& path);
  /// Opens for reading only, also on read-only media; a file of an earlier format is read as it is.
  /// A scan that is being recorded reads as running, one that a crash left running as interrupted.
  static Result<std::unique_ptr<MissionFile>> OpenReadOnly(const std::filesystem::path& path);

  /// Closes as Close() does; a failure is only logged.
  ~MissionFile();
  MissionFile(const MissionFile&) = delete;
  MissionFile& operator=(const MissionFile&) = delete;

  /// Opens, or makes, the file beside a mission that takes what is found while it is reviewed:
  /// `NAME.review.foresight`. It has no scans of its own; its detections and depth maps name their
  /// scan by scan_uuid. Where the mission's folder cannot be written it lies in `folder` instead.
  static Result<std::unique_ptr<MissionFile>> OpenReviewOf(
      const std::filesystem::path& mission, const std::filesystem::path& folder = {});
  /// Where OpenReviewOf finds or makes the file. Fails with kInvalidInput where `mission` is a
  /// review itself, kIo where neither folder can be written.
  static Result<std::filesystem::path> ReviewPathOf(const std::filesystem::path& mission,
                                                    const std::filesystem::path& folder = {});

  /// The review of a mission for reading; nullptr where there is none.
  static Result<std::unique_ptr<MissionFile>> FindReviewOf(
      const std::filesystem::path& mission, const std::filesystem::path& folder = {});

  const std::filesystem::path& path() const;
  /// Whether this is the file beside a mission, without scans of its own.
  bool IsReview() const;
  /// Whether the file was moved or deleted since it was opened, by somebody else. What is written
  /// goes where it was moved to, or is lost with this object. Waits for no other call.
  bool HasMoved() const;
  /// Whether a program has the file open for writing now, this one included.
  bool IsBeingRecorded() const;
  /// False where the file was not closed by who wrote it: it is being recorded, the program
  /// crashed, or somebody copied it without the `-wal` beside it; the newest rows may be missing
  /// then.
  bool WasClosedProperly() const;

  /// Begins a scan with everything of `header` but its lines, track and frames; returns its id. One
  /// scan runs at a time.
  Result<std::int64_t> BeginScan(const Scan& header);
  /// Takes up a scan that has ended, so that what is missing behind its last line, sample and image
  /// can be appended. It runs again, until EndScan.
  Status ContinueScan(std::int64_t scan_id);
  /// Lines come in the order of their seq.
  Status AppendLine(std::int64_t scan_id, const LidarLine& line);
  /// Samples that are not later than the last one are dropped, as MotorTrack::Add does.
  Status AppendMotorSamples(std::int64_t scan_id, std::span<const MotorSample> samples);
  Status AppendFrame(std::int64_t scan_id, const CameraFrame& frame);
  /// In place of lines and motor samples, once. Fails as GivenCloud::Check, and with kState where
  /// the scan has lines or a cloud already.
  Status SetGivenCloud(std::int64_t scan_id, const GivenCloud& cloud);
  /// Where the end cannot be written (a full disk) the scan has ended all the same: another can
  /// begin, and this one can be continued.
  Status EndScan(std::int64_t scan_id, ScanState state, const std::string& reason);
  /// Runs `body`, whose appends reach the disk together when it returns, ten times as many lines a
  /// second: all of them or, where the body or the disk fails, none. The scan goes on where it was.
  Status Batch(const std::function<Status()>& body);

  // Reading. Each call sees one moment of the file, and decodes no more than it returns.

  Result<std::vector<ScanSummary>> ListScans() const;
  Result<ScanSummary> Summary(std::int64_t id) const;
  /// The id of the scan or detection with this uuid; nullopt where the file has none.
  Result<std::optional<std::int64_t>> FindScan(const std::string& uuid) const;
  Result<std::optional<std::int64_t>> FindDetection(const std::string& uuid) const;
  /// Everything of a scan but its lines, track and frames.
  Result<Scan> LoadHeader(std::int64_t id) const;
  /// The whole scan: lines, given cloud, track, frames and plan bit for bit, the rig as
  /// SensorRigToYaml keeps it.
  Result<Scan> LoadScan(std::int64_t id) const;
  /// At most `at_most` lines, from that with seq `first_seq` or the next one on; none behind the
  /// last.
  Result<std::vector<LidarLine>> LoadLines(std::int64_t id, std::int64_t first_seq,
                                           std::size_t at_most) const;
  Result<MotorTrack> LoadTrack(std::int64_t id) const;
  /// In the order in which they came: `position` counts from 0.
  Result<std::vector<ImageSummary>> ListImages(std::int64_t id) const;
  Result<CameraFrame> LoadImage(std::int64_t id, std::int64_t position) const;

  /// Returns the new id, or that of the detection with the same uuid, which stays as it is. The
  /// scan must be in the file, but for a review. `id` and the present state (name, decision) are
  /// ignored.
  Result<std::int64_t> AddDetection(const DetectionRecord& detection);
  Status AddDetectionEvent(std::int64_t detection_id, const DetectionEvent& event);
  /// Of one scan or of all, with their present state; deleted ones too.
  Result<std::vector<DetectionRecord>> ListDetections(
      std::optional<std::int64_t> scan_id = std::nullopt) const;
  /// What was done to a detection, oldest first.
  Result<std::vector<DetectionEvent>> ListDetectionEvents(std::int64_t detection_id) const;

  /// As AddDetection.
  Result<std::int64_t> AddDepth(const DepthRecord& depth);
  Result<std::vector<DepthRecord>> ListDepths(
      std::optional<std::int64_t> scan_id = std::nullopt) const;

  /// Adds a state of a note, which counts from now on; where the file has none of its uuid it is a
  /// new note. Its scan must be in the file, but for a review; without one it is about the mission.
  /// Returns the row's id. Fails with kInvalidInput for a kind that is not known, too.
  Result<std::int64_t> AddNote(const NoteRecord& note);
  /// In their present state, in the order in which they were made; deleted ones too.
  Result<std::vector<NoteRecord>> ListNotes() const;
  /// Keeps a rig that is not a scan's, for what was made with it in place of the scan's own. A rig
  /// that is there already is not kept twice.
  Status AddRig(const SensorRig& rig);
  /// The rig with this id (core/sensor/rig_id.h), a scan's or one that was added; nullopt where the
  /// file has none.
  Result<std::optional<SensorRig>> FindRig(const std::string& rig_id) const;

  Result<std::int64_t> AddEvent(const EventRecord& event);
  Result<std::vector<EventRecord>> ListEvents() const;

  /// Reads everything there is and checks it; fails at the first damage.
  Status Verify(const RunContext& context) const;
  /// Names every damaged record, at most `at_most` of them (FindDamage).
  Result<DamageReport> FindDamage(std::size_t at_most, const RunContext& context) const;
  /// Writes a compact copy: one file, complete without its neighbours, also while the mission is
  /// being recorded, which goes on meanwhile; a scan that runs ends in the copy. The
  /// writer of a file that has moved copies what it has open, and nobody writes meanwhile. Replaces
  /// `target`.
  Status ExportTo(const std::filesystem::path& target) const;
  /// Ends a running scan as interrupted. Who closes last, writer or reader, leaves one single file.
  /// Nothing can be called after it.
  Status Close();

 private:
  struct Impl;
  enum class OpenHow { kCreate, kCreateReview, kExisting };
  explicit MissionFile(std::unique_ptr<Impl> impl);
  static Result<std::unique_ptr<MissionFile>> OpenForWriting(const std::filesystem::path& path,
                                                             MissionFileHandle handle, OpenHow how);
  static Result<std::unique_ptr<MissionFile>> MakeNew(const std::filesystem::path& path,
                                                      OpenHow how);

  std::unique_ptr<Impl> impl_;
};

}  // namespace foresight
