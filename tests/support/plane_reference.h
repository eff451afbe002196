#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <limits>

#include "core/depth/aligned_samples.h"

namespace foresight {

struct PlaneFit {
  double depth_m = std::numeric_limits<double>::quiet_NaN();
  double sum_gkh = 0.0;
  double sum_gk = 0.0;
  double sum_gh = 0.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
};

struct PlaneReferenceOptions {
  double sigma_spatial_px = 20.0;
  double radius_px = 20.0;
  double sigma_colour = 25.0;
  double sigma_depth_m = 0.030;
  double ridge = 0.02;
  int iterations = 5;
};

/// The first-order filter of core/depth/row_filter.h at one pixel, written down as plainly as
/// possible, in double precision.
inline PlaneFit FitPlaneByTheBook(const AlignedSamples& samples,
                                  const std::array<FloatImage, 3>& colour,
                                  const PlaneReferenceOptions& options, int x, int y) {
  struct Neighbour {
    double dx, dy, depth_m, g, k;
  };
  std::vector<Neighbour> neighbours;
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    if (samples.reasons[i] != RejectReason::kKept) continue;
    const int qx = static_cast<int>(std::lround(samples.samples[i].u));
    const int qy = static_cast<int>(std::lround(samples.samples[i].v));
    const double distance2 = (qx - x) * (qx - x) + (qy - y) * (qy - y);
    if (distance2 > options.radius_px * options.radius_px) continue;
    double difference2 = 0.0;
    for (const FloatImage& plane : colour)
      difference2 += std::pow(static_cast<double>(plane(qx, qy)) - plane(x, y), 2.0);
    neighbours.push_back(
        {static_cast<double>(qx - x), static_cast<double>(qy - y), samples.samples[i].depth_m,
         std::exp(-distance2 / (2 * options.sigma_spatial_px * options.sigma_spatial_px)),
         std::exp(-difference2 / (2 * options.sigma_colour * options.sigma_colour))});
  }
  std::stable_sort(neighbours.begin(), neighbours.end(), [](const auto& a, const auto& b) {
    return std::pair(a.dx, a.dy) < std::pair(b.dx, b.dy);
  });

  PlaneFit fit;
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();  // a, b, c
  double best = 0.0;
  for (const Neighbour& n : neighbours) {
    fit.sum_gk += n.g * n.k;
    if (n.g * n.k > best) plane[0] = 1.0 / n.depth_m;
    best = std::max(best, n.g * n.k);
  }
  if (fit.sum_gk <= 1e-30) return PlaneFit();
  for (int t = 0; t < options.iterations; ++t) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    fit.sum_gkh = fit.sum_gh = 0.0;
    for (const Neighbour& n : neighbours) {
      const Eigen::Vector3d at(1.0, n.dx, n.dy);
      const double predicted = plane.dot(at);
      const double e = (1.0 / n.depth_m - predicted) * n.depth_m / predicted;
      const double h = predicted > 0.0
                           ? std::exp(-e * e / (2 * options.sigma_depth_m * options.sigma_depth_m))
                           : 0.0;
      const double w = n.g * n.k * h;
      normal += w * at * at.transpose();
      right += w / n.depth_m * at;
      fit.sum_gkh += w;
      fit.sum_gh += n.g * h;
    }
    if (fit.sum_gkh <= 1e-30) continue;
    const double ridge =
        options.ridge * options.sigma_spatial_px * options.sigma_spatial_px * fit.sum_gkh;
    normal(1, 1) += ridge;
    normal(2, 2) += ridge;
    plane = normal.ldlt().solve(right);
  }
  if (plane[0] <= 0.0) return PlaneFit();
  fit.depth_m = 1.0 / plane[0];
  fit.slope_x = plane[1];
  fit.slope_y = plane[2];
  return fit;
}

}  // namespace foresight
