#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "tests/fuzz/require.h"

namespace foresight {

/// What holds for the points of any cloud file: they are from its bytes, or the error says why not.
inline void RequirePointsOrReason(const Result<std::vector<Eigen::Vector3d>>& points,
                                  std::size_t file_bytes) {
  if (points) {
    // The shortest point is three digits and three separators, or three bytes of a binary file.
    Require(points->size() <= file_bytes, "every point comes from the file");
    return;
  }
  Require(points.error().code == ErrorCode::kBadData, "damaged bytes are bad data");
  Require(points.error().message.starts_with("fuzz"), "an error names the file");
}

}  // namespace foresight
