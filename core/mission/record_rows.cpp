#include "core/mission/record_rows.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "core/mission/row_checksum.h"

namespace foresight {
namespace {

std::int64_t Checksum1(const DetectionRecord& d) {
  return RowChecksum().Add(d.id).Add(d.scan_id).Add(d.kind).Add(d.utc_ns).Add(d.json).value();
}

std::int64_t Checksum(const DetectionRecord& d) {
  return RowChecksum()
      .Add(d.id)
      .Add(d.uuid)
      .Add(d.scan_id)
      .Add(d.scan_uuid)
      .Add(d.kind)
      .Add(d.utc_ns)
      .Add(d.author)
      .Add(d.json)
      .Add(d.provenance_json)
      .value();
}

std::int64_t Checksum(std::int64_t id, std::int64_t detection_id, const DetectionEvent& event,
                      std::string_view action) {
  return RowChecksum()
      .Add(id)
      .Add(detection_id)
      .Add(event.utc_ns)
      .Add(event.author)
      .Add(action)
      .Add(event.text)
      .value();
}

std::int64_t Checksum(const DepthRecord& d, std::string_view statistics_json) {
  return RowChecksum()
      .Add(d.id)
      .Add(d.uuid)
      .Add(d.scan_id)
      .Add(d.scan_uuid)
      .Add(d.image_position)
      .Add(d.utc_ns)
      .Add(d.author)
      .Add(d.provenance_json)
      .Add(d.digest)
      .Add(statistics_json)
      .value();
}

std::int64_t Checksum(const NoteRecord& n) {
  return RowChecksum()
      .Add(n.id)
      .Add(n.uuid)
      .Add(n.scan_id)
      .Add(n.scan_uuid)
      .Add(n.object_uuid)
      .Add(n.kind)
      .Add(n.utc_ns)
      .Add(n.author)
      .Add(n.text)
      .Add(n.tags)
      .Add(n.json)
      .Add(std::int64_t{n.deleted ? 1 : 0})
      .value();
}

std::int64_t Checksum(const EventRecord& e) {
  return RowChecksum()
      .Add(e.id)
      .Add(e.utc_ns)
      .Add(e.source)
      .Add(e.severity)
      .Add(e.text)
      .Add(e.json)
      .value();
}

/// The scan of a record: NULL where it is in another file.
void BindScan(SqliteStatement& statement, std::int64_t scan_id) {
  if (scan_id == 0)
    statement.BindNull();
  else
    statement.Bind(scan_id);
}

/// What stands first in every record of a scan: id, uuid, scan_id, scan_uuid.
template <class Record>
void BindIdentity(SqliteStatement& insert, const Record& record) {
  insert.Bind(record.id).BindText(record.uuid);
  BindScan(insert, record.scan_id);
  insert.BindText(record.scan_uuid);
}

/// The reverse, of a row that begins with these four.
template <class Record>
Record WithIdentity(const SqliteStatement& row) {
  Record record;
  record.id = row.Integer(0);
  record.uuid = row.Text(1);
  record.scan_id = row.Integer(2);
  record.scan_uuid = row.Text(3);
  return record;
}

/// What `read` makes of each row of a statement.
template <class Read>
auto ReadRows(SqliteStatement& select, const Read& read)
    -> Result<std::vector<typename std::invoke_result_t<Read>::value_type>> {
  std::vector<typename std::invoke_result_t<Read>::value_type> values;
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) return values;
    FORESIGHT_TRY(auto value, read());
    values.push_back(std::move(value));
  }
}

Result<std::int64_t> NextId(const SqliteDatabase& database, const char* table) {
  return database.Integer(fmt::format("SELECT coalesce(max(id), 0) + 1 FROM {}", table).c_str());
}

/// Format 1 had no uuid: what stands for it is the same before and after the file is migrated.
std::string UuidOfFormat1(const DetectionRecord& detection) {
  return fmt::format("{}#{}", detection.scan_uuid, detection.id);
}

Result<std::vector<DetectionRecord>> ReadDetections1(const SqliteDatabase& database,
                                                     std::optional<std::int64_t> scan_id,
                                                     const std::string& file) {
  FORESIGHT_TRY(SqliteStatement select,
                database.Prepare("SELECT d.id, d.scan_id, d.kind, d.utc_ns, d.json, d.crc32, "
                                 "s.uuid FROM detection d LEFT JOIN scan s ON s.id = d.scan_id "
                                 "WHERE ? < 0 OR d.scan_id = ? ORDER BY d.id"));
  select.Bind(scan_id.value_or(-1)).Bind(scan_id.value_or(-1));
  return ReadRows(select, [&]() -> Result<DetectionRecord> {
    DetectionRecord detection;
    detection.id = select.Integer(0);
    detection.scan_id = select.Integer(1);
    detection.kind = select.Text(2);
    detection.utc_ns = select.Integer(3);
    detection.json = select.Text(4);
    if (select.Integer(5) != Checksum1(detection))
      return Fail(ErrorCode::kBadData, "{}: detection {} is damaged (checksum)", file,
                  detection.id);
    detection.scan_uuid = select.Text(6);
    detection.uuid = UuidOfFormat1(detection);
    return detection;
  });
}

