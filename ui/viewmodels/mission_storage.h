#pragma once

#include <memory>
#include <vector>

#include "core/mission/mission_file.h"
#include "ui/viewmodels/session_model.h"

namespace foresight {

/// Appends the scans that the file does not hold yet, and the objects found in them. An object
/// whose scan is not in the file is an error (kInvalidInput).
Status AppendToMission(MissionFile* file, const std::vector<std::shared_ptr<const Scan>>& scans,
                       const std::vector<FoundObject>& objects, const RunContext& context);

/// The objects that the file holds for a scan.
Result<std::vector<FoundObject>> ObjectsInMission(const MissionFile& file, std::int64_t scan_id,
                                                  const Scan& scan);

}  // namespace foresight
