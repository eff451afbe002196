#include "core/mission/mission_index.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "core/base/log.h"
#include "core/base/sha256.h"
#include "core/mission/mission_file.h"
#include "core/mission/sqlite.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

constexpr int kIndexVersion = 2;
constexpr const char* kTables[] = {
    "CREATE TABLE mission(path TEXT PRIMARY KEY, stamp TEXT NOT NULL, problem TEXT NOT NULL) "
    "STRICT",
    "CREATE TABLE entry(path TEXT NOT NULL, what TEXT NOT NULL, scan_uuid TEXT NOT NULL, scan "
    "INTEGER NOT NULL, utc_ns INTEGER NOT NULL, kind TEXT NOT NULL, decision TEXT NOT NULL, text "
    "TEXT NOT NULL) STRICT",
    "CREATE INDEX entry_of_path ON entry(path)",
};

/// Changes with every byte that is written: also while the mission is recorded into its log.
std::string StampOf(const fs::path& path) {
  std::string stamp;
  for (const char* suffix : {"", "-wal"}) {
    std::error_code error;
    const fs::path file = path.string() + suffix;
    const auto size = fs::file_size(file, error);
    if (error) continue;
    const auto time = fs::last_write_time(file, error).time_since_epoch().count();
    stamp += fmt::format("{} {};", size, time);
  }
  return stamp;
}

Result<std::vector<fs::path>> MissionsBelow(const fs::path& folder) {
  std::vector<fs::path> missions;
  std::error_code error;
  auto walk = fs::recursive_directory_iterator(
      folder, fs::directory_options::skip_permission_denied, error);
  if (error) return Fail(ErrorCode::kIo, "{}: {}", folder.string(), error.message());
  for (const auto end = fs::recursive_directory_iterator(); walk != end; walk.increment(error)) {
    if (error) return Fail(ErrorCode::kIo, "{}: {}", folder.string(), error.message());
    std::error_code ignored;
    if (walk->path().extension() == ".foresight" && walk->is_regular_file(ignored))
      missions.push_back(walk->path());
  }
  std::sort(missions.begin(), missions.end());
  return missions;
}

/// What an object's JSON says in a word.
std::string VerdictOf(const std::string& json) {
  const auto parsed = nlohmann::json::parse(json, nullptr, false);
  const auto verdict = parsed.is_object() ? parsed.find("verdict") : parsed.end();
  if (verdict == parsed.end() || !verdict->is_object()) return {};
  const auto level = verdict->find("level");
  return level != verdict->end() && level->is_string() ? level->get<std::string>() : std::string();
}

/// "note: the rim is cracked, #crack #valve, by ada".
std::string SearchText(const NoteRecord& note) {
  std::string text = fmt::format("{}: {}", note.kind, note.text);
  const auto json = nlohmann::json::parse(note.json, nullptr, false);
  if (json.is_object() && json.contains("label") && json.at("label").is_string())
    text += (note.text.empty() ? "" : ", ") + json.at("label").get<std::string>();
  std::string tags;
  for (const char c : note.tags) tags += c == ' ' ? std::string(" #") : std::string(1, c);
  if (!tags.empty()) text += ", #" + tags;
  return text + ", by " + note.made_by;
}

/// The index file of one folder.
class Index {
 public:
  static Result<Index> Open(const fs::path& file) {
    auto opened = OpenAsItIs(file);
    if (opened) return opened;
    std::error_code error;
    if (fs::exists(file, error))
      LogInfo("{}: the index is made again: {}", file.string(), opened.error().message);
    for (const char* suffix : {"", "-journal", "-wal", "-shm"})
      fs::remove(file.string() + suffix, error);
    return Make(file);
  }

  /// Reads what is new or changed, and forgets what is gone.
  Status Refresh(const std::vector<fs::path>& missions, MissionHits& out,
                 const RunContext& context) {
    FORESIGHT_TRY(auto known, Stamps());
    FORESIGHT_CHECK(database_.Run("BEGIN IMMEDIATE"));
    double done = 0.0;
    for (const fs::path& mission : missions) {
      if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the search was cancelled");
      context.Report(done++ / static_cast<double>(missions.size()), "reading missions");
      const std::string stamp = StampOf(mission);
      const auto before = known.find(mission.string());
      const bool same = before != known.end() && before->second == stamp;
      if (before != known.end()) known.erase(before);
      if (same) continue;
      ++out.read_again;
      FORESIGHT_CHECK(Forget(mission.string()));
      FORESIGHT_CHECK(Take(mission, stamp));
    }
    for (const auto& [path, stamp] : known) FORESIGHT_CHECK(Forget(path));
    return database_.Run("COMMIT");
  }

