#pragma once

#include <string>

#include "core/mission/mission_records.h"
#include "core/mission/provenance.h"

namespace foresight {

/// Who works at this computer, for records: the name of the user's account.
std::string OperatorName();

/// A record of something found now in a scan, by the operator of this computer. `scan_id` is left
/// for who knows the file.
DetectionRecord NewDetectionRecord(const Scan& scan, const Detection& detection,
                                   const Provenance& provenance);
/// The same of a depth map; `mask` is what its threshold makes of it. Fails as ProvenanceOfDepth.
Result<DepthRecord> NewDepthRecord(const Scan& scan, const DepthResult& depth,
                                   const MaskImage& mask, const ConfidenceMaskOptions& options);

}  // namespace foresight
