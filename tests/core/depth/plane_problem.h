#pragma once

#include "core/base/random.h"
#include "tests/support/plane_reference.h"
#include "tests/support/sample_grids.h"

namespace foresight {

/// Whether the planes of a problem are linear over its pixels or over the rays of a curved lens.
enum class Rays { kPixels, kCurved };

/// A lens like no other: two pixels of one size, and none of the axes straight.
inline Eigen::Vector2d CurvedRay(int width, int height, double u, double v) {
  const double x = (u - 0.4 * width) / 100.0;
  const double y = (v - 0.6 * height) / 100.0;
  return {x * (1.0 + 0.3 * y * y) + 0.05 * y, y * (1.0 + 0.5 * x * x)};
}
inline constexpr float kCurvedUnit = 0.01f;

inline std::shared_ptr<const RayField> CurvedRays(int width, int height) {
  auto rays = std::make_shared<RayField>();
  rays->x = FloatImage(width, height);
  rays->y = FloatImage(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector2d ray = CurvedRay(width, height, u, v);
      rays->x(u, v) = static_cast<float>(ray.x());
      rays->y(u, v) = static_cast<float>(ray.y());
    }
  return rays;
}

/// The samples' planes: at their exact places, near their depths, with slopes near `slope_x` and
/// `slope_y` (1/m and pixel) and any support.
inline void StartAnywhere(PlaneProblem& problem, Rays rays, double slope_x, double slope_y) {
  Random random(11);
  const int width = problem.samples.width;
  const int height = problem.samples.height;
  if (rays == Rays::kCurved) problem.samples.rays = CurvedRays(width, height);
  for (const AlignedSample& s : problem.samples.samples) {
    const Eigen::Vector2d place =
        rays == Rays::kCurved ? CurvedRay(width, height, s.u, s.v) : Eigen::Vector2d(s.u, s.v);
    SamplePlane plane;
    plane.x = static_cast<float>(place.x());
    plane.y = static_cast<float>(place.y());
    plane.unit = rays == Rays::kCurved ? kCurvedUnit : 1.0f;
    plane.inverse_depth = static_cast<float>((1.0 + 0.005 * random.Normal()) / s.depth_m);
    plane.slope_x = static_cast<float>((slope_x + 0.001 * random.Normal()) / plane.unit);
    plane.slope_y = static_cast<float>((slope_y + 0.001 * random.Normal()) / plane.unit);
    plane.support = static_cast<float>(random.Uniform(0.1, 1.0));
    problem.planes.push_back(plane);
  }
}

/// Two slanted surfaces with an edge in depth and colour, noise in both, samples off the centres.
inline PlaneProblem RandomProblem(int width, int height, Rays rays = Rays::kPixels) {
  Random random(7);
  PlaneProblem problem;
  problem.samples = SamplesOnLattice(width, height, 3, 4, [&](int u, int v) {
    const double inverse = (u < width / 2 ? 1.0 : 0.8) + 0.002 * u - 0.003 * v;
    return 1.5 / inverse + 0.005 * random.Normal();
  });
  for (AlignedSample& s : problem.samples.samples) {
    s.u = std::clamp(s.u + static_cast<float>(random.Normal()), -0.49f,
                     static_cast<float>(width) - 0.51f);
    s.v = std::clamp(s.v + static_cast<float>(random.Normal()), -0.49f,
                     static_cast<float>(height) - 0.51f);
  }
  for (FloatImage& channel : problem.colour) {
    channel = FloatImage(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        channel(x, y) = static_cast<float>((x < width / 2 ? 20.0 : 60.0) + 8.0 * random.Normal());
  }
  StartAnywhere(problem, rays, 0.002 / 1.5, -0.003 / 1.5);
  return problem;
}

/// A problem as the kernels want it, with all that a PlaneFilter refers to.
class FilterOf {
 public:
  FilterOf(const PlaneProblem& problem, const PlaneReferenceOptions& options)
      : sparse_(problem.samples), spatial_(options.sigma_spatial_px, options.radius_px) {
    for (const std::int32_t source : sparse_.sources())
      planes_.push_back(problem.planes[static_cast<std::size_t>(source)]);
    filter_.planes = planes_;
    for (std::size_t i = 0; i < 3; ++i) {
      sample_colour_[i] = sparse_.ValuesAt(problem.colour[i]);
      filter_.colour[i] = &problem.colour[i];
      filter_.sample_colour[i] = sample_colour_[i];
    }
    if (const RayField* rays = problem.samples.rays.get()) filter_.ray = {&rays->x, &rays->y};
    filter_.sigma_spatial_px = static_cast<float>(options.sigma_spatial_px);
    filter_.sigma_colour = static_cast<float>(options.sigma_colour);
    filter_.sigma_depth_m = static_cast<float>(options.sigma_depth_m);
    filter_.ridge = static_cast<float>(options.ridge);
    filter_.iterations = options.iterations;
  }
  FilterOf(const FilterOf&) = delete;
  FilterOf& operator=(const FilterOf&) = delete;

  const PlaneFilter& filter() const { return filter_; }
  const SparseDepthMap& sparse() const { return sparse_; }
  const std::vector<SamplePlane>& planes() const { return planes_; }

 private:
  SparseDepthMap sparse_;
  SpatialKernel spatial_;
  std::vector<SamplePlane> planes_;
  std::array<std::vector<float>, 3> sample_colour_;
  PlaneFilter filter_{sparse_, {}, spatial_, {}, {}};
};

}  // namespace foresight
