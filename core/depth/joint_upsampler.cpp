#include "core/depth/joint_upsampler.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "core/base/parallel.h"
#include "core/depth/row_filter.h"
#include "core/sensor/scan_plan.h"

namespace foresight {
namespace {

/// Rows that a worker filters at a time: enough to share the work of finding their samples, few
/// enough to keep all workers busy to the end.
constexpr int kFilteredRows = 8;

/// Mean change of each pass over the pixels that have a depth, from the blocks' sums.
std::vector<double> MeanChanges(std::span<const double> sums,
                                std::span<const std::int64_t> block_pixels, std::size_t passes) {
  const auto pixels = static_cast<double>(
      std::accumulate(block_pixels.begin(), block_pixels.end(), std::int64_t{0}));
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

Status JointUpsampler::Update(const AlignedSamples& samples, const RunContext& context) {
  std::optional<MappedSamples> before = std::exchange(cached_, std::nullopt);
  FORESIGHT_CHECK(options_.Check());
  FORESIGHT_CHECK(CheckUpsamplingInput(samples, guide_));
  const double density = LocalDensity(samples);
  const double sigma_px =
      options_.sigma_spatial_px > 0.0 ? options_.sigma_spatial_px : SpatialSigmaForDensity(density);
  if (before && sigma_px != dense_.sigma_spatial_px) before.reset();
  if (!before) Reset(sigma_px);

  MappedSamples now(samples);
  const SpatialKernel spatial(sigma_px, options_.radius_in_sigmas * sigma_px);
  const SampleChange change = before ? CompareSamples(*before, now) : EverythingNew(now);
  const std::vector<int> blocks = change.rows.GrownBy(spatial.radius()).Blocks(kFilteredRows);
  FORESIGHT_CHECK(FilterRowsOf(now.map, spatial, blocks, context));
  filtered_rows_ = std::min(guide_.height(), static_cast<int>(blocks.size()) * kFilteredRows);

  dense_.nominal_confidence = static_cast<float>(NominalConfidence(options_, spatial, density));
  dense_.max_confidence = 0.0f;
  for (const float c : dense_.confidence.values())
    dense_.max_confidence = std::max(dense_.max_confidence, c);
  dense_.mean_change_m =
      MeanChanges(change_sums_, pixels_, static_cast<std::size_t>(options_.iterations));
  cached_ = std::move(now);
  return {};
}

void JointUpsampler::Reset(double sigma_px) {
  const auto passes = static_cast<std::size_t>(options_.iterations);
  const auto blocks =
      static_cast<std::size_t>((guide_.height() + kFilteredRows - 1) / kFilteredRows);
  if (gray_.empty()) gray_ = ToGray(guide_);
  dense_ = DenseDepth();
  dense_.sigma_spatial_px = sigma_px;
  dense_.depth_m = DepthImage(guide_.width(), guide_.height());
  dense_.confidence = dense_.depth_m;
  if (options_.keep_iterations) dense_.iterations.assign(passes + 1, dense_.depth_m);
  change_sums_.assign(blocks * passes, 0.0);
  pixels_.assign(blocks, 0);
}

Status JointUpsampler::FilterRowsOf(const SparseDepthMap& map, const SpatialKernel& spatial,
                                    const std::vector<int>& blocks, const RunContext& context) {
  const std::vector<float> sample_intensity = map.ValuesAt(gray_);
  const JointFilter filter{map,
                           spatial,
                           gray_,
                           sample_intensity,
                           static_cast<float>(options_.sigma_intensity),
                           static_cast<float>(options_.sigma_depth_m),
                           options_.iterations,
                           options_.weights == UpsampleOptions::Weights::kLiteral,
                           LiteralConfidence(options_),
                           options_.confidence_passes};
  const auto passes = static_cast<std::size_t>(options_.iterations);
  const int count = static_cast<int>(blocks.size());
  std::atomic<int> blocks_done{0};
  const bool finished = ParallelFor(count, context, [&](int i) {
    const int top = blocks[static_cast<std::size_t>(i)] * kFilteredRows;
    const auto b = static_cast<std::size_t>(top / kFilteredRows);
    FilterChange change{std::span(change_sums_).subspan(b * passes, passes)};
    std::fill(change.sum_m.begin(), change.sum_m.end(), 0.0);
    FilterRows(filter, top, std::min(top + kFilteredRows, guide_.height()),
               {dense_.depth_m, dense_.confidence, dense_.iterations}, change);
    pixels_[b] = change.pixels;
    context.Report(static_cast<double>(++blocks_done) / count, "upsampling");
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "upsampling was cancelled");
  return {};
}

}  // namespace foresight