  Status Search(const MissionQuery& query, MissionHits& out) const {
    std::string sql = "SELECT path, what, scan_uuid, scan, utc_ns, text FROM entry WHERE true";
    if (query.what) sql += " AND what = ?";
    if (query.kind) sql += " AND kind = ?";
    if (query.decision) sql += " AND decision = ?";
    if (query.since_utc_ns) sql += " AND utc_ns >= ?";
    if (query.until_utc_ns) sql += " AND utc_ns < ?";
    for (std::size_t i = 0; i < query.words.size(); ++i)
      sql += " AND instr(lower(text), lower(?)) > 0";
    sql += " ORDER BY utc_ns DESC, path, text LIMIT ?";
    FORESIGHT_TRY(SqliteStatement select, database_.Prepare(sql.c_str()));
    for (const auto* text : {&query.what, &query.kind, &query.decision})
      if (*text) select.BindText(**text);
    for (const auto* time : {&query.since_utc_ns, &query.until_utc_ns})
      if (*time) select.Bind(**time);
    for (const std::string& word : query.words) select.BindText(word);
    select.Bind(static_cast<std::int64_t>(query.at_most));
    for (;;) {
      FORESIGHT_TRY(const bool more, select.Step());
      if (!more) break;
      out.hits.push_back({select.Text(0), select.Text(1), select.Text(2), select.Integer(3),
                          select.Integer(4), select.Text(5)});
    }
    return Problems(out);
  }

 private:
  explicit Index(SqliteDatabase database) : database_(std::move(database)) {}

  static Result<Index> OpenAsItIs(const fs::path& file) {
    std::error_code error;
    if (!fs::exists(file, error)) return Fail(ErrorCode::kIo, "there is none");
    FORESIGHT_TRY(SqliteDatabase database,
                  SqliteDatabase::Open(file, SqliteDatabase::Mode::kReadWrite));
    FORESIGHT_TRY(const std::int64_t version, database.Integer("PRAGMA user_version"));
    if (version != kIndexVersion)
      return Fail(ErrorCode::kBadData, "it has version {}, not {}", version, kIndexVersion);
    FORESIGHT_TRY(SqliteStatement check, database.Prepare("PRAGMA quick_check(1)"));
    FORESIGHT_TRY(const bool row, check.Step());
    if (!row || check.Text(0) != "ok") return Fail(ErrorCode::kBadData, "it is damaged");
    FORESIGHT_CHECK(database.Integer("SELECT count(*) FROM mission"));
    FORESIGHT_CHECK(database.Integer("SELECT count(*) FROM entry"));
    return Index(std::move(database));
  }

  static Result<Index> Make(const fs::path& file) {
    FORESIGHT_TRY(SqliteDatabase database,
                  SqliteDatabase::Open(file, SqliteDatabase::Mode::kCreate));
    for (const char* table : kTables) FORESIGHT_CHECK(database.Run(table));
    FORESIGHT_CHECK(database.Run(fmt::format("PRAGMA user_version = {}", kIndexVersion).c_str()));
    return Index(std::move(database));
  }

  Result<std::map<std::string, std::string>> Stamps() const {
    FORESIGHT_TRY(SqliteStatement select, database_.Prepare("SELECT path, stamp FROM mission"));
    std::map<std::string, std::string> stamps;
    for (;;) {
      FORESIGHT_TRY(const bool more, select.Step());
      if (!more) return stamps;
      stamps[select.Text(0)] = select.Text(1);
    }
  }

  Status Forget(const std::string& path) {
    for (const char* sql :
         {"DELETE FROM mission WHERE path = ?", "DELETE FROM entry WHERE path = ?"}) {
      FORESIGHT_TRY(SqliteStatement remove, database_.Prepare(sql));
      FORESIGHT_CHECK(remove.BindText(path).Run());
    }
    return {};
  }

  Status Take(const fs::path& mission, const std::string& stamp) {
    const Status taken = TakeContents(mission);
    if (!taken) FORESIGHT_CHECK(Forget(mission.string()));  // nothing of half a mission
    FORESIGHT_TRY(SqliteStatement insert,
                  database_.Prepare("INSERT INTO mission(path, stamp, problem) VALUES(?, ?, ?)"));
    return insert.BindText(mission.string())
        .BindText(stamp)
        .BindText(taken ? std::string() : taken.error().message)
        .Run();
  }

