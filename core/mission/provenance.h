#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"

namespace foresight {

/// Everything that is needed to make a detection or a depth map again, beside the scan itself.
struct Provenance {
  std::string program_version;
  std::string rig_id;                ///< RigId (core/sensor/rig_id.h) of the scan's rig
  std::int64_t image_position = -1;  ///< of the image in the scan; -1 = none was used
  std::string source;                ///< "raw", a depth method's name, or that and "-alone"
  std::string options_json;          ///< a JSON object: every option of the depth and of the fit
  std::uint64_t seed = 0;
  std::string roi_json;  ///< a JSON object: the region; empty for a depth map

  bool operator==(const Provenance&) const = default;
};

/// One line of JSON, docs/formats.md. options_json and roi_json are JSON or empty; else the text is
/// kept as a string.
std::string ProvenanceToJson(const Provenance& provenance);
/// Fails with kBadData, naming `source` and the member at fault.
Result<Provenance> ProvenanceFromJson(const std::string& json, const std::string& source);

}  // namespace foresight