void Apply(const DetectionEvent& event, DetectionRecord& detection) {
  using Action = DetectionEvent::Action;
  switch (event.action) {
    case Action::kRenamed:
      detection.name = event.text;
      return;
    case Action::kDeleted:
    case Action::kRestored:
      detection.deleted = event.action == Action::kDeleted;
      return;
    case Action::kSent:
      return;
    case Action::kAccepted:
      detection.decision = Decision::kAccepted;
      break;
    case Action::kRejected:
      detection.decision = Decision::kRejected;
      break;
    case Action::kReopened:
      detection.decision = Decision::kOpen;
      break;
  }
  // Open again, there is no answer that a decision is about.
  detection.decided_candidate =
      event.action == Action::kReopened ? 0 : DecidedCandidateOf(event.text);
  detection.decided_utc_ns = event.utc_ns;
  detection.decided_by = event.author;
}

std::string StatisticsToJson(const DepthStatistics& statistics) {
  return nlohmann::json{{"valid_pixels", statistics.valid_pixels},
                        {"masked_pixels", statistics.masked_pixels},
                        {"depth_quantiles_m", statistics.depth_quantiles_m},
                        {"largest_confidence", statistics.largest_confidence}}
      .dump();
}

Result<DepthStatistics> StatisticsFromJson(const std::string& json, const std::string& where) {
  try {
    const nlohmann::json value = nlohmann::json::parse(json);
    DepthStatistics statistics;
    value.at("valid_pixels").get_to(statistics.valid_pixels);
    value.at("masked_pixels").get_to(statistics.masked_pixels);
    const nlohmann::json& quantiles = value.at("depth_quantiles_m");
    for (std::size_t i = 0; i < statistics.depth_quantiles_m.size(); ++i) {
      const nlohmann::json& quantile = quantiles.at(i);
      statistics.depth_quantiles_m[i] =
          quantile.is_null() ? std::numeric_limits<double>::quiet_NaN() : quantile.get<double>();
    }
    value.at("largest_confidence").get_to(statistics.largest_confidence);
    return statistics;
  } catch (const nlohmann::json::exception& error) {
    return Fail(ErrorCode::kBadData, "{}: statistics: {}", where, error.what());
  }
}

}  // namespace

Result<std::int64_t> InsertDetection(SqliteDatabase& database, DetectionRecord detection) {
  if (detection.id == 0) {
    FORESIGHT_TRY(detection.id, NextId(database, "detection"));
  }
  FORESIGHT_TRY(
      SqliteStatement insert,
      database.Prepare("INSERT INTO detection(id, uuid, scan_id, scan_uuid, kind, utc_ns, "
                       "author, json, provenance_json, crc32) "
                       "VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  BindIdentity(insert, detection);
  FORESIGHT_CHECK(insert.BindText(detection.kind)
                      .Bind(detection.utc_ns)
                      .BindText(detection.author)
                      .BindText(detection.json)
                      .BindText(detection.provenance_json)
                      .Bind(Checksum(detection))
                      .Run());
  return detection.id;
}

Result<std::vector<DetectionRecord>> ReadDetections(const SqliteDatabase& database, int format,
                                                    std::optional<std::int64_t> scan_id,
                                                    const std::string& file) {
  if (format == 1) return ReadDetections1(database, scan_id, file);
  FORESIGHT_TRY(const auto events, ReadDetectionEvents(database, std::nullopt, file));
  FORESIGHT_TRY(SqliteStatement select,
                database.Prepare("SELECT id, uuid, scan_id, scan_uuid, kind, utc_ns, author, json, "
                                 "provenance_json, crc32 FROM detection WHERE ? < 0 OR scan_id = ? "
                                 "ORDER BY id"));
  select.Bind(scan_id.value_or(-1)).Bind(scan_id.value_or(-1));
  return ReadRows(select, [&]() -> Result<DetectionRecord> {
    auto detection = WithIdentity<DetectionRecord>(select);
    detection.kind = select.Text(4);
    detection.utc_ns = select.Integer(5);
    detection.author = select.Text(6);
    detection.json = select.Text(7);
    detection.provenance_json = select.Text(8);
    if (select.Integer(9) != Checksum(detection))
      return Fail(ErrorCode::kBadData, "{}: detection {} is damaged (checksum)", file,
                  detection.id);
    if (const auto found = events.find(detection.id); found != events.end())
      for (const DetectionEvent& event : found->second) Apply(event, detection);
    return detection;
  });
}

Result<std::map<std::int64_t, std::int64_t>> CountObjects(const SqliteDatabase& database,
                                                          int format) {
  FORESIGHT_TRY(
      SqliteStatement select,
      database.Prepare(
          format == 1
              ? "SELECT scan_id, count(*) FROM detection GROUP BY scan_id"
              : "WITH last(detection_id, event_id) AS (SELECT detection_id, max(id) FROM "
                "detection_event WHERE action IN ('deleted', 'restored') GROUP BY detection_id) "
                "SELECT scan_id, count(*) FROM detection WHERE id NOT IN (SELECT last.detection_id "
                "FROM last JOIN detection_event ON detection_event.id = last.event_id WHERE "
                "action = 'deleted') GROUP BY scan_id"));
  std::map<std::int64_t, std::int64_t> counts;
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) return counts;
    counts[select.Integer(0)] = select.Integer(1);
  }
}

