#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/mission/mission_file.h"
#include "ui/viewmodels/session_model.h"

namespace foresight {

/// An object as it stands in the mission and in the file with its review, and how it came to that.
struct ReviewedObject {
  FoundObject object;
  std::int64_t found_utc_ns = 0;
  std::vector<DetectionEvent> actions;  ///< oldest first
  bool deleted = false;                 ///< in the end
};

/// A scan out of a mission with all that was found in it, then and in earlier reviews.
struct ReviewedScan {
  std::shared_ptr<const Scan> scan;
  std::vector<ReviewedObject> objects;

  /// Those that are there in the end.
  std::vector<FoundObject> Objects() const;
};

/// @param folder where the review lies if it cannot lie beside its mission
/// @param known the scan itself, where it is loaded already
Result<ReviewedScan> LoadReviewedScan(const MissionFile& mission,
                                      const std::filesystem::path& folder,
                                      const ScanSummary& summary,
                                      std::shared_ptr<const Scan> known = nullptr);

/// Where reviews lie that cannot lie beside their mission.
std::filesystem::path ReviewFolder();

}  // namespace foresight
