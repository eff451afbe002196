#include "core/mission/scan_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>
#include <utility>

#include "core/io/png.h"
#include "core/mission/given_codec.h"
#include "core/mission/line_codec.h"
#include "core/mission/plan_json.h"
#include "core/mission/row_checksum.h"

namespace foresight {
namespace {

static_assert(std::endian::native == std::endian::little, "motor samples are stored as they lie");
static_assert(sizeof(MotorSample) == 16, "a motor sample is two doubles");

std::int64_t Checksum(const ScanRow& row) {
  return RowChecksum()
      .Add(row.id)
      .Add(row.uuid)
      .Add(row.calibration_id)
      .Add(row.start_utc_ns)
      .Add(row.source)
      .Add(std::int64_t{row.simulated})
      .Add(row.plan_json)
      .Add(ToString(row.state))
      .Add(row.reason)
      .Add(row.lines)
      .Add(row.motor_batches)
      .Add(row.frames)
      .value();
}

std::int64_t Checksum(std::int64_t scan_id, const LidarLine& line, const PackedLine& packed) {
  return RowChecksum()
      .Add(scan_id)
      .Add(line.seq)
      .Add(line.time_s)
      .Add(static_cast<std::int64_t>(packed.codec))
      .Add(packed.beams)
      .Add(std::int64_t{packed.has_intensity})
      .Add(packed.bytes)
      .value();
}

std::int64_t Checksum(std::int64_t scan_id, std::int64_t line, double time_s,
                      const PackedGivenLine& packed) {
  return RowChecksum()
      .Add(scan_id)
      .Add(line)
      .Add(time_s)
      .Add(packed.beams)
      .Add(packed.parts)
      .Add(packed.bytes)
      .value();
}

/// The first time of a line; NaN where none is known.
double FirstTimeOf(const GivenCloud& cloud, int line) {
  if (!cloud.time_s.empty())
    for (int beam = 0; beam < cloud.beams; ++beam)
      if (const double time = cloud.time_s[cloud.Index(line, beam)]; std::isfinite(time))
        return time;
  return std::numeric_limits<double>::quiet_NaN();
}

std::int64_t Checksum(std::int64_t scan_id, std::int64_t position, const CameraFrame& frame,
                      std::int64_t data_crc) {
  return RowChecksum()
      .Add(scan_id)
      .Add(position)
      .Add(frame.seq)
      .Add(frame.time_s)
      .Add(frame.exposure_s)
      .Add(frame.gain_db)
      .Add(frame.motor_angle_rad)
      .Add(frame.target_angle_rad)
      .Add(data_crc)
      .value();
}

std::int64_t MotorChecksum(std::int64_t scan_id, std::int64_t batch, std::string_view data) {
  return RowChecksum().Add(scan_id).Add(batch).Add(data).value();
}

std::int64_t ThumbnailChecksum(std::int64_t scan_id, std::string_view png) {
  return RowChecksum().Add(scan_id).Add(png).value();
}

std::int64_t CalibrationChecksum(std::int64_t id, std::string_view yaml) {
  return RowChecksum().Add(id).Add(yaml).value();
}

/// Columns 0 to 8 of an image; the PNG, or its beginning, is behind them.
constexpr const char* kImageColumns =
    "position, seq, time_s, exposure_s, gain_db, motor_angle_rad, target_angle_rad, data_crc32, "
    "crc32";
constexpr int kPngColumn = 9;
constexpr std::size_t kPngHeaderBytes = 24;  ///< with the size, big-endian, in the last eight

Result<std::pair<int, int>> PngSize(std::string_view header, const std::string& where) {
  constexpr std::string_view kMagic("\x89PNG\r\n\x1a\n", 8);
  if (header.size() < kPngHeaderBytes || !header.starts_with(kMagic))
    return Fail(ErrorCode::kBadData, "{} is damaged (not a PNG)", where);
  const auto number = [&header](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
      value = value << 8 | static_cast<unsigned char>(header[i]);
    return static_cast<int>(value);
  };
  return std::pair(number(16), number(20));
}

}  // namespace

Result<std::int64_t> ScanRows::Query(const char* sql, std::int64_t scan_id) const {
  FORESIGHT_TRY(SqliteStatement statement, database_.Prepare(sql));
  statement.Bind(scan_id);
  FORESIGHT_TRY(const bool row, statement.Step());
  return row ? statement.Integer(0) : 0;
}

Result<std::int64_t> ScanRows::CalibrationId(const std::string& rig_yaml) {
  FORESIGHT_TRY(SqliteStatement same,
                database_.Prepare("SELECT id FROM calibration WHERE rig_yaml = ?"));
  same.BindText(rig_yaml);
  FORESIGHT_TRY(const bool found, same.Step());
  if (found) return same.Integer(0);
  FORESIGHT_TRY(const std::int64_t id,
                database_.Integer("SELECT coalesce(max(id), 0) + 1 FROM calibration"));
  FORESIGHT_TRY(SqliteStatement insert,
                database_.Prepare("INSERT INTO calibration(id, rig_yaml, crc32) VALUES(?, ?, ?)"));
  FORESIGHT_CHECK(insert.Bind(id).BindText(rig_yaml).Bind(CalibrationChecksum(id, rig_yaml)).Run());
  return id;
}

Status ScanRows::InsertRig(const SensorRig& rig) {
  FORESIGHT_CHECK(CalibrationId(SensorRigToYaml(rig)));
  return {};
}

Result<std::int64_t> ScanRows::InsertScan(const Scan& header) {
  ScanRow row;
  FORESIGHT_TRY(row.calibration_id, CalibrationId(SensorRigToYaml(header.rig)));
  FORESIGHT_TRY(row.id, database_.Integer("SELECT coalesce(max(id), 0) + 1 FROM scan"));
  row.uuid = header.uuid;
  row.start_utc_ns = header.start_utc_ns;
  row.source = header.source;
  row.simulated = header.simulated;
  row.plan = header.plan;
  row.plan_json = PlanToJson(header.plan);
  FORESIGHT_TRY(
      SqliteStatement insert,
      database_.Prepare("INSERT INTO scan(id, uuid, calibration_id, start_utc_ns, source, "
                        "simulated, plan_json, state, reason, lines, motor_batches, frames, crc32) "
                        "VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  FORESIGHT_CHECK(insert.Bind(row.id)
                      .BindText(row.uuid)
                      .Bind(row.calibration_id)
                      .Bind(row.start_utc_ns)
                      .BindText(row.source)
                      .Bind(std::int64_t{row.simulated})
                      .BindText(row.plan_json)
                      .BindText(ToString(row.state))
                      .BindText(row.reason)
                      .Bind(row.lines)
                      .Bind(row.motor_batches)
                      .Bind(row.frames)
                      .Bind(Checksum(row))
                      .Run());
  return row.id;
}

Status ScanRows::InsertLine(std::int64_t scan_id, const LidarLine& line) {
  if (!std::isfinite(line.time_s))
    return Fail(ErrorCode::kInvalidInput, "{}: scan {}, line {}: time {} is not finite", file_,
                scan_id, line.seq, line.time_s);
  FORESIGHT_TRY(const PackedLine packed, PackLine(line));
  FORESIGHT_TRY(SqliteStatement insert,
                database_.Prepare("INSERT INTO line(scan_id, seq, time_s, codec, beams, "
                                  "has_intensity, data, crc32) VALUES(?, ?, ?, ?, ?, ?, ?, ?)"));
  return insert.Bind(scan_id)
      .Bind(line.seq)
      .Bind(line.time_s)
      .Bind(static_cast<std::int64_t>(packed.codec))
      .Bind(packed.beams)
      .Bind(std::int64_t{packed.has_intensity})
      .BindBlob(packed.bytes)
      .Bind(Checksum(scan_id, line, packed))
      .Run();
}

Status ScanRows::InsertMotorSamples(std::int64_t scan_id, std::span<const MotorSample> samples) {
  for (const MotorSample& sample : samples)
    if (!std::isfinite(sample.time_s) || !std::isfinite(sample.angle_rad))
      return Fail(ErrorCode::kInvalidInput, "{}: scan {}: motor sample ({}, {}) is not finite",
                  file_, scan_id, sample.time_s, sample.angle_rad);
  FORESIGHT_TRY(const std::int64_t batch,
                Query("SELECT coalesce(max(batch) + 1, 0) FROM motor WHERE scan_id = ?", scan_id));
  const std::string data(reinterpret_cast<const char*>(samples.data()), samples.size_bytes());
  FORESIGHT_TRY(SqliteStatement insert,
                database_.Prepare("INSERT INTO motor(scan_id, batch, data, crc32) "
                                  "VALUES(?, ?, ?, ?)"));
  return insert.Bind(scan_id)
      .Bind(batch)
      .BindBlob(data)
      .Bind(MotorChecksum(scan_id, batch, data))
      .Run();
}

Status ScanRows::InsertGiven(std::int64_t scan_id, const GivenCloud& cloud) {
  for (int line = 0; line < cloud.lines; ++line) {
    FORESIGHT_TRY(SqliteStatement insert,
                  database_.Prepare("INSERT INTO given_line(scan_id, line, time_s, beams, parts, "
                                    "data, crc32) VALUES(?, ?, ?, ?, ?, ?, ?)"));
    FORESIGHT_TRY(const PackedGivenLine packed, PackGivenLine(cloud, line));
    const double time_s = FirstTimeOf(cloud, line);
    FORESIGHT_CHECK(insert.Bind(scan_id)
                        .Bind(std::int64_t{line})
                        .Bind(time_s)
                        .Bind(packed.beams)
                        .Bind(packed.parts)
                        .BindBlob(packed.bytes)
                        .Bind(Checksum(scan_id, line, time_s, packed))
                        .Run());
  }
  return {};
}

Result<bool> ScanRows::HasGivenTable() const {
  FORESIGHT_TRY(SqliteStatement select,
                database_.Prepare("SELECT 1 FROM sqlite_schema WHERE name = 'given_line'"));
  return select.Step();
}

Result<std::set<std::int64_t>> ScanRows::ScansWithGiven() const {
  std::set<std::int64_t> scans;
  FORESIGHT_TRY(const bool any, HasGivenTable());
  if (!any) return scans;
  FORESIGHT_TRY(SqliteStatement select,
                database_.Prepare("SELECT s.id FROM scan s WHERE EXISTS (SELECT 1 FROM given_line "
                                  "g WHERE g.scan_id = s.id)"));
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) return scans;
    scans.insert(select.Integer(0));
  }
}

