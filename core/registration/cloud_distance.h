#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"

namespace foresight {

/// How far the points of one cloud are from another cloud.
struct CloudDistance {
  std::size_t points = 0;  ///< of the first cloud, that are finite
  double median_m = std::numeric_limits<double>::quiet_NaN();
  double p95_m = std::numeric_limits<double>::quiet_NaN();  ///< 95 % of the points are nearer
  double max_m = std::numeric_limits<double>::quiet_NaN();
};

/// The distance of each finite point of `from` to the nearest finite point of `to`, in the order of
/// `from`: exact, and the same with any number of threads. One frame, metres. Fails with
/// kTooFewPoints where either cloud has no finite point, kCancelled. O(points log points).
Result<std::vector<float>> NearestDistances(std::span<const Eigen::Vector3f> from,
                                            std::span<const Eigen::Vector3f> to,
                                            const RunContext& context);

/// Distances in three numbers. @pre at least one
CloudDistance SummaryOf(std::vector<float> distances_m);

/// Both at once. Not symmetric: what is only in `to` is not seen from `from`.
Result<CloudDistance> DistanceOfClouds(std::span<const Eigen::Vector3f> from,
                                       std::span<const Eigen::Vector3f> to,
                                       const RunContext& context);

}  // namespace foresight
