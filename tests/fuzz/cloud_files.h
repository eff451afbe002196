#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/io/cloud_table.h"
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

/// The table of the file has the same points, and a value of each column for each of them.
inline void RequireSameTable(const Result<std::vector<Eigen::Vector3d>>& points,
                             const Result<CloudTable>& table) {
  Require(points.has_value() == table.has_value(), "both readers read it, or none");
  if (!points) return;
  const auto whole = [&](std::size_t size) { return size == 0 || size == points->size(); };
  Require(table->points.size() == points->size() && whole(table->intensity.size()) &&
              whole(table->line.size()) && whole(table->beam.size()) && whole(table->ring.size()) &&
              whole(table->time_s.size()) && whole(table->color.size()),
          "a value for each point");
}

}  // namespace foresight