Result<GivenCloud> ScanRows::ReadGiven(std::int64_t scan_id) const {
  FORESIGHT_TRY(const bool any, HasGivenTable());
  if (!any) return GivenCloud();
  FORESIGHT_TRY(SqliteStatement select,
                database_.Prepare("SELECT line, time_s, beams, parts, data, crc32 FROM given_line "
                                  "WHERE scan_id = ? ORDER BY line"));
  select.Bind(scan_id);
  GivenCloudBuilder builder;
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) return builder.Take();
    const std::int64_t line = select.Integer(0);
    PackedGivenLine packed;
    packed.beams = select.Integer(2);
    packed.parts = select.Integer(3);
    packed.bytes = select.Blob(4);
    const std::string where =
        fmt::format("{}: scan {}, line {} of its cloud", file_, scan_id, line);
    if (select.Integer(5) != Checksum(scan_id, line, select.Number(1), packed))
      return Fail(ErrorCode::kBadData, "{} is damaged (checksum)", where);
    if (const Status added = builder.Add(line, packed); !added)
      return Fail(ErrorCode::kBadData, "{}: {}", where, added.error().message);
  }
}

Status ScanRows::InsertFrame(std::int64_t scan_id, const CameraFrame& frame,
                             const std::string& png) {
  FORESIGHT_TRY(
      const std::int64_t position,
      Query("SELECT coalesce(max(position) + 1, 0) FROM image WHERE scan_id = ?", scan_id));
  const std::int64_t data_crc = RowChecksum().Add(png).value();
  FORESIGHT_TRY(
      SqliteStatement insert,
      database_.Prepare("INSERT INTO image(scan_id, position, seq, time_s, exposure_s, gain_db, "
                        "motor_angle_rad, target_angle_rad, data_crc32, crc32) "
                        "VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  FORESIGHT_CHECK(insert.Bind(scan_id)
                      .Bind(position)
                      .Bind(frame.seq)
                      .Bind(frame.time_s)
                      .Bind(frame.exposure_s)
                      .Bind(frame.gain_db)
                      .Bind(frame.motor_angle_rad)
                      .Bind(frame.target_angle_rad)
                      .Bind(data_crc)
                      .Bind(Checksum(scan_id, position, frame, data_crc))
                      .Run());
  FORESIGHT_TRY(
      SqliteStatement insert_data,
      database_.Prepare("INSERT INTO image_data(scan_id, position, png) VALUES(?, ?, ?)"));
  return insert_data.Bind(scan_id).Bind(position).BindBlob(png).Run();
}

Status ScanRows::EndScan(std::int64_t scan_id, ScanState state, const std::string& reason) {
  FORESIGHT_TRY(ScanRow row, ReadScanRow(scan_id));
  row.state = state;
  row.reason = reason;
  FORESIGHT_TRY(row.lines, CountLines(scan_id));
  FORESIGHT_TRY(row.frames, CountFrames(scan_id));
  FORESIGHT_TRY(row.motor_batches, Query("SELECT count(*) FROM motor WHERE scan_id = ?", scan_id));
  return Update(row, scan_id);
}

Status ScanRows::ReopenScan(std::int64_t scan_id) {
  FORESIGHT_TRY(ScanRow row, ReadScanRow(scan_id));
  row.state = ScanState::kRunning;
  row.reason.clear();
  row.lines = row.frames = row.motor_batches = -1;  // as of any scan that runs
  return Update(row, scan_id);
}

Result<std::optional<std::int64_t>> ScanRows::LastLine(std::int64_t scan_id) const {
  FORESIGHT_TRY(
      SqliteStatement select,
      database_.Prepare("SELECT seq FROM line WHERE scan_id = ? ORDER BY seq DESC LIMIT 1"));
  select.Bind(scan_id);
  FORESIGHT_TRY(const bool any, select.Step());
  return any ? std::optional(select.Integer(0)) : std::nullopt;
}

Status ScanRows::Update(const ScanRow& row, std::int64_t scan_id) {
  FORESIGHT_TRY(SqliteStatement update,
                database_.Prepare("UPDATE scan SET state = ?, reason = ?, lines = ?, frames = ?, "
                                  "motor_batches = ?, crc32 = ? WHERE id = ?"));
  return update.BindText(ToString(row.state))
      .BindText(row.reason)
      .Bind(row.lines)
      .Bind(row.frames)
      .Bind(row.motor_batches)
      .Bind(Checksum(row))
      .Bind(scan_id)
      .Run();
}

Status ScanRows::InsertThumbnail(std::int64_t scan_id, const std::string& png) {
  FORESIGHT_TRY(SqliteStatement insert,
                database_.Prepare("INSERT INTO thumbnail(scan_id, png, crc32) VALUES(?, ?, ?)"));
  return insert.Bind(scan_id).BindBlob(png).Bind(ThumbnailChecksum(scan_id, png)).Run();
}

Result<std::map<std::int64_t, std::string>> ScanRows::ReadThumbnails(
    std::optional<std::int64_t> scan_id, bool strict) const {
  FORESIGHT_TRY(SqliteStatement select,
                database_.Prepare("SELECT scan_id, png, crc32 FROM thumbnail WHERE ? < 0 OR "
                                  "scan_id = ?"));
  select.Bind(scan_id.value_or(-1)).Bind(scan_id.value_or(-1));
  std::map<std::int64_t, std::string> thumbnails;
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) return thumbnails;
    const std::int64_t id = select.Integer(0);
    std::string png = select.Blob(1);
    if (select.Integer(2) == ThumbnailChecksum(id, png))
      thumbnails[id] = std::move(png);
    else if (strict)
      return Fail(ErrorCode::kBadData, "{}: scan {}: its thumbnail is damaged (checksum)", file_,
                  id);
  }
}

