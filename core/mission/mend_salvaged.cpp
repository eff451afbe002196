#include "core/mission/mend_salvaged.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/mission/scan_rows.h"

namespace foresight {
namespace {

using Row = std::vector<StoredValue>;
using OrderedJson = nlohmann::ordered_json;

std::string Text(const StoredTable& table, const Row& row, std::string_view column) {
  const auto* value = std::get_if<std::string>(&row[table.ColumnOf(column)]);
  return value != nullptr ? *value : std::string();
}

void Set(const StoredTable& table, Row& row, std::string_view column, StoredValue value) {
  row[table.ColumnOf(column)] = std::move(value);
  row[table.checksum.value()] = ChecksumOf(table, row);
}

class Mend {
 public:
  Mend(SqliteDatabase& database, const std::vector<StoredTable>& tables,
       const SalvageOptions& options, SalvageReport& report)
      : database_(database), tables_(tables), options_(options), report_(report) {}

  Status Run() {
    FORESIGHT_TRY(const std::vector<std::int64_t> ids, IdsOfScans());
    for (const std::int64_t id : ids) FORESIGHT_CHECK(MendScan(id));
    if (HasTable("thumbnail")) FORESIGHT_CHECK(DropThumbnailsWithoutScan());
    FORESIGHT_CHECK(MendRecords("detection", "detections", report_.detections));
    if (HasTable("depth")) FORESIGHT_CHECK(MendRecords("depth", "depth maps", report_.depth_maps));
    if (HasTable("note")) FORESIGHT_CHECK(MendRecords("note", "notes", report_.notes));
    if (HasTable("detection_event")) FORESIGHT_CHECK(DropEventsWithoutDetection());
    FORESIGHT_TRY(report_.events, database_.Integer("SELECT count(*) FROM event"));
    return {};
  }

 private:
  bool HasTable(std::string_view name) const {
    return std::any_of(tables_.begin(), tables_.end(),
                       [name](const StoredTable& table) { return table.name == name; });
  }

  Result<std::int64_t> Count(const char* sql, std::int64_t scan_id) {
    FORESIGHT_TRY(SqliteStatement select, database_.Prepare(sql));
    FORESIGHT_TRY(const bool row, select.Bind(scan_id).Step());
    return row ? select.Integer(0) : 0;
  }

  Status RunFor(const char* sql, std::int64_t scan_id) {
    FORESIGHT_TRY(SqliteStatement statement, database_.Prepare(sql));
    return statement.Bind(scan_id).Run();
  }

  /// Of every scan of which anything was found.
  Result<std::vector<std::int64_t>> IdsOfScans() {
    std::string all =
        "SELECT id FROM scan UNION SELECT scan_id FROM line UNION SELECT scan_id FROM motor UNION "
        "SELECT scan_id FROM image";
    if (HasTable("given_line")) all += " UNION SELECT scan_id FROM given_line";
    FORESIGHT_TRY(SqliteStatement select, database_.Prepare(all.c_str()));
    std::vector<std::int64_t> ids;
    for (;;) {
      FORESIGHT_TRY(const bool more, select.Step());
      if (!more) return ids;
      ids.push_back(select.Integer(0));
    }
  }

  Result<bool> HasRig(std::int64_t calibration_id) {
    FORESIGHT_TRY(const std::int64_t count,
                  Count("SELECT count(*) FROM calibration WHERE id = ?", calibration_id));
    return count > 0;
  }

  Status InsertRig(std::int64_t calibration_id) {
    const StoredTable& table = TableNamed(tables_, "calibration");
    Row row(table.columns.size());
    row[*table.rowid] = calibration_id;
    Set(table, row, "rig_yaml", SensorRigToYaml(*options_.rig));
    FORESIGHT_CHECK(InsertStored(database_, table, row));
    return {};
  }