  Status TakeContents(const fs::path& path) {
    FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(path));
    FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission->ListScans());
    FORESIGHT_TRY(const std::vector<DetectionRecord> objects, mission->ListDetections());
    FORESIGHT_TRY(const std::vector<NoteRecord> notes, mission->ListNotes());
    FORESIGHT_TRY(const std::vector<EventRecord> events, mission->ListEvents());
    for (const ScanSummary& scan : scans)
      FORESIGHT_CHECK(
          Add(path, "scan", scan.uuid, scan.id, scan.begin_utc_ns, "", "",
              fmt::format("scan {}, {}, {}, {} lines, {} images, {} objects{}{}", scan.id,
                          scan.source, ToString(scan.state), scan.lines, scan.images, scan.objects,
                          scan.reason.empty() ? "" : ": ", scan.reason)));
    for (const DetectionRecord& object : objects)
      if (!object.deleted)
        FORESIGHT_CHECK(
            Add(path, "object", object.scan_uuid, object.scan_id, object.utc_ns, object.kind,
                ToString(object.decision),
                fmt::format("{} {}, {}, {}, by {}", object.kind, object.name,
                            VerdictOf(object.json), ToString(object.decision), object.author)));
    for (const NoteRecord& note : notes)
      if (!note.deleted)
        FORESIGHT_CHECK(Add(path, "note", note.scan_uuid, note.scan_id, note.utc_ns, note.kind, "",
                            SearchText(note)));
    for (const EventRecord& event : events)
      FORESIGHT_CHECK(Add(path, "log", "", 0, event.utc_ns, "", "",
                          fmt::format("{} {}: {}", event.source, event.severity, event.text)));
    return {};
  }

  Status Add(const fs::path& path, const char* what, const std::string& scan_uuid,
             std::int64_t scan, std::int64_t utc_ns, const std::string& kind,
             const std::string& decision, const std::string& text) {
    FORESIGHT_TRY(SqliteStatement insert,
                  database_.Prepare("INSERT INTO entry(path, what, scan_uuid, scan, utc_ns, kind, "
                                    "decision, text) VALUES(?, ?, ?, ?, ?, ?, ?, ?)"));
    return insert.BindText(path.string())
        .BindText(what)
        .BindText(scan_uuid)
        .Bind(scan)
        .Bind(utc_ns)
        .BindText(kind)
        .BindText(decision)
        .BindText(text)
        .Run();
  }

  Status Problems(MissionHits& out) const {
    FORESIGHT_TRY(SqliteStatement select,
                  database_.Prepare("SELECT problem FROM mission WHERE problem <> '' ORDER BY "
                                    "path"));
    for (;;) {
      FORESIGHT_TRY(const bool more, select.Step());
      if (!more) return {};
      out.unreadable.push_back(select.Text(0));
    }
  }

  SqliteDatabase database_;
};

/// In the folder itself, else in `index_folder` under a name that is the folder's alone.
Result<fs::path> IndexFileOf(const fs::path& folder, const fs::path& index_folder) {
  const fs::path inside = folder / ".foresight-index";
  std::error_code error;
  const bool there = fs::exists(inside, error);
  if (::access((there ? inside : folder).c_str(), W_OK) == 0) return inside;
  fs::create_directories(index_folder, error);
  const fs::path absolute = fs::absolute(folder, error);
  const fs::path elsewhere = index_folder / ("index-" + Sha256Hex(absolute.string()).substr(0, 16));
  if (!index_folder.empty() && ::access(index_folder.c_str(), W_OK) == 0) return elsewhere;
  return Fail(ErrorCode::kIo, "{}: no index can be written, neither there nor in '{}'",
              folder.string(), index_folder.string());
}

}  // namespace

fs::path IndexCacheFolder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0')
    return fs::path(cache) / "foresight";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".cache" / "foresight";
  return {};
}

Result<MissionHits> SearchMissions(const fs::path& folder, const MissionQuery& query,
                                   const fs::path& index_folder, const RunContext& context) {
  FORESIGHT_TRY(const std::vector<fs::path> missions, MissionsBelow(folder));
  FORESIGHT_TRY(const fs::path file, IndexFileOf(folder, index_folder));
  FORESIGHT_TRY(Index index, Index::Open(file));
  MissionHits out;
  out.missions = static_cast<std::int64_t>(missions.size());
  FORESIGHT_CHECK(index.Refresh(missions, out, context.Part(0.0, 0.95)));
  FORESIGHT_CHECK(index.Search(query, out));
  return out;
}

}  // namespace foresight