Result<std::int64_t> ScanRows::CountLines(std::int64_t scan_id) const {
  FORESIGHT_TRY(const std::int64_t own,
                Query("SELECT count(*) FROM line WHERE scan_id = ?", scan_id));
  FORESIGHT_TRY(const bool given, HasGivenTable());
  if (own > 0 || !given) return own;
  return Query("SELECT count(*) FROM given_line WHERE scan_id = ?", scan_id);
}

Result<std::int64_t> ScanRows::CountFrames(std::int64_t scan_id) const {
  return Query("SELECT count(*) FROM image WHERE scan_id = ?", scan_id);
}

Result<double> ScanRows::FirstTime(std::int64_t scan_id) const {
  FORESIGHT_TRY(SqliteStatement first,
                database_.Prepare("SELECT time_s FROM line WHERE scan_id = ? "
                                  "ORDER BY seq LIMIT 1"));
  first.Bind(scan_id);
  FORESIGHT_TRY(const bool row, first.Step());
  if (row) return first.Number(0);
  FORESIGHT_TRY(const bool given, HasGivenTable());
  if (!given) return FirstMotorTime(scan_id);
  FORESIGHT_TRY(SqliteStatement timed,
                database_.Prepare("SELECT time_s FROM given_line WHERE scan_id = ? AND time_s IS "
                                  "NOT NULL ORDER BY line LIMIT 1"));
  timed.Bind(scan_id);
  FORESIGHT_TRY(const bool any, timed.Step());
  return any ? timed.Number(0) : FirstMotorTime(scan_id);
}

