#include "core/mission/annotation_rows.h"

#include "core/mission/row_checksum.h"

namespace foresight {
namespace {

std::int64_t Checksum(const DetectionRecord& d) {
  return RowChecksum().Add(d.id).Add(d.scan_id).Add(d.kind).Add(d.utc_ns).Add(d.json).value();
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

}  // namespace

Result<std::int64_t> InsertDetection(SqliteDatabase& database, DetectionRecord detection) {
  FORESIGHT_TRY(detection.id, database.Integer("SELECT coalesce(max(id), 0) + 1 FROM detection"));
  FORESIGHT_TRY(SqliteStatement insert,
                database.Prepare("INSERT INTO detection(id, scan_id, kind, utc_ns, json, crc32) "
                                 "VALUES(?, ?, ?, ?, ?, ?)"));
  FORESIGHT_CHECK(insert.Bind(detection.id)
                      .Bind(detection.scan_id)
                      .BindText(detection.kind)
                      .Bind(detection.utc_ns)
                      .BindText(detection.json)
                      .Bind(Checksum(detection))
                      .Run());
  return detection.id;
}

Result<std::vector<DetectionRecord>> ReadDetections(const SqliteDatabase& database,
                                                    const std::string& file) {
  FORESIGHT_TRY(SqliteStatement select,
                database.Prepare("SELECT id, scan_id, kind, utc_ns, json, crc32 FROM detection "
                                 "ORDER BY id"));
  std::vector<DetectionRecord> detections;
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) return detections;
    const DetectionRecord detection{select.Integer(0), select.Integer(1), select.Text(2),
                                    select.Integer(3), select.Text(4)};
    if (select.Integer(5) != Checksum(detection))
      return Fail(ErrorCode::kBadData, "{}: detection {} is damaged (checksum)", file,
                  detection.id);
    detections.push_back(detection);
  }
}

Result<std::int64_t> InsertEvent(SqliteDatabase& database, EventRecord event) {
  FORESIGHT_TRY(event.id, database.Integer("SELECT coalesce(max(id), 0) + 1 FROM event"));
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
  std::vector<EventRecord> events;
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) return events;
    const EventRecord event{select.Integer(0), select.Integer(1), select.Text(2),
                            select.Text(3),    select.Text(4),    select.Text(5)};
    if (select.Integer(6) != Checksum(event))
      return Fail(ErrorCode::kBadData, "{}: event {} is damaged (checksum)", file, event.id);
    events.push_back(event);
  }
}

}  // namespace foresight
