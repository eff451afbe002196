#include "core/depth/nonlocal.h"

#include <cmath>

#include "core/base/parallel.h"
#include "core/depth/lidar_coverage.h"
#include "core/depth/pixel_graph.h"
#include "core/depth/sample_fill.h"

namespace foresight {
namespace {

/// Sums are made a block at a time, so that they do not depend on the number of threads.
constexpr std::size_t kBlockPixels = 16384;
/// Of the first residual: nothing is left to improve in single precision.
constexpr double kConverged = 1e-7;

/// The normal equations (S + lambda L) d = S R and conjugate gradients on them, preconditioned by
/// the diagonal. S counts the samples of a pixel, L is the graph's Laplacian.
class NonlocalSolver {
 public:
  NonlocalSolver(const PixelGraph& graph, const SampleImage& samples, const DepthImage& start,
                 double smoothness, const RunContext& context)
      : graph_(graph),
        count_(samples.count.values()),
        smoothness_(static_cast<float>(smoothness)),
        context_(context),
        nearest_m_(samples.nearest_m),
        depth_(start),
        residual_(count_.size()),
        diagonal_(count_.size()),
        direction_(count_.size()),
        image_of_direction_(count_.size()) {
    // Depths over the nearest one: small numbers keep their digits.
    for (float& d : depth_.values()) d -= nearest_m_;
    rho_ = SumOverPixels([&](std::size_t p) {
      const float target = samples.mean_m.values()[p] - nearest_m_;
      diagonal_[p] = count_[p];
      for (const auto& edge : graph_.EdgesOf(p)) diagonal_[p] += smoothness_ * edge.weight;
      residual_[p] = count_[p] * target - Multiply(depth_.values(), p);
      direction_[p] = residual_[p] / diagonal_[p];
      return static_cast<double>(residual_[p]) * direction_[p];
    });
    rho_at_start_ = rho_;
  }

  bool Converged() const { return rho_ <= kConverged * kConverged * rho_at_start_; }

  void Step() {
    const double curvature = SumOverPixels([&](std::size_t p) {
      image_of_direction_[p] = Multiply(direction_, p);
      return static_cast<double>(direction_[p]) * image_of_direction_[p];
    });
    if (!(curvature > 0.0)) return;
    const auto length = static_cast<float>(rho_ / curvature);
    const double rho = SumOverPixels([&](std::size_t p) {
      depth_.values()[p] += length * direction_[p];
      residual_[p] -= length * image_of_direction_[p];
      return static_cast<double>(residual_[p]) * residual_[p] / diagonal_[p];
    });
    const auto kept = static_cast<float>(rho / rho_);
    rho_ = rho;
    SumOverPixels([&](std::size_t p) {
      direction_[p] = residual_[p] / diagonal_[p] + kept * direction_[p];
      return 0.0;
    });
  }

  DepthImage Depth() const {
    DepthImage depth_m = depth_;
    for (float& d : depth_m.values()) d += nearest_m_;
    return depth_m;
  }

 private:
  /// A row of (S + lambda L) x.
  float Multiply(std::span<const float> x, std::size_t p) const {
    float differences = 0.0f;
    for (const auto& edge : graph_.EdgesOf(p))
      differences += edge.weight * (x[p] - x[static_cast<std::size_t>(edge.to)]);
    return count_[p] * x[p] + smoothness_ * differences;
  }

  template <class Body>
  double SumOverPixels(const Body& body) {
    const std::size_t blocks = (count_.size() + kBlockPixels - 1) / kBlockPixels;
    block_sums_.assign(blocks, 0.0);
    ParallelFor(static_cast<int>(blocks), context_, [&](int block) {
      const auto b = static_cast<std::size_t>(block);
      const std::size_t end = std::min((b + 1) * kBlockPixels, count_.size());
      double sum = 0.0;
      for (std::size_t p = b * kBlockPixels; p < end; ++p) sum += body(p);
      block_sums_[b] = sum;
    });
    double total = 0.0;
    for (const double sum : block_sums_) total += sum;
    return total;
  }

  const PixelGraph& graph_;
  std::span<const float> count_;
  float smoothness_;
  const RunContext& context_;
  float nearest_m_;
  DepthImage depth_;
  std::vector<float> residual_, diagonal_, direction_, image_of_direction_;
  std::vector<double> block_sums_;
  double rho_ = 0.0;  ///< residual' * residual / diagonal
  double rho_at_start_ = 0.0;
};

}  // namespace

Status NonlocalOptions::Check() const {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  const auto within = [](int value, int low, int high, const char* name) -> Status {
    if (value >= low && value <= high) return {};
    return Fail(ErrorCode::kInvalidOptions, "nonlocal: {} {} is not in [{}, {}]", name, value, low,
                high);
  };
  if (!positive(smoothness))
    return Fail(ErrorCode::kInvalidOptions, "nonlocal: smoothness {} is not positive", smoothness);
  if (!positive(sigma_color))
    return Fail(ErrorCode::kInvalidOptions, "nonlocal: sigma_color {} is not positive",
                sigma_color);
  if (!positive(nonlocal_fraction))
    return Fail(ErrorCode::kInvalidOptions, "nonlocal: nonlocal_fraction {} is not positive",
                nonlocal_fraction);
  FORESIGHT_CHECK(within(window_radius_px, 2, 20, "window_radius_px"));
  FORESIGHT_CHECK(within(patch_radius_px, 0, 10, "patch_radius_px"));
  FORESIGHT_CHECK(within(similar_pixels, 1, 16, "similar_pixels"));
  return within(iterations, 1, 100000, "iterations");
}

Result<DenseDepth> UpsampleNonlocal(const AlignedSamples& samples, const ColorImage& guide,
                                    const NonlocalOptions& options, const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_TRY(const SampleImage image, AverageByPixel(samples, guide));
  const auto cancelled = [] {
    return Fail(ErrorCode::kCancelled, "nonlocal upsampling was cancelled");
  };
  const auto graph = PixelGraph::Of(guide, options, context.Part(0.0, 0.3));
  if (!graph) return cancelled();
  const RunContext solving = context.Part(0.3, 1.0);
  const double smoothness = options.smoothness / (8.0 + options.similar_pixels);
  NonlocalSolver solver(*graph, image, FillSmoothly(image), smoothness, solving);
  for (int i = 0; i < options.iterations && !solver.Converged(); ++i) {
    solver.Step();
    if (context.Cancelled()) return cancelled();
    solving.Report((i + 1.0) / options.iterations, "upsampling");
  }
  if (context.Cancelled()) return cancelled();
  DenseDepth dense;
  dense.depth_m = solver.Depth();
  dense.confidence = LidarCoverage(samples);
  dense.has_confidence = false;
  dense.max_confidence = 1.0f;
  return dense;
}

}  // namespace foresight