Result<double> ScanRows::FirstMotorTime(std::int64_t scan_id) const {
  FORESIGHT_TRY(SqliteStatement first,
                database_.Prepare("SELECT batch, data, crc32 FROM motor WHERE scan_id = ? "
                                  "ORDER BY batch LIMIT 1"));
  first.Bind(scan_id);
  FORESIGHT_TRY(const bool row, first.Step());
  if (!row) return 0.0;
  const std::string data = first.Blob(1);
  MotorSample sample;
  if (data.size() < sizeof(sample) ||
      first.Integer(2) != MotorChecksum(scan_id, first.Integer(0), data))
    return 0.0;  // what reads the track says that it is damaged
  std::memcpy(&sample, data.data(), sizeof(sample));
  return sample.time_s;
}

Result<std::vector<ScanRow>> ScanRows::ReadScanRows() const {
  return ReadScanRows(std::nullopt);
}

Result<ScanRow> ScanRows::ReadScanRow(std::int64_t id) const {
  FORESIGHT_TRY(std::vector<ScanRow> rows, ReadScanRows(std::max<std::int64_t>(0, id)));
  if (rows.empty()) return Fail(ErrorCode::kInvalidInput, "{}: there is no scan {}", file_, id);
  return std::move(rows.front());
}

Result<std::vector<ScanRow>> ScanRows::ReadScanRows(std::optional<std::int64_t> id) const {
  FORESIGHT_TRY(SqliteStatement select,
                database_.Prepare("SELECT id, uuid, calibration_id, start_utc_ns, source, "
                                  "simulated, plan_json, state, reason, lines, motor_batches, "
                                  "frames, crc32 FROM scan WHERE ? < 0 OR id = ? ORDER BY id"));
  select.Bind(id.value_or(-1)).Bind(id.value_or(-1));
  std::vector<ScanRow> rows;
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) return rows;
    ScanRow row;
    row.id = select.Integer(0);
    const std::string where = fmt::format("{}: scan {}", file_, row.id);
    row.uuid = select.Text(1);
    row.calibration_id = select.Integer(2);
    row.start_utc_ns = select.Integer(3);
    row.source = select.Text(4);
    row.simulated = select.Integer(5) != 0;
    row.plan_json = select.Text(6);
    FORESIGHT_TRY(row.plan, PlanFromJson(row.plan_json, where));
    const auto state = ScanStateFromString(select.Text(7));
    if (!state) return Fail(ErrorCode::kBadData, "{}: {}", where, state.error().message);
    row.state = *state;
    row.reason = select.Text(8);
    row.lines = select.Integer(9);
    row.motor_batches = select.Integer(10);
    row.frames = select.Integer(11);
    if (select.Integer(12) != Checksum(row))
      return Fail(ErrorCode::kBadData, "{}: its row is damaged (checksum)", where);
    rows.push_back(std::move(row));
  }
}

