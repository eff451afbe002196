#include "core/objects/cylinder_model.h"

namespace foresight {

Status CylinderModel::Check() const {
  const auto usable = [](double size_m) { return size_m > 0.0 && size_m <= kLargest_m; };
  if (!usable(radius_m) || !usable(length_m))
    return Fail(ErrorCode::kInvalidOptions,
                "cylinder: radius_m {} or length_m {} is not within 0 to {}", radius_m, length_m,
                kLargest_m);
  return {};
}

}  // namespace foresight
