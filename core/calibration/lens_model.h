#pragma once

#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/sensor/camera_model.h"

namespace foresight {

/// Which lens a calibration may choose, from few parameters to many.
enum class LensModel { kFisheyeK, kExtendedUnified, kKannalaBrandt, kRadialTangential };

/// "k", "eucm", "kb4", "radtan": as people type them.
std::string_view ToString(LensModel model);
/// Fails with kInvalidOptions, naming what is known.
Result<LensModel> LensModelFromText(std::string_view text);
/// The same for "k,kb4"; each model once. Fails with kInvalidOptions.
Result<std::vector<LensModel>> LensModelsFromText(std::string_view text);

/// A lens of the model without distortion: equidistant, or a pinhole where the model knows no
/// other.
Lens StartLens(LensModel model);
LensModel LensModelOf(const Lens& lens);

}  // namespace foresight