Result<SensorRig> ScanRows::ReadRig(std::int64_t calibration_id) const {
  FORESIGHT_TRY(SqliteStatement select,
                database_.Prepare("SELECT rig_yaml, crc32 FROM calibration WHERE id = ?"));
  select.Bind(calibration_id);
  const std::string where = fmt::format("{}: calibration {}", file_, calibration_id);
  FORESIGHT_TRY(const bool found, select.Step());
  if (!found) return Fail(ErrorCode::kBadData, "{} is missing", where);
  const std::string yaml = select.Text(0);
  if (select.Integer(1) != CalibrationChecksum(calibration_id, yaml))
    return Fail(ErrorCode::kBadData, "{} is damaged (checksum)", where);
  return SensorRigFromYaml(yaml, where);
}

Result<std::vector<SensorRig>> ScanRows::ReadRigs() const {
  FORESIGHT_TRY(SqliteStatement select,
                database_.Prepare("SELECT id FROM calibration ORDER BY id"));
  std::vector<SensorRig> rigs;
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) return rigs;
    FORESIGHT_TRY(SensorRig rig, ReadRig(select.Integer(0)));
    rigs.push_back(std::move(rig));
  }
}

Result<std::vector<LidarLine>> ScanRows::ReadLines(std::int64_t scan_id, std::int64_t first_seq,
                                                   std::size_t at_most) const {
  FORESIGHT_TRY(SqliteStatement select,
                database_.Prepare("SELECT seq, time_s, codec, beams, has_intensity, data, crc32 "
                                  "FROM line WHERE scan_id = ? AND seq >= ? ORDER BY seq LIMIT ?"));
  constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<std::int64_t>::max());
  select.Bind(scan_id).Bind(first_seq).Bind(static_cast<std::int64_t>(std::min(at_most, kMost)));
  std::vector<LidarLine> lines;
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) break;
    LidarLine line;
    line.seq = select.Integer(0);
    line.time_s = select.Number(1);
    PackedLine packed;
    packed.codec = static_cast<LineCodec>(select.Integer(2));
    packed.beams = select.Integer(3);
    packed.has_intensity = select.Integer(4) != 0;
    packed.bytes = select.Blob(5);
    const std::string where = fmt::format("{}: scan {}, line {}", file_, scan_id, line.seq);
    if (select.Integer(6) != Checksum(scan_id, line, packed))
      return Fail(ErrorCode::kBadData, "{} is damaged (checksum)", where);
    if (const Status status = UnpackLine(packed, line); !status)
      return Fail(ErrorCode::kBadData, "{}: {}", where, status.error().message);
    lines.push_back(std::move(line));
  }
  return lines;
}

