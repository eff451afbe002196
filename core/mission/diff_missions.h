#pragma once

#include <string>
#include <vector>

#include "core/base/run_context.h"
#include "core/mission/mission_file.h"

namespace foresight {

/// One thing in which two missions differ.
struct MissionDifference {
  enum class Kind { kOnlyInFirst, kOnlyInSecond, kDifferent };
  Kind kind = Kind::kDifferent;
  std::string what;  ///< "scan", "detection", "depth map", "note", "log"
  std::string uuid;  ///< empty for the log
  std::string text;  ///< one sentence or a value: "pose.position_m.0: was 1.2, is 1.3"
};
/// "only in the first", "only in the second", "different".
const char* ToString(MissionDifference::Kind kind);

/// In what `second` differs from `first`: scans, detections, depth maps and notes with the same
/// uuid are compared value by value, whatever their ids; the time a fit took is not. Empty = they
/// hold the same. Fails with kIo, kBadData (a damaged row) and kCancelled.
Result<std::vector<MissionDifference>> DiffMissions(const MissionFile& first,
                                                    const MissionFile& second,
                                                    const RunContext& context);

}  // namespace foresight
