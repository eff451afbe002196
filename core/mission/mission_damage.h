#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"

namespace foresight {

/// A record of a mission file that cannot be read, or reads as something that was never written.
struct DamagedRecord {
  std::string table;  ///< of docs/formats.md; "file" where it is about the file itself
  std::string where;  ///< "scan 1, line 9"; empty = about the whole file
  std::string what;   ///< what is wrong with it, in words

  bool operator==(const DamagedRecord&) const = default;
};

/// "scan 1, line 9: its checksum is wrong"
std::string InWords(const DamagedRecord& record);

struct DamageReport {
  std::vector<DamagedRecord> records;     ///< the first ones, in the order of the tables
  std::size_t count = 0;                  ///< of all, those that are not in `records` too
  std::vector<std::int64_t> sound_scans;  ///< ids of scans without a damaged record

  void Add(DamagedRecord record, std::size_t at_most);
};

/// Reads everything that a mission file holds and names what is damaged, at most `at_most` records
/// of it. Of a file that MissionFile does not open, because its table of contents or one of its
/// trees is damaged, the pages are read one by one: what stands on a page that is lost is told by
/// the counts that the scans keep. An empty report: everything can be read. Fails with kIo, with
/// kCancelled, and with kBadData where nothing in the file is a mission's.
Result<DamageReport> FindDamage(const std::filesystem::path& path, std::size_t at_most,
                                const RunContext& context);

}  // namespace foresight