Result<MotorTrack> ScanRows::ReadTrack(const ScanRow& scan) const {
  FORESIGHT_TRY(SqliteStatement select,
                database_.Prepare("SELECT batch, data, crc32 FROM motor WHERE scan_id = ? "
                                  "ORDER BY batch"));
  select.Bind(scan.id);
  std::vector<MotorSample> samples;
  std::int64_t batches = 0;
  for (;; ++batches) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) break;
    const std::int64_t batch = select.Integer(0);
    const std::string data = select.Blob(1);
    if (batch != batches || data.size() % sizeof(MotorSample) != 0 ||
        select.Integer(2) != MotorChecksum(scan.id, batch, data))
      return Fail(ErrorCode::kBadData, "{}: scan {}, motor samples {} are damaged (checksum)",
                  file_, scan.id, batches);
    const std::size_t begin = samples.size();
    samples.resize(begin + data.size() / sizeof(MotorSample));
    if (!data.empty()) std::memcpy(samples.data() + begin, data.data(), data.size());
  }
  FORESIGHT_CHECK(CheckCount(scan, "batches of motor samples", static_cast<std::size_t>(batches),
                             scan.motor_batches));
  auto track = MotorTrack::FromSamples(std::move(samples));
  if (!track)
    return Fail(ErrorCode::kBadData, "{}: scan {}: {}", file_, scan.id, track.error().message);
  return track;
}

