#include "core/depth/local_plane.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/base/parallel.h"
#include "core/depth/filter_window.h"
#include "core/depth/measured_support.h"
#include "core/depth/row_filter.h"
#include "core/sensor/scan_plan.h"

namespace foresight {
namespace {

constexpr int kBlockRows = 8;
/// Planes need a smaller window than averages: there is no slope to be biased by.
constexpr double kSigmaShare = 0.6;
/// A sample supports a pixel within this many sigma_depth of its plane.
constexpr double kAgreementSigmas = 2.0;

/// The guide in CIELAB, L in [0, 100].
struct LabImage {
  FloatImage channels[3];

  explicit LabImage(const ColorImage& guide) {
    for (auto& channel : channels) channel = FloatImage(guide.width(), guide.height());
    const cv::Mat rgb(guide.height(), guide.width(), CV_8UC3, const_cast<Rgb8*>(guide.data()));
    cv::Mat scaled, lab;
    rgb.convertTo(scaled, CV_32F, 1.0 / 255.0);
    cv::cvtColor(scaled, lab, cv::COLOR_RGB2Lab);
    cv::Mat planes[3];
    for (int c = 0; c < 3; ++c)
      planes[c] = cv::Mat(guide.height(), guide.width(), CV_32F, channels[c].data());
    cv::split(lab, planes);
  }
};

/// Images that the kernel fills beside the depth; only the planes and the weights of H are used.
struct PlaneImages {
  FloatImage sum_gkh, sum_gk, sum_gh, slope_x, slope_y;

  PlaneImages(int width, int height)
      : sum_gkh(width, height),
        sum_gk(width, height),
        sum_gh(width, height),
        slope_x(width, height),
        slope_y(width, height) {}
};

Result<SampleSpacing> SpacingOf(const AlignedSamples& samples, const LocalPlaneOptions& options) {
  SampleSpacing spacing{options.along_line_px, options.between_lines_px};
  if (spacing.along_line_px > 0.0 && spacing.between_lines_px > 0.0) return spacing;
  FORESIGHT_TRY(const SampleSpacing measured, MeasureSpacing(samples));
  if (spacing.along_line_px == 0.0) spacing.along_line_px = std::max(1.0, measured.along_line_px);
  if (spacing.between_lines_px == 0.0)
    spacing.between_lines_px = std::max(1.0, measured.between_lines_px);
  return spacing;
}

/// Sum of G over a window full of samples at their spacing.
double NominalWeight(double sigma_px, double radius_in_sigmas, const SampleSpacing& spacing) {
  const double disc = 1.0 - std::exp(-0.5 * radius_in_sigmas * radius_in_sigmas);
  return 2.0 * std::numbers::pi * sigma_px * sigma_px * disc /
         (spacing.along_line_px * spacing.between_lines_px);
}

double MeanChange(const DepthImage& before, const DepthImage& after) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double change = std::abs(static_cast<double>(after.values()[i]) - before.values()[i]);
    if (std::isnan(change)) continue;
    sum += change;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

Status LocalPlaneOptions::Check() const {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (sigma_spatial_px != 0.0 && !(sigma_spatial_px >= 0.5 && sigma_spatial_px <= 200.0))
    return Fail(ErrorCode::kInvalidOptions,
                "local planes: sigma_spatial_px {} is neither 0 (automatic) nor in [0.5, 200]",
                sigma_spatial_px);
  if (!(radius_in_sigmas >= 0.5 && radius_in_sigmas <= 4.0))
    return Fail(ErrorCode::kInvalidOptions, "local planes: radius_in_sigmas {} is not in [0.5, 4]",
                radius_in_sigmas);
  if (!positive(sigma_color) || !positive(sigma_depth_m) || !positive(ridge))
    return Fail(ErrorCode::kInvalidOptions,
                "local planes: sigma_color {}, sigma_depth_m {} and ridge {} must be positive",
                sigma_color, sigma_depth_m, ridge);
  if (iterations < 1 || iterations > 50)
    return Fail(ErrorCode::kInvalidOptions, "local planes: iterations {} is not in [1, 50]",
                iterations);
  for (const double spacing : {along_line_px, between_lines_px})
    if (!(spacing >= 0.0 && spacing < 1000.0))
      return Fail(ErrorCode::kInvalidOptions, "local planes: spacing {} px is not in [0, 1000)",
                  spacing);
  return {};
}

Result<DenseDepth> UpsampleLocalPlanes(const AlignedSamples& samples, const ColorImage& guide,
                                       const LocalPlaneOptions& options,
                                       const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_CHECK(CheckUpsamplingInput(samples, guide));
  FORESIGHT_TRY(const SampleSpacing spacing, SpacingOf(samples, options));

  DenseDepth dense;
  dense.sigma_spatial_px = options.sigma_spatial_px > 0.0
                               ? options.sigma_spatial_px
                               : kSigmaShare * SpatialSigmaForDensity(LocalDensity(samples));
  const LabImage lab(guide);
  const SparseDepthMap sparse(samples);
  const SpatialKernel spatial(dense.sigma_spatial_px,
                              options.radius_in_sigmas * dense.sigma_spatial_px);
  const std::vector<float> sample_lab[] = {sparse.ValuesAt(lab.channels[0]),
                                           sparse.ValuesAt(lab.channels[1]),
                                           sparse.ValuesAt(lab.channels[2])};
  const PlaneFilter filter{sparse,
                           spatial,
                           {&lab.channels[0], &lab.channels[1], &lab.channels[2]},
                           {sample_lab[0], sample_lab[1], sample_lab[2]},
                           static_cast<float>(dense.sigma_spatial_px),
                           static_cast<float>(options.sigma_color),
                           static_cast<float>(options.sigma_depth_m),
                           static_cast<float>(options.ridge),
                           options.iterations};
  const SupportModel support{
      sparse, spacing.along_line_px, spacing.between_lines_px,
      kAgreementSigmas * options.sigma_depth_m,
      NominalWeight(dense.sigma_spatial_px, options.radius_in_sigmas, spacing)};
  dense.depth_m = DepthImage(guide.width(), guide.height());
  dense.confidence = FloatImage(guide.width(), guide.height());
  dense.max_confidence = 1.0f;
  PlaneImages planes(guide.width(), guide.height());

  if (options.keep_iterations)
    dense.iterations.assign(static_cast<std::size_t>(options.iterations) + 1, dense.depth_m);

  const int block_count = (guide.height() + kBlockRows - 1) / kBlockRows;
  std::atomic<int> blocks_done{0};
  const bool finished = ParallelFor(block_count, context, [&](int block) {
    const int top = block * kBlockRows;
    const int bottom = std::min(top + kBlockRows, guide.height());
    FilterPlaneRows(filter, top, bottom,
                    {dense.depth_m, planes.sum_gkh, planes.sum_gk, planes.sum_gh, planes.slope_x,
                     planes.slope_y, dense.iterations});
    for (int y = top; y < bottom; ++y)
      MeasureSupport(support, y,
                     {dense.depth_m.row(y), planes.slope_x.row(y), planes.slope_y.row(y),
                      planes.sum_gh.row(y)},
                     dense.confidence.row(y));
    context.Report(static_cast<double>(++blocks_done) / block_count, "upsampling");
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "upsampling was cancelled");
  for (std::size_t t = 1; t < dense.iterations.size(); ++t)
    dense.mean_change_m.push_back(MeanChange(dense.iterations[t - 1], dense.iterations[t]));
  return dense;
}

}  // namespace foresight