Status InsertDetectionEvent(SqliteDatabase& database, std::int64_t detection_id,
                            const DetectionEvent& event) {
  FORESIGHT_TRY(const std::int64_t id, NextId(database, "detection_event"));
  FORESIGHT_TRY(SqliteStatement insert,
                database.Prepare("INSERT INTO detection_event(id, detection_id, utc_ns, author, "
                                 "action, text, crc32) VALUES(?, ?, ?, ?, ?, ?, ?)"));
  return insert.Bind(id)
      .Bind(detection_id)
      .Bind(event.utc_ns)
      .BindText(event.author)
      .BindText(ToString(event.action))
      .BindText(event.text)
      .Bind(Checksum(id, detection_id, event, ToString(event.action)))
      .Run();
}

Result<std::map<std::int64_t, std::vector<DetectionEvent>>> ReadDetectionEvents(
    const SqliteDatabase& database, std::optional<std::int64_t> detection_id,
    const std::string& file) {
  FORESIGHT_TRY(SqliteStatement select,
                database.Prepare("SELECT id, detection_id, utc_ns, author, action, text, crc32 "
                                 "FROM detection_event WHERE ? < 0 OR detection_id = ? "
                                 "ORDER BY id"));
  select.Bind(detection_id.value_or(-1)).Bind(detection_id.value_or(-1));
  std::map<std::int64_t, std::vector<DetectionEvent>> events;
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) return events;
    const std::int64_t id = select.Integer(0);
    const std::int64_t of_detection = select.Integer(1);
    const std::string action = select.Text(4);
    DetectionEvent event;
    event.utc_ns = select.Integer(2);
    event.author = select.Text(3);
    event.text = select.Text(5);
    const std::string where = fmt::format("{}: decision {} on a detection", file, id);
    if (select.Integer(6) != Checksum(id, of_detection, event, action))
      return Fail(ErrorCode::kBadData, "{} is damaged (checksum)", where);
    const auto known = DetectionActionFromString(action);
    if (!known) return Fail(ErrorCode::kBadData, "{}: {}", where, known.error().message);
    event.action = *known;
    events[of_detection].push_back(std::move(event));
  }
}