Result<CameraFrame> ScanRows::ReadFrame(const SqliteStatement& row, std::int64_t scan_id,
                                        std::int64_t position) const {
  std::int64_t data_crc = 0;
  FORESIGHT_TRY(CameraFrame frame, ReadFrameRow(row, scan_id, position, data_crc));
  const std::string png = row.Blob(kPngColumn);
  const std::string where = fmt::format("{}: scan {}, image {}", file_, scan_id, position);
  if (RowChecksum().Add(png).value() != data_crc)
    return Fail(ErrorCode::kBadData, "{} is damaged (checksum)", where);
  FORESIGHT_TRY(frame.image, DecodePng(png, where));
  return frame;
}

Result<CameraFrame> ScanRows::ReadFrameRow(const SqliteStatement& row, std::int64_t scan_id,
                                           std::int64_t position, std::int64_t& data_crc) const {
  CameraFrame frame;
  frame.seq = row.Integer(1);
  frame.time_s = row.Number(2);
  frame.exposure_s = row.Number(3);
  frame.gain_db = row.Number(4);
  frame.motor_angle_rad = row.Number(5);
  frame.target_angle_rad = row.Number(6);
  data_crc = row.Integer(7);
  if (row.Integer(0) != position || row.Integer(8) != Checksum(scan_id, position, frame, data_crc))
    return Fail(ErrorCode::kBadData, "{}: scan {}, image {} is damaged (checksum)", file_, scan_id,
                position);
  return frame;
}

Result<std::vector<CameraFrame>> ScanRows::ReadFrames(const ScanRow& scan) const {
  FORESIGHT_TRY(SqliteStatement select,
                database_.Prepare(fmt::format("SELECT {}, png FROM image LEFT JOIN image_data "
                                              "USING(scan_id, position) WHERE scan_id = ? "
                                              "ORDER BY position",
                                              kImageColumns)
                                      .c_str()));
  select.Bind(scan.id);
  std::vector<CameraFrame> frames;
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) break;
    FORESIGHT_TRY(CameraFrame frame,
                  ReadFrame(select, scan.id, static_cast<std::int64_t>(frames.size())));
    frames.push_back(std::move(frame));
  }
  FORESIGHT_CHECK(CheckCount(scan, "images", frames.size(), scan.frames));
  return frames;
}

