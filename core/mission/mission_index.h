#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"

namespace foresight {

/// What is looked for in the missions of a folder; what is not set does not count.
struct MissionQuery {
  /// All of them must stand in the entry's text, in any case of ASCII letters.
  std::vector<std::string> words = {};
  std::optional<std::string> what = {};      ///< "scan", "object", "note", "log"
  std::optional<std::string> kind = {};      ///< "valve", ...; "note", "measurement"
  std::optional<std::string> decision = {};  ///< of an object: "accepted", "rejected", "open"
  std::optional<std::int64_t> since_utc_ns = {};
  std::optional<std::int64_t> until_utc_ns = {};
  std::size_t at_most = 1000;
};

/// A scan, an object, a note or a line of the log that was found.
struct MissionHit {
  std::filesystem::path mission;
  std::string what;       ///< "scan", "object", "note", "log"
  std::string scan_uuid;  ///< empty for the log
  std::int64_t scan = 0;  ///< its number in the mission; 0 = none, or in another file (a review)
  std::int64_t utc_ns = 0;
  std::string text;  ///< what was searched: source and state, kind and verdict and name, ...

  bool operator==(const MissionHit&) const = default;
};

struct MissionHits {
  std::vector<MissionHit> hits;         ///< the newest first
  std::int64_t missions = 0;            ///< in the folder and below it
  std::int64_t read_again = 0;          ///< of them, new or changed since the index was made
  std::vector<std::string> unreadable;  ///< one line a file that is damaged or of a newer format
};

/// Finds scans, objects, notes, measurements and lines of the log in all missions (`*.foresight`)
/// of a folder and below it. What stands in them is kept in an index, `.foresight-index` in the
/// folder, or in `index_folder` where the folder cannot be written; missions that are new or
/// changed are read first, and an index that is lost, damaged or of another version is made again.
/// Fails with kIo where the folder cannot be read, and with kCancelled.
Result<MissionHits> SearchMissions(const std::filesystem::path& folder, const MissionQuery& query,
                                   const std::filesystem::path& index_folder,
                                   const RunContext& context);

/// Where the index of a folder lies that cannot be written: the user's cache; empty = unknown.
std::filesystem::path IndexCacheFolder();

}  // namespace foresight
