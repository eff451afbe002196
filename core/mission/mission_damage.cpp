#include "core/mission/mission_damage.h"

#include "core/mission/damaged_rows.h"
#include "core/mission/mission_file.h"
#include "core/mission/mission_schema.h"

namespace foresight {
namespace {

/// The tables that a file of this format has, of which the file's own table of contents need not
/// be read.
Result<std::vector<StoredTable>> TablesOfFormat(int format) {
  FORESIGHT_TRY(SqliteDatabase empty, SqliteDatabase::OpenInMemory());
  FORESIGHT_CHECK(CreateMissionSchema(empty, format));
  return ReadStoredTables(empty);
}

Result<DamageReport> FindDamageInPages(const std::filesystem::path& path, const Error& why,
                                       std::size_t at_most, const RunContext& context) {
  FORESIGHT_TRY(const SqlitePages pages, SqlitePages::Open(path));
  FORESIGHT_TRY(const std::vector<StoredTable> tables,
                TablesOfFormat(pages.user_version() == 1 ? 1 : kMissionFormatVersion));
  DamagedRows rows(tables, at_most);
  FORESIGHT_CHECK(ReadThroughPages(pages, tables, rows, context));
  if (!rows.AnyGood()) return tl::unexpected(why);
  std::string what = why.message;
  // The path stands in front of the list already.
  if (const std::string front = path.string() + ": "; what.starts_with(front))
    what.erase(0, front.size());
  rows.Tell({"file", "", what});
  return rows.Report();
}

}  // namespace

std::string InWords(const DamagedRecord& record) {
  return record.where.empty() ? record.what : record.where + ": " + record.what;
}

void DamageReport::Add(DamagedRecord record, std::size_t at_most) {
  ++count;
  if (records.size() < at_most) records.push_back(std::move(record));
}

Result<DamageReport> FindDamage(const std::filesystem::path& path, std::size_t at_most,
                                const RunContext& context) {
  const auto mission = MissionFile::OpenReadOnly(path);
  if (mission) return (*mission)->FindDamage(at_most, context);
  if (mission.error().code != ErrorCode::kBadData) return tl::unexpected(mission.error());
  return FindDamageInPages(path, mission.error(), at_most, context);
}

}  // namespace foresight
