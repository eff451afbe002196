#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/detection/fit_in_scan.h"
#include "core/mission/scan_part.h"
#include "core/sensor/scan.h"

namespace foresight {

/// Everything that is needed to make a detection or a depth map again, beside the scan itself.
struct Provenance {
  std::string program_version;
  std::string rig_id;                 ///< RigId (core/sensor/rig_id.h) of the scan's rig
  std::int64_t image_position = -1;   ///< of the image in the scan; -1 = none was used
  std::string source;                 ///< of a fit: NameOf(NamedSource); of a depth map: its method
  std::optional<DepthOptions> depth;  ///< none = no depth map was used
  std::optional<FitOptions> fit;      ///< none = of a depth map
  std::optional<Roi> roi;             ///< none = of a depth map
  std::optional<ScanPart> part;       ///< none = made from all lines of the scan
};

/// Of a fit in a scan to what `source` names, by this program. `depth` is what the fit was given,
/// with the mask that was in force; nullptr for raw returns. Fails with kInvalidInput where the
/// depth map's image is not one of the scan's.
Result<Provenance> ProvenanceOfFit(const Scan& scan, FitSource source, const DepthResult* depth,
                                   const ConfidenceMaskOptions& mask, const FitOptions& options,
                                   const Roi& roi);
/// Of a depth map of one of the scan's images. Fails as ProvenanceOfFit does.
Result<Provenance> ProvenanceOfDepth(const Scan& scan, const DepthResult& depth,
                                     const ConfidenceMaskOptions& mask);

/// One line of JSON, docs/formats.md.
std::string ProvenanceToJson(const Provenance& provenance);
/// Fails with kBadData, naming `source` and the member at fault.
Result<Provenance> ProvenanceFromJson(const std::string& json, const std::string& source);

}  // namespace foresight
