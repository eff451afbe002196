#include "core/depth/upsample.h"

#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/depth/fast_exp.h"
#include "core/depth/filter_window.h"
#include "core/sensor/scan_plan.h"

namespace foresight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
/// Below this sum of weights a pass has no opinion and the pixel keeps its depth.
constexpr float kNoSupport = 1e-30f;
constexpr std::size_t kBlock = 8;

/// What all pixels share.
struct Filter {
  const SparseDepthMap& sparse;
  const GrayImage& guide;
  SpatialKernel spatial;
  std::array<float, 256> similarity;  ///< K by difference of intensity
  float depth_scale;                  ///< -1 / (2 sigma_d^2)
  int iterations;
  UpsampleOptions::Weights weights;
};

/// The samples in Omega of one pixel, with their weights; padded to whole blocks with zeros.
struct Support {
  std::vector<float> spatial;     ///< G
  std::vector<float> similarity;  ///< K
  std::vector<float> depth_m;     ///< R

  void Gather(const Filter& filter, int x, int y) {
    spatial.clear();
    similarity.clear();
    depth_m.clear();
    const int radius = filter.spatial.radius();
    const int intensity = filter.guide(x, y);
    for (int dy = std::max(-radius, -y); dy <= std::min(radius, filter.sparse.height() - 1 - y);
         ++dy) {
      const int half = filter.spatial.HalfWidth(dy);
      const float* row = filter.spatial.Row(dy);
      const auto* end = filter.sparse.End(y + dy, x + half);
      for (const auto* entry = filter.sparse.Begin(y + dy, x - half); entry < end; ++entry) {
        spatial.push_back(row[entry->x - x]);
        similarity.push_back(
            filter.similarity[static_cast<std::size_t>(std::abs(entry->intensity - intensity))]);
        depth_m.push_back(entry->depth_m);
      }
    }
  }
  void Pad() {
    while (spatial.size() % kBlock != 0) {
      spatial.push_back(0.0f);
      similarity.push_back(0.0f);
      depth_m.push_back(0.0f);
    }
  }
};

struct Sums {
  float weight = 0.0f;      ///< N_p
  float depth = 0.0f;       ///< sum of weight * R
  float confidence = 0.0f;  ///< this pass's share of C
};

/// One pass with product weights; without `guided`, H = 1 (the JBU pass). Eight sums side by side
/// let the compiler use vector registers without reordering anything.
Sums ProductPass(const Support& support, float depth_m, float depth_scale, bool guided) {
  std::array<float, kBlock> weight{}, depth{}, confidence{};
  const std::size_t count = support.spatial.size();
  for (std::size_t i = 0; i < count; i += kBlock)
    for (std::size_t j = 0; j < kBlock; ++j) {
      const float difference = support.depth_m[i + j] - depth_m;
      const float h = guided ? ExpOfNegative(difference * difference * depth_scale) : 1.0f;
      const float gh = support.spatial[i + j] * h;
      const float w = gh * support.similarity[i + j];
      weight[j] += w;
      // Relative to the last depth: a sum of small numbers keeps its digits.
      depth[j] += w * difference;
      confidence[j] += gh;
    }
  Sums sums;
  for (std::size_t j = 0; j < kBlock; ++j) {
    sums.weight += weight[j];
    sums.depth += depth[j];
    sums.confidence += confidence[j];
  }
  return sums;
}

/// One pass with the weights exactly as Eq. (8) prints them. Each lies in [1, e^3]: nothing is ever
/// far away. Kept to show that this is not what produced the paper's tables.
Sums LiteralPass(const Support& support, float depth_m, float depth_scale, bool guided) {
  Sums sums;
  for (std::size_t i = 0; i < support.spatial.size(); ++i) {
    const float difference = support.depth_m[i] - depth_m;
    const float h = guided ? std::exp(difference * difference * depth_scale) : 0.0f;
    const float w = std::exp(support.spatial[i] + support.similarity[i] + h);
    sums.weight += w;
    sums.depth += w * difference;
    sums.confidence += std::exp(support.spatial[i] + h);
  }
  return sums;
}