  Status MendScan(std::int64_t id) {
    SalvagedScan scan;
    scan.id = id;
    FORESIGHT_TRY(scan.images, MendImages(id));
    FORESIGHT_TRY(const std::int64_t batches, MendMotor(id));
    FORESIGHT_TRY(scan.lines, Count("SELECT count(*) FROM line WHERE scan_id = ?", id));
    if (scan.lines == 0 && HasTable("given_line")) {
      FORESIGHT_TRY(scan.lines, Count("SELECT count(*) FROM given_line WHERE scan_id = ?", id));
    }
    const StoredTable& table = TableNamed(tables_, "scan");
    FORESIGHT_TRY(std::vector<Row> rows, ReadStored(database_, table, fmt::format("id = {}", id)));
    const bool own_row = !rows.empty();
    FORESIGHT_TRY(const bool usable, EnsureRow(scan, table, rows));
    if (!usable) {
      report_.scans.push_back(scan);
      return DropScan(id);
    }
    FORESIGHT_CHECK(TellEnd(table, rows.front(), batches, own_row, scan));
    report_.scans.push_back(scan);
    return {};
  }

  /// Whether the scan has its row and its rig, which stand in the database then.
  Result<bool> EnsureRow(const SalvagedScan& scan, const StoredTable& table,
                         std::vector<Row>& rows) {
    const std::string what = fmt::format(
        "scan {}: {} lines and {} images were found, but its {} is "
        "damaged",
        scan.id, scan.lines, scan.images, rows.empty() ? "own entry" : "rig");
    if (!rows.empty()) {
      const std::int64_t calibration = WholeOf(table, rows.front(), "calibration_id");
      FORESIGHT_TRY(const bool has_rig, HasRig(calibration));
      if (has_rig) return true;
      if (options_.rig) {
        FORESIGHT_CHECK(InsertRig(calibration));
        report_.losses.push_back(what + ": it got the rig that was given");
        return true;
      }
    } else if (options_.rig) {
      ScanRows inserter(database_, file_);
      Scan header;
      header.uuid = NewUuid();
      header.source = "salvaged: the scan's own entry was damaged";
      header.rig = *options_.rig;
      FORESIGHT_TRY(const std::int64_t id, inserter.InsertScan(header));
      FORESIGHT_CHECK(
          RunFor(fmt::format("UPDATE scan SET id = {} WHERE id = ?", scan.id).c_str(), id));
      FORESIGHT_TRY(rows, ReadStored(database_, table, fmt::format("id = {}", scan.id)));
      report_.losses.push_back(
          what + ": it got a new identity, no time, no plan, and the rig that was given");
      return true;
    }
    report_.losses.push_back(what + ": give the rig it was recorded with (--rig) to save them");
    return false;
  }

  /// Compares what there is with what the scan says it had.
  Status TellEnd(const StoredTable& table, Row& row, std::int64_t batches, bool own_row,
                 SalvagedScan& scan) {
    scan.saved = true;
    scan.uuid = own_row ? Text(table, row, "uuid") : "";
    FORESIGHT_TRY(const ScanState state, ScanStateFromString(Text(table, row, "state")));
    if (own_row) {
      scan.lines_before = WholeOf(table, row, "lines");
      scan.images_before = WholeOf(table, row, "frames");
    }
    const std::int64_t batches_before = WholeOf(table, row, "motor_batches");
    const bool whole = own_row && state != ScanState::kRunning && scan.lines == scan.lines_before &&
                       scan.images == scan.images_before && batches == batches_before;
    scan.state = whole ? state : ScanState::kInterrupted;
    if (whole) return {};
    std::string reason = "salvaged from a damaged file";
    if (own_row && state == ScanState::kRunning) {
      reason = "the recording program ended before the scan did";
    } else if (own_row) {
      reason += fmt::format(": {} of {} lines, {} of {} images, {} of {} batches of motor samples",
                            scan.lines, scan.lines_before, scan.images, scan.images_before, batches,
                            batches_before);
      report_.losses.push_back(fmt::format("scan {}: {}", scan.id, reason));
    }
    Set(table, row, "state", ToString(scan.state));
    Set(table, row, "reason", reason);
    Set(table, row, "lines", scan.lines);
    Set(table, row, "frames", scan.images);
    Set(table, row, "motor_batches", batches);
    FORESIGHT_CHECK(RunFor("DELETE FROM scan WHERE id = ?", scan.id));
    FORESIGHT_CHECK(InsertStored(database_, table, row));
    return {};
  }

