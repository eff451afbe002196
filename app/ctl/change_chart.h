#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/depth/upsample.h"

namespace foresight {

/// Fig. 6(b): the mean change of the depth in each pass as SVG; empty where the method has no
/// passes.
std::string ChangeSvg(const DenseDepth& dense);

/// Writes change.svg into an existing folder, where the method has passes.
Status WriteChangeChart(const DenseDepth& dense, const std::filesystem::path& folder);

/// The changes in millimetres, one a pass.
nlohmann::ordered_json ChangeJson(const DenseDepth& dense);

}  // namespace foresight
