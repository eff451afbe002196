#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/depth/aligned_samples.h"
#include "core/depth/plane_filter.h"

namespace foresight {

/// What the plane filter is given. All planes have the same unit.
struct PlaneProblem {
  AlignedSamples samples;  ///< rays: null = pixels
  std::array<FloatImage, 3> colour;
  std::vector<SamplePlane> planes;  ///< one for each of samples.samples
};

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

/// A sample as one pixel sees it.
struct PlaneNeighbour {
  int column, row;     ///< of its own pixel
  Eigen::Vector3d at;  ///< 1, then its ray's coordinates from the pixel's
  double depth_m, g, k;
  SamplePlane plane;
};

/// The samples in the disc around a pixel, from left to right, seen from a place among the rays.
inline std::vector<PlaneNeighbour> NeighboursByTheBook(const PlaneProblem& problem,
                                                       const PlaneReferenceOptions& options, int x,
                                                       int y, double ray_x, double ray_y) {
  std::vector<PlaneNeighbour> neighbours;
  for (std::size_t i = 0; i < problem.samples.samples.size(); ++i) {
    if (problem.samples.reasons[i] != RejectReason::kKept) continue;
    const AlignedSample& sample = problem.samples.samples[i];
    const int qx = static_cast<int>(std::lround(sample.u));
    const int qy = static_cast<int>(std::lround(sample.v));
    const double distance2 = (qx - x) * (qx - x) + (qy - y) * (qy - y);
    if (distance2 > options.radius_px * options.radius_px) continue;
    double difference2 = 0.0;
    for (const FloatImage& channel : problem.colour)
      difference2 += std::pow(static_cast<double>(channel(qx, qy)) - channel(x, y), 2.0);
    const SamplePlane& plane = problem.planes[i];
    neighbours.push_back(
        {qx, qy, Eigen::Vector3d(1.0, plane.x - ray_x, plane.y - ray_y), sample.depth_m,
         std::exp(-distance2 / (2 * options.sigma_spatial_px * options.sigma_spatial_px)),
         std::exp(-difference2 / (2 * options.sigma_colour * options.sigma_colour)), plane});
  }
  std::stable_sort(neighbours.begin(), neighbours.end(), [](const auto& a, const auto& b) {
    return std::pair(a.column, a.row) < std::pair(b.column, b.row);
  });
  return neighbours;
}

/// All passes from the plane (a, b, c), which becomes the fitted one; the sums are of the last.
inline PlaneFit FitByTheBook(const std::vector<PlaneNeighbour>& neighbours,
                             const PlaneReferenceOptions& options, Eigen::Vector3d& plane) {
  PlaneFit fit;
  for (const PlaneNeighbour& n : neighbours) fit.sum_gk += n.g * n.k;
  if (fit.sum_gk <= 1e-30) return PlaneFit();
  for (int t = 0; t < options.iterations; ++t) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    fit.sum_gkh = fit.sum_gh = 0.0;
    for (const PlaneNeighbour& n : neighbours) {
      const double predicted = plane.dot(n.at);
      const double e = (1.0 / n.depth_m - predicted) * n.depth_m * n.depth_m;
      const double h = std::exp(-e * e / (2 * options.sigma_depth_m * options.sigma_depth_m));
      const double w = n.g * n.k * h;
      normal += w * n.at * n.at.transpose();
      right += w / n.depth_m * n.at;
      fit.sum_gkh += w;
      fit.sum_gh += n.g * h;
    }
    if (fit.sum_gkh <= 1e-30) continue;
    const double sigma = options.sigma_spatial_px * neighbours.front().plane.unit;
    normal(1, 1) += options.ridge * sigma * sigma * fit.sum_gkh;
    normal(2, 2) += options.ridge * sigma * sigma * fit.sum_gkh;
    plane = normal.ldlt().solve(right);
  }
  if (plane[0] <= 0.0) return PlaneFit();
  fit.depth_m = 1.0 / plane[0];
  fit.slope_x = plane[1];
  fit.slope_y = plane[2];
  return fit;
}

/// The filter of core/depth/plane_filter.h at one pixel, written down as plainly as possible, in
/// double precision.
inline PlaneFit FitPlaneByTheBook(const PlaneProblem& problem, const PlaneReferenceOptions& options,
                                  int x, int y) {
  const RayField* rays = problem.samples.rays.get();
  const double ray_x = rays ? double{rays->x(x, y)} : x;
  const double ray_y = rays ? double{rays->y(x, y)} : y;
  if (std::isnan(ray_x) || std::isnan(ray_y)) return PlaneFit();
  const auto neighbours = NeighboursByTheBook(problem, options, x, y, ray_x, ray_y);
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  double best = 0.0;
  for (const PlaneNeighbour& n : neighbours) {
    const double trust = n.g * n.k * n.plane.support;
    if (!(trust > best)) continue;
    best = trust;
    const Eigen::Vector2d slope(n.plane.slope_x, n.plane.slope_y);
    const double there = 0.5 * (1.0 / n.depth_m + n.plane.inverse_depth);
    plane << there - slope.dot(n.at.tail<2>()), slope;
  }
  return FitByTheBook(neighbours, options, plane);
}

/// FitSamplePlanes for one of samples.samples: what each candidate arrives at. `depth_m` is at the
/// sample's own place, NaN where the inverse depth is not positive there.
inline std::array<PlaneFit, SlopeCandidates::kCount> FitCandidatesByTheBook(
    const PlaneProblem& problem, const PlaneReferenceOptions& options,
    const SlopeCandidates& candidates, std::size_t sample) {
  const AlignedSample& s = problem.samples.samples[sample];
  const auto neighbours = NeighboursByTheBook(problem, options, static_cast<int>(std::lround(s.u)),
                                              static_cast<int>(std::lround(s.v)),
                                              problem.planes[sample].x, problem.planes[sample].y);
  std::array<PlaneFit, SlopeCandidates::kCount> fits;
  for (std::size_t k = 0; k < fits.size(); ++k) {
    Eigen::Vector3d plane(1.0 / s.depth_m, candidates.x[k], candidates.y[k]);
    fits[k] = FitByTheBook(neighbours, options, plane);
  }
  return fits;
}

}  // namespace foresight