  Status DropScan(std::int64_t id) {
    for (const char* sql :
         {"DELETE FROM scan WHERE id = ?", "DELETE FROM line WHERE scan_id = ?",
          "DELETE FROM motor WHERE scan_id = ?", "DELETE FROM image_data WHERE scan_id = ?",
          "DELETE FROM image WHERE scan_id = ?"})
      FORESIGHT_CHECK(RunFor(sql, id));
    if (HasTable("given_line"))
      FORESIGHT_CHECK(RunFor("DELETE FROM given_line WHERE scan_id = ?", id));
    return {};
  }

  /// Batches count up from 0. A hole in the track stays one: lines inside it get no angle.
  Result<std::int64_t> MendMotor(std::int64_t scan_id) {
    const StoredTable& table = TableNamed(tables_, "motor");
    FORESIGHT_TRY(
        std::vector<Row> rows,
        ReadStored(database_, table, fmt::format("scan_id = {} ORDER BY batch", scan_id)));
    const auto count = static_cast<std::int64_t>(rows.size());
    if (count == 0 || WholeOf(table, rows.back(), "batch") == count - 1) return count;
    FORESIGHT_CHECK(RunFor("DELETE FROM motor WHERE scan_id = ?", scan_id));
    std::int64_t batch = 0;
    for (Row& row : rows) {
      Set(table, row, "batch", batch++);
      FORESIGHT_CHECK(InsertStored(database_, table, row));
    }
    return count;
  }

  /// Images without pixels go, the others count up from 0.
  Result<std::int64_t> MendImages(std::int64_t scan_id) {
    FORESIGHT_CHECK(
        RunFor("DELETE FROM image WHERE scan_id = ? AND position NOT IN (SELECT "
               "position FROM image_data d WHERE d.scan_id = image.scan_id)",
               scan_id));
    const StoredTable& table = TableNamed(tables_, "image");
    FORESIGHT_TRY(
        std::vector<Row> rows,
        ReadStored(database_, table, fmt::format("scan_id = {} ORDER BY position", scan_id)));
    std::map<std::int64_t, std::int64_t>& moved = moved_[scan_id];
    std::int64_t position = 0;
    for (Row& row : rows) {
      const std::int64_t before = WholeOf(table, row, "position");
      moved[before] = position;
      if (before != position) FORESIGHT_CHECK(MoveImage(scan_id, before, position, table, row));
      ++position;
    }
    return position;
  }

  Status MoveImage(std::int64_t scan_id, std::int64_t before, std::int64_t position,
                   const StoredTable& table, Row& row) {
    Set(table, row, "position", position);
    FORESIGHT_CHECK(InsertStored(database_, table, row));
    FORESIGHT_CHECK(RunFor(fmt::format("UPDATE image_data SET position = {} WHERE position = {} "
                                       "AND scan_id = ?",
                                       position, before)
                               .c_str(),
                           scan_id));
    return RunFor(
        fmt::format("DELETE FROM image WHERE position = {} AND scan_id = ?", before).c_str(),
        scan_id);
  }

  Status DropThumbnailsWithoutScan() {
    return database_.Run("DELETE FROM thumbnail WHERE scan_id NOT IN (SELECT id FROM scan)");
  }

  /// Where image `position` of a scan is now; -1 = lost, or there was none.
  std::int64_t NewPosition(std::int64_t scan_id, std::int64_t position) const {
    const auto scan = moved_.find(scan_id);
    if (scan == moved_.end()) return -1;
    const auto image = scan->second.find(position);
    return image == scan->second.end() ? -1 : image->second;
  }