Result<CameraFrame> ScanRows::ReadImage(std::int64_t scan_id, std::int64_t position) const {
  FORESIGHT_TRY(SqliteStatement select,
                database_.Prepare(fmt::format("SELECT {}, png FROM image LEFT JOIN image_data "
                                              "USING(scan_id, position) WHERE scan_id = ? AND "
                                              "position = ?",
                                              kImageColumns)
                                      .c_str()));
  select.Bind(scan_id).Bind(position);
  FORESIGHT_TRY(const bool found, select.Step());
  if (!found)
    return Fail(ErrorCode::kInvalidInput, "{}: scan {} has no image {}", file_, scan_id, position);
  return ReadFrame(select, scan_id, position);
}

Result<std::vector<ImageSummary>> ScanRows::ReadImageList(const ScanRow& scan) const {
  FORESIGHT_TRY(
      SqliteStatement select,
      database_.Prepare(fmt::format("SELECT {}, substr(png, 1, {}) FROM image LEFT JOIN image_data "
                                    "USING(scan_id, position) WHERE scan_id = ? ORDER BY position",
                                    kImageColumns, kPngHeaderBytes)
                            .c_str()));
  select.Bind(scan.id);
  std::vector<ImageSummary> images;
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) break;
    ImageSummary image;
    image.position = static_cast<std::int64_t>(images.size());
    std::int64_t data_crc = 0;
    FORESIGHT_TRY(const CameraFrame frame, ReadFrameRow(select, scan.id, image.position, data_crc));
    image.seq = frame.seq;
    image.time_s = frame.time_s;
    image.exposure_s = frame.exposure_s;
    image.gain_db = frame.gain_db;
    image.motor_angle_rad = frame.motor_angle_rad;
    image.target_angle_rad = frame.target_angle_rad;
    FORESIGHT_TRY(std::tie(image.width, image.height),
                  PngSize(select.Blob(kPngColumn),
                          fmt::format("{}: scan {}, image {}", file_, scan.id, image.position)));
    images.push_back(image);
  }
  FORESIGHT_CHECK(CheckCount(scan, "images", images.size(), scan.frames));
  return images;
}

Status ScanRows::CheckCount(const ScanRow& scan, const char* what, std::size_t found,
                            std::int64_t expected) const {
  const bool ended = scan.state != ScanState::kRunning;
  if (!ended || expected == static_cast<std::int64_t>(found)) return {};
  return Fail(ErrorCode::kBadData, "{}: scan {}: {} {} of {} are there", file_, scan.id, found,
              what, expected);
}

Result<Scan> ScanRows::ReadHeader(const ScanRow& row) const {
  Scan scan;
  scan.uuid = row.uuid;
  scan.start_utc_ns = row.start_utc_ns;
  scan.source = row.source;
  scan.simulated = row.simulated;
  scan.plan = row.plan;
  scan.state = row.state;
  scan.reason = row.reason;
  FORESIGHT_TRY(scan.rig, ReadRig(row.calibration_id));
  return scan;
}

Result<Scan> ScanRows::ReadScan(const ScanRow& row) const {
  FORESIGHT_TRY(Scan scan, ReadHeader(row));
  FORESIGHT_TRY(scan.lines, ReadLines(row.id, std::numeric_limits<std::int64_t>::min(),
                                      std::numeric_limits<std::size_t>::max()));
  if (scan.lines.empty()) {
    FORESIGHT_TRY(scan.given, ReadGiven(row.id));
    FORESIGHT_TRY(const std::int64_t lines, CountLines(row.id));
    FORESIGHT_CHECK(CheckCount(row, "lines", static_cast<std::size_t>(lines), row.lines));
  } else {
    FORESIGHT_CHECK(CheckCount(row, "lines", scan.lines.size(), row.lines));
  }
  FORESIGHT_TRY(scan.track, ReadTrack(row));
  FORESIGHT_TRY(scan.frames, ReadFrames(row));
  return scan;
}

}  // namespace foresight
