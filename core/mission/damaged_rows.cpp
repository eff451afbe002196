#include "core/mission/damaged_rows.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "core/mission/row_checksum.h"

namespace foresight {
namespace {

using Key = DamagedRows::Key;

constexpr const char* kChecksum = "its checksum is wrong";
constexpr std::int64_t kMostProbes = 1'000'000;  ///< rows of one tree that are asked for one by one

bool HasColumn(const StoredTable& table, std::string_view name) {
  return std::any_of(table.columns.begin(), table.columns.end(),
                     [name](const StoredTable::Column& column) { return column.name == name; });
}

std::string PlaceOf(const std::string& table, Key key) {
  const auto& [scan, number] = key;
  if (table == "line") return fmt::format("scan {}, line {}", scan, number);
  if (table == "given_line") return fmt::format("scan {}, line {} of its cloud", scan, number);
  if (table == "motor") return fmt::format("scan {}, motor samples {}", scan, number);
  if (table == "image") return fmt::format("scan {}, image {}", scan, number);
  if (table == "image_data") return fmt::format("scan {}, image {}: its pixels", scan, number);
  if (table == "thumbnail") return fmt::format("scan {}: its thumbnail", number);
  if (table == "scan") return fmt::format("scan {}: its own entry", number);
  if (table == "calibration") return fmt::format("rig {}", number);
  if (table == "detection_event") return fmt::format("decision {} on a detection", number);
  if (table == "depth") return fmt::format("depth map {}", number);
  return fmt::format("{} {}", table, number);
}

/// Tables whose rows belong to a scan, which counts them in the column of the second name.
struct Counted {
  const char* table;
  const char* column;
  const char* words;
};
constexpr Counted kCounted[] = {{"line", "lines", "lines"},
                                {"motor", "motor_batches", "batches of motor samples"},
                                {"image", "frames", "images"},
                                {"image_data", "frames", "images' pixels"}};

const Counted* CountedIn(std::string_view table) {
  if (table == "given_line") table = "line";
  for (const Counted& counted : kCounted)
    if (table == counted.table) return &counted;
  return nullptr;
}

/// The column behind scan_id that numbers the rows of a scan.
std::string NumberColumn(const StoredTable& table) {
  return table.columns[1].name;
}

/// Bytes that are no record decode now and then, but hardly ever with contents as long as those
/// that our tables have.
bool LooksWritten(const DamagedRows::Row& row) {
  return std::any_of(row.begin(), row.end(), [](const StoredValue& value) {
    const auto* text = std::get_if<std::string>(&value);
    const auto* blob = std::get_if<StoredBlob>(&value);
    return (text != nullptr && text->size() > 3) || (blob != nullptr && blob->bytes.size() > 3);
  });
}

/// Reads rows until there are no more, or they cannot be read.
Status ReadRows(SqliteStatement& select, const StoredTable& table, DamagedRows& rows) {
  for (;;) {
    FORESIGHT_TRY(const bool more, select.Step());
    if (!more) return {};
    rows.Take(table, StoredValuesOf(select, table));
  }
}

/// Asks for one row.
void Probe(const SqliteDatabase& database, const StoredTable& table, Key key, DamagedRows& rows) {
  if (rows.Has(table, key)) return;
  const auto read = [&]() -> Status {
    FORESIGHT_TRY(
        SqliteStatement select,
        database.Prepare(table.rowid
                             ? fmt::format("SELECT * FROM {} WHERE rowid = ?", table.name).c_str()
                             : fmt::format("SELECT * FROM {} WHERE scan_id = ? AND {} = ?",
                                           table.name, NumberColumn(table))
                                   .c_str()));
    if (!table.rowid) select.Bind(key.first);
    select.Bind(key.second);
    return ReadRows(select, table, rows);
  };
  if (const Status status = read(); !status)
    rows.TakeUnreadable(table, key, "cannot be read, its page is damaged");
}

/// The numbers that an index has of a scan's rows; as many as can be read.
std::vector<std::int64_t> NumbersInIndex(const SqliteDatabase& database, const StoredTable& table,
                                         std::int64_t scan) {
  std::vector<std::int64_t> numbers;
  for (const char* order : {"ASC", "DESC"}) {
    auto select = database.Prepare(fmt::format("SELECT {0} FROM {1} WHERE scan_id = ? ORDER BY "
                                               "{0} {2}",
                                               NumberColumn(table), table.name, order)
                                       .c_str());
    if (!select) return numbers;
    select->Bind(scan);
    for (auto more = select->Step(); more && *more; more = select->Step())
      numbers.push_back(select->Integer(0));
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

void ProbeNumbered(const SqliteDatabase& database, const StoredTable& table, DamagedRows& rows) {
  const auto last =
      database.Integer(fmt::format("SELECT coalesce(max(rowid), 0) FROM {}", table.name).c_str());
  if (!last) return;
  for (std::int64_t id = 1; id <= std::min(*last, kMostProbes); ++id)
    Probe(database, table, {0, id}, rows);
}

void ProbeScans(const SqliteDatabase& database, const StoredTable& table, DamagedRows& rows) {
  const bool numbers_have_holes = table.name == "line" || table.name == "given_line";
  for (const auto& [scan, count] : rows.CountsIn(table.name)) {
    if (numbers_have_holes || count < 0) {
      for (const std::int64_t number : NumbersInIndex(database, table, scan))
        Probe(database, table, {scan, number}, rows);
    } else {
      for (std::int64_t number = 0; number < std::min(count, kMostProbes); ++number)
        Probe(database, table, {scan, number}, rows);
    }
  }
}

}  // namespace

DamagedRows::Key KeyOf(const StoredTable& table, const DamagedRows::Row& row) {
  const auto whole = [&row](std::size_t column) {
    const auto* value = std::get_if<std::int64_t>(&row[column]);
    return value != nullptr ? *value : 0;
  };
  if (table.rowid) return {0, whole(*table.rowid)};
  return {whole(0), whole(1)};
}

bool DamagedRows::IsGood(const StoredTable& table, const Row& row) const {
  if (table.checksum) return HasGoodChecksum(table, row);
  const auto* png = std::get_if<StoredBlob>(&row.back());
  const auto wanted = pixels_.find(KeyOf(table, row));
  return png != nullptr && wanted != pixels_.end() &&
         RowChecksum().Add(png->bytes).value() == wanted->second;
}

bool DamagedRows::MayBe(const StoredTable& table, Key key) const {
  const auto& [scan, number] = key;
  if (number < 0) return false;
  if (table.rowid) {
    const auto seen = seen_.find(table.name);
    const std::int64_t last =
        seen == seen_.end() || seen->second.good.empty() ? 0 : seen->second.good.rbegin()->second;
    return number >= 1 && number <= last + 1;
  }
  const auto counts = CountsIn(table.name);
  const auto count = counts.find(scan);
  if (count == counts.end()) return false;
  // A lost line leaves a hole in the numbers of lines; hardly half of them are lost.
  const bool holes = table.name == "line" || table.name == "given_line";
  return count->second < 0 || number < count->second * (holes ? 2 : 1);
}

void DamagedRows::Take(const StoredTable& table, const Row& row) {
  if (table.name == "meta") return;
  const Key key = KeyOf(table, row);
  Seen& seen = seen_[table.name];
  // What the pixels of an image were stands in the image's own row; where that is damaged nobody
  // can judge them.
  const bool judged = table.name != "image_data" || !seen_["image"].bad.contains(key);
  if (judged && !IsGood(table, row)) {
    if (!seen.good.contains(key)) seen.bad.emplace(key, kChecksum);
    return;
  }
  seen.bad.erase(key);
  seen.good.insert(key);
  if (table.name == "image") pixels_[key] = WholeOf(table, row, "data_crc32");
  if (table.name != "scan") return;
  const auto [known, is_new] = scans_.try_emplace(key.second, row);
  // A page that SQLite no longer uses may hold the row from before the scan's end.
  if (!is_new && WholeOf(table, known->second, "lines") < 0) known->second = row;
}

void DamagedRows::TakeUnreadable(const StoredTable& table, Key key, const std::string& why) {
  if (!Has(table, key)) seen_[table.name].bad.emplace(key, why);
}

void DamagedRows::Tell(DamagedRecord record) {
  told_.push_back(std::move(record));
}

bool DamagedRows::Has(const StoredTable& table, Key key) const {
  const auto seen = seen_.find(table.name);
  return seen != seen_.end() && (seen->second.good.contains(key) || seen->second.bad.contains(key));
}

bool DamagedRows::AnyGood() const {
  return std::any_of(seen_.begin(), seen_.end(),
                     [](const auto& seen) { return !seen.second.good.empty(); });
}

std::map<std::int64_t, std::int64_t> DamagedRows::CountsIn(const std::string& table) const {
  std::map<std::int64_t, std::int64_t> counts;
  const Counted* counted = CountedIn(table);
  for (const auto& [id, row] : scans_)
    counts[id] =
        counted == nullptr ? -1 : WholeOf(TableNamed(tables_, "scan"), row, counted->column);
  return counts;
}

void DamagedRows::TellMissing() {
  for (const Counted& counted : kCounted)
    for (const auto& [scan, count] : CountsIn(counted.table)) {
      std::int64_t found = 0;
      for (const char* table : {counted.table, "given_line"}) {
        // The lines of an imported scan stand in a table of their own.
        if (table != std::string_view(counted.table) && counted.table != std::string_view("line"))
          continue;
        const Seen& seen = seen_[table];
        const auto of_scan = [scan = scan](const auto& each) { return each.first == scan; };
        found += std::count_if(seen.good.begin(), seen.good.end(), of_scan);
        found += std::count_if(seen.bad.begin(), seen.bad.end(), [scan = scan](const auto& each) {
          return each.first.first == scan;
        });
      }
      if (count > found)
        Tell({counted.table, fmt::format("scan {}", scan),
              fmt::format("{} of {} {} are missing", count - found, count, counted.words)});
    }
}

DamageReport DamagedRows::Report() {
  TellMissing();
  DamageReport report;
  std::set<std::int64_t> damaged_scans;
  const auto add = [&](DamagedRecord record) { report.Add(std::move(record), at_most_); };
  for (const DamagedRecord& record : told_)
    if (record.table == "file") add(record);
  for (const StoredTable& table : tables_)
    for (const auto& [key, why] : seen_[table.name].bad) {
      add({table.name, PlaceOf(table.name, key), why});
      damaged_scans.insert(table.rowid ? key.second : key.first);
    }
  for (const DamagedRecord& record : told_)
    if (record.table != "file") add(record);
  for (const auto& [id, row] : scans_) {
    const bool misses = std::any_of(told_.begin(), told_.end(), [id = id](const auto& record) {
      return record.where == fmt::format("scan {}", id);
    });
    if (!misses && !damaged_scans.contains(id)) report.sound_scans.push_back(id);
  }
  return report;
}

Status ReadThroughTables(const SqliteDatabase& database, const std::vector<StoredTable>& tables,
                         DamagedRows& rows, const RunContext& context) {
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const StoredTable& table = tables[i];
    if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the check was cancelled");
    context.Report(static_cast<double>(i) / static_cast<double>(tables.size()), "naming damage");
    FORESIGHT_TRY(
        SqliteStatement select,
        database.Prepare(fmt::format("SELECT * FROM {} NOT INDEXED", table.name).c_str()));
    if (const Status status = ReadRows(select, table, rows); status) continue;
    if (table.rowid)
      ProbeNumbered(database, table, rows);
    else if (HasColumn(table, "scan_id"))
      ProbeScans(database, table, rows);
  }
  return {};
}

Status ReadThroughPages(const SqlitePages& pages, const std::vector<StoredTable>& tables,
                        DamagedRows& rows, const RunContext& context) {
  std::set<std::pair<const StoredTable*, Key>> bad;
  // Twice: the pixels of an image are judged by the image's own row.
  for (const bool pixels : {false, true})
    for (std::uint32_t page = 1; page <= pages.count(); ++page) {
      if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the check was cancelled");
      context.Report((page + (pixels ? pages.count() : 0.0)) / (2.0 * pages.count()),
                     "reading pages");
      const auto take = [&](const StoredRow& stored) {
        bool known = false;
        for (const StoredTable& table : tables) {
          const auto row = AsRowOf(table, stored);
          if (!row || table.name == "meta" || (table.name == "image_data") != pixels) continue;
          const bool good = rows.IsGood(table, *row);
          if (good)
            rows.Take(table, *row);
          else if (LooksWritten(*row))
            bad.emplace(&table, KeyOf(table, *row));
          known = known || good;
        }
        return known;
      };
      FORESIGHT_CHECK(pages.VisitRows(page, take));
    }
  for (const auto& [table, key] : bad)
    if (rows.MayBe(*table, key)) rows.TakeUnreadable(*table, key, kChecksum);
  return {};
}

}  // namespace foresight
