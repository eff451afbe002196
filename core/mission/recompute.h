#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/run_context.h"
#include "core/mission/mission_file.h"
#include "core/mission/scan_workbench.h"

namespace foresight {

/// What came out when a record was made again.
struct Recomputed {
  enum class Outcome {
    kSame,        ///< to the last bit
    kDifferent,   ///< `differences` says where
    kNotPossible  ///< `differences` says why: no provenance, no such scan, the fit failed, ...
  };
  Outcome outcome = Outcome::kSame;
  /// "pose.position_m.0: was 1.2, is 1.3"; at most kMostDifferences.
  std::vector<std::string> differences;
  static constexpr std::size_t kMostDifferences = 20;
};
/// "same", "different", "not possible".
const char* ToString(Recomputed::Outcome outcome);

/// Makes what a mission keeps again, from the scan and the record's own provenance, by the
/// functions that every program calls. Scan and depth map of the last record are kept: records of
/// one scan that follow each other cost its loading once. `seconds` are not compared.
class Recomputer {
 public:
  /// @param scans the mission that holds the scans; it must outlive this
  /// @param rigs where rigs are that a record was made with in place of its scan's own: the file of
  /// the records; nullptr = `scans`. It must outlive this.
  explicit Recomputer(const MissionFile& scans, const MissionFile* rigs = nullptr)
      : scans_(scans), rigs_(rigs != nullptr ? *rigs : scans) {}

  /// Fails with kCancelled, and where the scans cannot be read.
  Result<Recomputed> RemakeDetection(const DetectionRecord& record, const RunContext& context);
  Result<Recomputed> RemakeDepth(const DepthRecord& record, const RunContext& context);

 private:
  /// With the rig of that id, where it is found. Fails with kInvalidInput where the mission does
  /// not hold the scan.
  Status OpenScan(const std::string& uuid, const std::string& rig_id, const RunContext& context);

  const MissionFile& scans_;
  const MissionFile& rigs_;
  ScanWorkbench bench_;
};

}  // namespace foresight
