#include "core/depth/upsample.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/base/parallel.h"
#include "core/depth/filter_window.h"
#include "core/depth/row_filter.h"
#include "core/sensor/scan_plan.h"

namespace foresight {
namespace {

/// Rows that a worker filters at a time: enough to share the work of finding their samples, few
/// enough to keep all workers busy to the end.
constexpr int kBlockRows = 8;

/// Mean change of each pass over the pixels that have a depth, from the blocks' sums.
std::vector<double> MeanChanges(std::span<const double> sums, std::span<const FilterChange> blocks,
                                std::size_t passes) {
  double pixels = 0.0;
  for (const FilterChange& block : blocks) pixels += static_cast<double>(block.pixels);
  std::vector<double> mean(passes, 0.0);
  for (std::size_t i = 0; i < sums.size(); ++i) mean[i % passes] += sums[i];
  for (double& change : mean) change = pixels > 0.0 ? change / pixels : 0.0;
  return mean;
}

bool LiteralConfidence(const UpsampleOptions& options) {
  return options.confidence_terms.value_or(options.weights) == UpsampleOptions::Weights::kLiteral;
}

/// The sum of Eq. (9) over a disc full of samples, `density` a pixel, with H = 1. With product
/// terms that is 2 pi sigma_s^2 (1 - exp(-r^2 / (2 sigma_s^2))) density a pass, up to the disc's
/// pixels.
double NominalConfidence(const UpsampleOptions& options, const SpatialKernel& spatial,
                         double density) {
  const bool literal = LiteralConfidence(options);
  const bool unguided = options.confidence_passes == ConfidencePasses::kAll;
  const int guided =
      options.iterations + (options.confidence_passes == ConfidencePasses::kEveryDepth ? 1 : 0);
  double sum = 0.0;
  for (int dy = -spatial.radius(); dy <= spatial.radius(); ++dy)
    for (int dx = -spatial.radius(); dx <= spatial.radius(); ++dx) {
      const double g = static_cast<double>(spatial.Centre()[dy * spatial.stride() + dx]);
      if (g == 0.0) continue;
      sum += (unguided ? (literal ? std::exp(g) : g) : 0.0) +
             guided * (literal ? std::exp(g + 1.0) : g);
    }
  return density * sum;
}

}  // namespace

Status UpsampleOptions::Check() const {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (sigma_spatial_px != 0.0 && !(sigma_spatial_px >= 0.5 && sigma_spatial_px <= 200.0))
    return Fail(ErrorCode::kInvalidOptions,
                "upsampling: sigma_spatial_px {} is neither 0 (automatic) nor in [0.5, 200]",
                sigma_spatial_px);
  if (!(radius_in_sigmas >= 0.5 && radius_in_sigmas <= 4.0))
    return Fail(ErrorCode::kInvalidOptions, "upsampling: radius_in_sigmas {} is not in [0.5, 4]",
                radius_in_sigmas);
  if (!positive(sigma_intensity))
    return Fail(ErrorCode::kInvalidOptions, "upsampling: sigma_intensity {} is not positive",
                sigma_intensity);
  if (!positive(sigma_depth_m))
    return Fail(ErrorCode::kInvalidOptions, "upsampling: sigma_depth_m {} is not positive",
                sigma_depth_m);
  if (iterations < 0 || iterations > 50)
    return Fail(ErrorCode::kInvalidOptions, "upsampling: iterations {} is not in [0, 50]",
                iterations);
  if (iterations == 0 && confidence_passes == ConfidencePasses::kGuided)
    return Fail(ErrorCode::kInvalidOptions,
                "upsampling: confidence_passes of guided passes alone, but iterations is 0");
  return {};
}

Result<DenseDepth> UpsampleDepth(const AlignedSamples& samples, const ColorImage& guide,
                                 const UpsampleOptions& options, const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_CHECK(CheckUpsamplingInput(samples, guide));

  DenseDepth dense;
  const double density = LocalDensity(samples);
  dense.sigma_spatial_px =
      options.sigma_spatial_px > 0.0 ? options.sigma_spatial_px : SpatialSigmaForDensity(density);
  const GrayImage gray = ToGray(guide);
  const SparseDepthMap sparse(samples);
  const SpatialKernel spatial(dense.sigma_spatial_px,
                              options.radius_in_sigmas * dense.sigma_spatial_px);
  const std::vector<float> sample_intensity = sparse.ValuesAt(gray);
  const JointFilter filter{sparse,
                           spatial,
                           gray,
                           sample_intensity,
                           static_cast<float>(options.sigma_intensity),
                           static_cast<float>(options.sigma_depth_m),
                           options.iterations,
                           options.weights == UpsampleOptions::Weights::kLiteral,
                           LiteralConfidence(options),
                           options.confidence_passes};
  dense.nominal_confidence = static_cast<float>(NominalConfidence(options, spatial, density));

  const auto passes = static_cast<std::size_t>(options.iterations);
  dense.depth_m = DepthImage(guide.width(), guide.height());
  dense.confidence = FloatImage(guide.width(), guide.height());
  if (options.keep_iterations) dense.iterations.assign(passes + 1, dense.depth_m);
  const int block_count = (guide.height() + kBlockRows - 1) / kBlockRows;
  // One place a block: the sums do not depend on which thread came first.
  std::vector<double> change_sums(static_cast<std::size_t>(block_count) * passes, 0.0);
  std::vector<FilterChange> blocks(static_cast<std::size_t>(block_count));
  std::atomic<int> blocks_done{0};
  const bool finished = ParallelFor(block_count, context, [&](int block) {
    const auto b = static_cast<std::size_t>(block);
    blocks[b].sum_m = std::span(change_sums).subspan(b * passes, passes);
    FilterRows(filter, block * kBlockRows, std::min((block + 1) * kBlockRows, guide.height()),
               {dense.depth_m, dense.confidence, dense.iterations}, blocks[b]);
    context.Report(static_cast<double>(++blocks_done) / block_count, "upsampling");
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "upsampling was cancelled");
  for (const float c : dense.confidence.values())
    dense.max_confidence = std::max(dense.max_confidence, c);
  dense.mean_change_m = MeanChanges(change_sums, blocks, passes);
  return dense;
}

GrayImage ToGray(const ColorImage& image) {
  GrayImage gray(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Rgb8 p = image.values()[i];
    gray.values()[i] = static_cast<std::uint8_t>((299 * p.r + 587 * p.g + 114 * p.b + 500) / 1000);
  }
  return gray;
}

}  // namespace foresight