  /// Detections or depth maps: their scan and their image are where they are now.
  Status MendRecords(const char* name, const char* words, std::int64_t& count) {
    const StoredTable& table = TableNamed(tables_, name);
    FORESIGHT_TRY(std::vector<Row> rows, ReadStored(database_, table, "true"));
    count = static_cast<std::int64_t>(rows.size());
    std::int64_t without_scan = 0;
    for (Row& row : rows) {
      const std::int64_t scan_id = WholeOf(table, row, "scan_id");
      if (scan_id == 0) continue;  // of a review: its scans are elsewhere
      const Row before = row;
      PointToImage(table, row, scan_id);
      if (!Saved(scan_id)) {
        ++without_scan;
        Set(table, row, "scan_id", StoredValue());
      }
      if (row == before) continue;
      FORESIGHT_CHECK(RunFor(fmt::format("DELETE FROM {} WHERE id = ?", name).c_str(),
                             WholeOf(table, row, "id")));
      if (NamesScanByUuid(table)) {
        FORESIGHT_CHECK(InsertStored(database_, table, row));
      } else if (!Saved(scan_id)) {
        --count;
      }
    }
    if (without_scan > 0)
      report_.losses.push_back(
          fmt::format("{} {} are of scans that were not saved", without_scan, words));
    return {};
  }

  /// A row of format 1 names its scan by id only, and goes with it.
  static bool NamesScanByUuid(const StoredTable& table) {
    return std::any_of(table.columns.begin(), table.columns.end(),
                       [](const auto& column) { return column.name == "scan_uuid"; });
  }

  bool Saved(std::int64_t scan_id) const {
    return std::any_of(report_.scans.begin(), report_.scans.end(),
                       [&](const SalvagedScan& scan) { return scan.id == scan_id && scan.saved; });
  }

  void PointToImage(const StoredTable& table, Row& row, std::int64_t scan_id) const {
    for (const StoredTable::Column& column : table.columns) {
      if (column.name == "image_position") {
        const std::int64_t before = WholeOf(table, row, column.name);
        Set(table, row, column.name, NewPosition(scan_id, before));
      }
      if (column.name != "provenance_json") continue;
      OrderedJson json = OrderedJson::parse(Text(table, row, column.name), nullptr, false);
      if (!json.is_object() || !json.contains("image_position") ||
          !json["image_position"].is_number_integer())
        continue;
      const auto before = json["image_position"].get<std::int64_t>();
      const std::int64_t now = before < 0 ? before : NewPosition(scan_id, before);
      if (now == before) continue;
      json["image_position"] = now;
      Set(table, row, column.name,
          json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace));
    }
  }

  Status DropEventsWithoutDetection() {
    FORESIGHT_TRY(const std::int64_t lost,
                  database_.Integer("SELECT count(*) FROM detection_event WHERE detection_id NOT "
                                    "IN (SELECT id FROM detection)"));
    if (lost == 0) return {};
    report_.losses.push_back(fmt::format("{} decisions are of detections that are lost", lost));
    return database_.Run(
        "DELETE FROM detection_event WHERE detection_id NOT IN (SELECT id FROM detection)");
  }

  SqliteDatabase& database_;
  const std::vector<StoredTable>& tables_;
  const SalvageOptions& options_;
  SalvageReport& report_;
  const std::string file_ = "salvaged mission";
  /// Scan -> where an image was -> where it is.
  std::map<std::int64_t, std::map<std::int64_t, std::int64_t>> moved_;
};

}  // namespace

Status MendSalvaged(SqliteDatabase& database, const std::vector<StoredTable>& tables,
                    const SalvageOptions& options, SalvageReport& report) {
  return Mend(database, tables, options, report).Run();
}

}  // namespace foresight
