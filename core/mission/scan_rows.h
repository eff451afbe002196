#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/mission/mission_records.h"
#include "core/mission/sqlite.h"
#include "core/sensor/scan.h"

namespace foresight {

/// One row of the table `scan`. The counts are -1 until the scan has ended.
struct ScanRow {
  std::int64_t id = 0;
  std::string uuid;
  std::int64_t calibration_id = 0;
  std::int64_t start_utc_ns = 0;
  std::string source;
  bool simulated = false;
  ScanPlan plan;
  /// The plan as it stands in the file, which the checksum covers: an older program wrote less.
  std::string plan_json;
  ScanState state = ScanState::kRunning;
  std::string reason;
  std::int64_t lines = -1;
  std::int64_t motor_batches = -1;
  std::int64_t frames = -1;
};

/// The scan part of the mission file: rows <-> values, each with its checksum. `file` names the
/// file in errors. The writers assume that the caller holds a transaction or a savepoint.
class ScanRows {
 public:
  ScanRows(SqliteDatabase& database, const std::string& file) : database_(database), file_(file) {}

  Result<std::int64_t> InsertScan(const Scan& header);
  Status InsertLine(std::int64_t scan_id, const LidarLine& line);
  Status InsertMotorSamples(std::int64_t scan_id, std::span<const MotorSample> samples);
  Status InsertGiven(std::int64_t scan_id, const GivenCloud& cloud);
  /// `png` is the frame's image.
  Status InsertFrame(std::int64_t scan_id, const CameraFrame& frame, const std::string& png);
  /// `png` is the scan's first image, small.
  Status InsertThumbnail(std::int64_t scan_id, const std::string& png);
  /// Unless it is there already.
  Status InsertRig(const SensorRig& rig);
  /// Counts what the scan has and closes its row.
  Status EndScan(std::int64_t scan_id, ScanState state, const std::string& reason);
  /// The reverse: the scan runs again.
  Status ReopenScan(std::int64_t scan_id);
  /// The seq of the last line; none = there is no line.
  Result<std::optional<std::int64_t>> LastLine(std::int64_t scan_id) const;

  Result<std::vector<ScanRow>> ReadScanRows() const;
  /// Fails with kInvalidInput when there is no such scan.
  Result<ScanRow> ReadScanRow(std::int64_t id) const;
  /// Those of a given cloud too: a scan has one or the other.
  Result<std::int64_t> CountLines(std::int64_t scan_id) const;
  Result<std::int64_t> CountFrames(std::int64_t scan_id) const;
  /// On the scan's clock: its first line with a time or, without one, its first motor sample; 0
  /// where it has neither.
  Result<double> FirstTime(std::int64_t scan_id) const;
  /// Everything but lines, track and frames.
  Result<Scan> ReadHeader(const ScanRow& row) const;
  Result<Scan> ReadScan(const ScanRow& row) const;
  /// At most `at_most` lines with seq >= first_seq.
  Result<std::vector<LidarLine>> ReadLines(std::int64_t scan_id, std::int64_t first_seq,
                                           std::size_t at_most) const;
  /// All of the file, the oldest first.
  Result<std::vector<SensorRig>> ReadRigs() const;
  Result<MotorTrack> ReadTrack(const ScanRow& scan) const;
  /// Empty where the scan has none, as all of formats 1 and 2.
  Result<GivenCloud> ReadGiven(std::int64_t scan_id) const;
  /// Scans that have one.
  Result<std::set<std::int64_t>> ScansWithGiven() const;
  Result<std::vector<ImageSummary>> ReadImageList(const ScanRow& scan) const;
  /// Fails with kInvalidInput when there is no such image.
  Result<CameraFrame> ReadImage(std::int64_t scan_id, std::int64_t position) const;
  /// By scan. A damaged one is left out, or an error where `strict`.
  Result<std::map<std::int64_t, std::string>> ReadThumbnails(std::optional<std::int64_t> scan_id,
                                                             bool strict) const;

 private:
  Result<double> FirstMotorTime(std::int64_t scan_id) const;
  Result<std::vector<ScanRow>> ReadScanRows(std::optional<std::int64_t> id) const;
  Status Update(const ScanRow& row, std::int64_t scan_id);
  Result<std::int64_t> CalibrationId(const std::string& rig_yaml);
  Result<SensorRig> ReadRig(std::int64_t calibration_id) const;
  Result<std::vector<CameraFrame>> ReadFrames(const ScanRow& scan) const;
  Result<CameraFrame> ReadFrame(const SqliteStatement& row, std::int64_t scan_id,
                                std::int64_t position) const;
  /// The image's own row, without its pixels; position must be the one asked for.
  Result<CameraFrame> ReadFrameRow(const SqliteStatement& row, std::int64_t scan_id,
                                   std::int64_t position, std::int64_t& data_crc) const;
  Result<bool> HasGivenTable() const;
  Result<std::int64_t> Query(const char* sql, std::int64_t scan_id) const;
  Status CheckCount(const ScanRow& scan, const char* what, std::size_t found,
                    std::int64_t expected) const;

  SqliteDatabase& database_;
  const std::string& file_;
};

}  // namespace foresight
