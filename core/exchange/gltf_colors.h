#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "core/io/point_cloud_file.h"

namespace foresight {

/// Adds the points' colours (COLOR_0, linear RGBA, normalised 16 bit) to a glTF 2.0 document of
/// their surface, inline: VTK 9.1's writer of glTF writes none. A point that no image painted (its
/// confidence is NaN) is of middle grey; nothing is added where no point was painted.
/// @returns false where the document is none of one vertex a point
bool AddGltfColors(std::span<const CloudPoint> points, nlohmann::json& gltf);

}  // namespace foresight