/// Upsamples one pixel; depths[t] receives D^t.
float FilterPixel(const Filter& filter, Support& support, int x, int y, std::span<float> depths) {
  support.Gather(filter, x, y);
  std::fill(depths.begin(), depths.end(), kNaN);
  if (support.spatial.empty()) return 0.0f;
  const bool literal = filter.weights == UpsampleOptions::Weights::kLiteral;
  float depth_m = support.depth_m.front();
  if (!literal) support.Pad();
  float confidence = 0.0f;
  for (std::size_t t = 0; t < depths.size(); ++t) {
    const bool guided = t > 0;
    const Sums sums = literal ? LiteralPass(support, depth_m, filter.depth_scale, guided)
                              : ProductPass(support, depth_m, filter.depth_scale, guided);
    if (sums.weight > kNoSupport) depth_m += sums.depth / sums.weight;
    confidence += sums.confidence;
    depths[t] = depth_m;
  }
  return confidence;
}

std::array<float, 256> SimilarityTable(double sigma_intensity) {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double difference = static_cast<double>(i);
    table[i] = static_cast<float>(
        std::exp(-difference * difference / (2.0 * sigma_intensity * sigma_intensity)));
  }
  return table;
}

/// Mean change of each pass over the pixels that have a depth, from sums a row.
std::vector<double> MeanChanges(const std::vector<std::vector<double>>& row_sums,
                                const std::vector<int>& row_counts, int iterations) {
  std::vector<double> mean(static_cast<std::size_t>(iterations), 0.0);
  double count = 0.0;
  for (std::size_t y = 0; y < row_sums.size(); ++y) {
    count += row_counts[y];
    for (std::size_t t = 0; t < mean.size(); ++t) mean[t] += row_sums[y][t];
  }
  for (double& change : mean) change = count > 0.0 ? change / count : 0.0;
  return mean;
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
  return {};
}

Result<DenseDepth> UpsampleDepth(const AlignedSamples& samples, const ColorImage& guide,
                                 const UpsampleOptions& options, const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  if (guide.width() != samples.width || guide.height() != samples.height)
    return Fail(ErrorCode::kInvalidInput,
                "the picture has {} x {} pixels, but the samples were projected into {} x {}",
                guide.width(), guide.height(), samples.width, samples.height);
  const std::size_t kept = samples.KeptCount();
  if (kept == 0)
    return Fail(ErrorCode::kTooFewPoints, "none of {} samples is left to upsample",
                samples.samples.size());

  DenseDepth dense;
  dense.sigma_spatial_px = options.sigma_spatial_px > 0.0
                               ? options.sigma_spatial_px
                               : SpatialSigmaForDensity(LocalDensity(samples));
  const GrayImage gray = ToGray(guide);
  const SparseDepthMap sparse(samples, gray);
  const auto sigma_d = static_cast<float>(options.sigma_depth_m);
  const Filter filter{
      sparse,
      gray,
      SpatialKernel(dense.sigma_spatial_px, options.radius_in_sigmas * dense.sigma_spatial_px),
      SimilarityTable(options.sigma_intensity),
      -1.0f / (2.0f * sigma_d * sigma_d),
      options.iterations,
      options.weights};

  const std::size_t passes = static_cast<std::size_t>(options.iterations) + 1;
  dense.depth_m = DepthImage(guide.width(), guide.height(), kNaN);
  dense.confidence = FloatImage(guide.width(), guide.height(), 0.0f);
  if (options.keep_iterations) dense.iterations.assign(passes, dense.depth_m);
  std::vector<std::vector<double>> change(static_cast<std::size_t>(guide.height()),
                                          std::vector<double>(passes - 1, 0.0));
  std::vector<int> filled(static_cast<std::size_t>(guide.height()), 0);

  std::atomic<int> rows_done{0};
  const bool finished = ParallelFor(guide.height(), context, [&](int y) {
    thread_local Support support;
    std::vector<float> depths(passes);
    for (int x = 0; x < guide.width(); ++x) {
      dense.confidence(x, y) = FilterPixel(filter, support, x, y, depths);
      dense.depth_m(x, y) = depths.back();
      if (std::isnan(depths.back())) continue;
      ++filled[static_cast<std::size_t>(y)];
      for (std::size_t t = 0; t + 1 < passes; ++t)
        change[static_cast<std::size_t>(y)][t] += std::abs(depths[t + 1] - depths[t]);
      if (options.keep_iterations)
        for (std::size_t t = 0; t < passes; ++t) dense.iterations[t](x, y) = depths[t];
    }
    context.Report(static_cast<double>(++rows_done) / guide.height(), "upsampling");
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "upsampling was cancelled");
  for (const float c : dense.confidence.values())
    dense.max_confidence = std::max(dense.max_confidence, c);
  dense.mean_change_m = MeanChanges(change, filled, options.iterations);
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