Result<std::int64_t> InsertDepth(SqliteDatabase& database, DepthRecord depth) {
  FORESIGHT_TRY(depth.id, NextId(database, "depth"));
  const std::string statistics = StatisticsToJson(depth.statistics);
  FORESIGHT_TRY(SqliteStatement insert,
                database.Prepare("INSERT INTO depth(id, uuid, scan_id, scan_uuid, image_position, "
                                 "utc_ns, author, provenance_json, digest, statistics_json, crc32) "
                                 "VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  BindIdentity(insert, depth);
  FORESIGHT_CHECK(insert.Bind(depth.image_position)
                      .Bind(depth.utc_ns)
                      .BindText(depth.author)
                      .BindText(depth.provenance_json)
                      .BindText(depth.digest)
                      .BindText(statistics)
                      .Bind(Checksum(depth, statistics))
                      .Run());
  return depth.id;
}

Result<std::vector<DepthRecord>> ReadDepths(const SqliteDatabase& database,
                                            std::optional<std::int64_t> scan_id,
                                            const std::string& file) {
  FORESIGHT_TRY(SqliteStatement select,
                database.Prepare("SELECT id, uuid, scan_id, scan_uuid, image_position, utc_ns, "
                                 "author, provenance_json, digest, statistics_json, crc32 FROM "
                                 "depth WHERE ? < 0 OR scan_id = ? ORDER BY id"));
  select.Bind(scan_id.value_or(-1)).Bind(scan_id.value_or(-1));
  return ReadRows(select, [&]() -> Result<DepthRecord> {
    auto depth = WithIdentity<DepthRecord>(select);
    depth.image_position = select.Integer(4);
    depth.utc_ns = select.Integer(5);
    depth.author = select.Text(6);
    depth.provenance_json = select.Text(7);
    depth.digest = select.Text(8);
    const std::string statistics = select.Text(9);
    const std::string where = fmt::format("{}: depth map {}", file, depth.id);
    if (select.Integer(10) != Checksum(depth, statistics))
      return Fail(ErrorCode::kBadData, "{} is damaged (checksum)", where);
    FORESIGHT_TRY(depth.statistics, StatisticsFromJson(statistics, where));
    return depth;
  });
}

Result<std::int64_t> InsertNote(SqliteDatabase& database, NoteRecord note) {
  FORESIGHT_TRY(note.id, NextId(database, "note"));
  FORESIGHT_TRY(SqliteStatement insert,
                database.Prepare("INSERT INTO note(id, uuid, scan_id, scan_uuid, object_uuid, "
                                 "kind, utc_ns, author, text, tags, json, deleted, crc32) "
                                 "VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  BindIdentity(insert, note);
  FORESIGHT_CHECK(insert.BindText(note.object_uuid)
                      .BindText(note.kind)
                      .Bind(note.utc_ns)
                      .BindText(note.author)
                      .BindText(note.text)
                      .BindText(note.tags)
                      .BindText(note.json)
                      .Bind(std::int64_t{note.deleted ? 1 : 0})
                      .Bind(Checksum(note))
                      .Run());
  return note.id;
}

Result<std::vector<NoteRecord>> ReadNotes(const SqliteDatabase& database, const std::string& file) {
  FORESIGHT_TRY(SqliteStatement select,
                database.Prepare("SELECT id, uuid, scan_id, scan_uuid, object_uuid, kind, utc_ns, "
                                 "author, text, tags, json, deleted, crc32 FROM note ORDER BY id"));
  FORESIGHT_TRY(const std::vector<NoteRecord> states, ReadRows(select, [&]() -> Result<NoteRecord> {
                  auto note = WithIdentity<NoteRecord>(select);
                  note.object_uuid = select.Text(4);
                  note.kind = select.Text(5);
                  note.utc_ns = select.Integer(6);
                  note.author = select.Text(7);
                  note.text = select.Text(8);
                  note.tags = select.Text(9);
                  note.json = select.Text(10);
                  note.deleted = select.Integer(11) != 0;
                  if (select.Integer(12) != Checksum(note))
                    return Fail(ErrorCode::kBadData, "{}: note {} is damaged (checksum)", file,
                                note.id);
                  return note;
                }));
  return CurrentNotes(states);
}

Result<std::int64_t> InsertEvent(SqliteDatabase& database, EventRecord event) {
  FORESIGHT_TRY(event.id, NextId(database, "event"));
  FORESIGHT_TRY(
      SqliteStatement insert,
      database.Prepare("INSERT INTO event(id, utc_ns, source, severity, text, json, crc32) "
                       "VALUES(?, ?, ?, ?, ?, ?, ?)"));
  FORESIGHT_CHECK(insert.Bind(event.id)
                      .Bind(event.utc_ns)
                      .BindText(event.source)
                      .BindText(event.severity)
                      .BindText(event.text)
                      .BindText(event.json)
                      .Bind(Checksum(event))
                      .Run());
  return event.id;
}

Result<std::vector<EventRecord>> ReadEvents(const SqliteDatabase& database,
                                            const std::string& file) {
  FORESIGHT_TRY(SqliteStatement select,
                database.Prepare("SELECT id, utc_ns, source, severity, text, json, crc32 FROM "
                                 "event ORDER BY id"));
  return ReadRows(select, [&]() -> Result<EventRecord> {
    EventRecord event{select.Integer(0), select.Integer(1), select.Text(2),
                      select.Text(3),    select.Text(4),    select.Text(5)};
    if (select.Integer(6) != Checksum(event))
      return Fail(ErrorCode::kBadData, "{}: event {} is damaged (checksum)", file, event.id);
    return event;
  });
}

}  // namespace foresight
