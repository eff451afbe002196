#include "core/depth/local_plane.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/base/parallel.h"
#include "core/depth/connected_cells.h"
#include "core/depth/filter_window.h"
#include "core/depth/measured_support.h"
#include "core/depth/plane_filter.h"
#include "core/depth/sample_planes.h"
#include "core/sensor/scan_plan.h"

namespace foresight {
namespace {

constexpr int kBlockRows = 8;
/// Planes need a smaller window than averages: there is no slope to be biased by.
constexpr double kSigmaShare = 0.6;
/// A sample supports a pixel within this many sigma_depth of its plane.
constexpr double kAgreementSigmas = 2.0;
/// Passes from each candidate to a sample's plane.
constexpr int kSamplePasses = 4;
/// Neighbours on the grid lie on one surface within this.
constexpr double kOneSurface_m = 0.050;

int BlockCount(int height) {
  return (height + kBlockRows - 1) / kBlockRows;
}

/// The guide in CIELAB, L in [0, 100].
struct LabImage {
  FloatImage channels[3];

  LabImage(const ColorImage& guide, const RunContext& context) {
    for (auto& channel : channels) channel = FloatImage(guide.width(), guide.height());
    const int blocks = BlockCount(guide.height());
    ParallelFor(blocks, context, [&](int block) { Convert(guide, block * kBlockRows); });
  }

 private:
  void Convert(const ColorImage& guide, int top) {
    const int rows = std::min(kBlockRows, guide.height() - top);
    const cv::Mat rgb(rows, guide.width(), CV_8UC3, const_cast<Rgb8*>(guide.row(top)));
    cv::Mat scaled, lab;
    rgb.convertTo(scaled, CV_32F, 1.0 / 255.0);
    cv::cvtColor(scaled, lab, cv::COLOR_RGB2Lab);
    cv::Mat planes[3];
    for (int c = 0; c < 3; ++c)
      planes[c] = cv::Mat(rows, guide.width(), CV_32F, channels[c].row(top));
    cv::split(lab, planes);
  }
};

/// What the kernel hands out for one block of rows.
struct BlockImages {
  FloatImage depth_m, sum_gkh, sum_gk, sum_gh, slope_x, slope_y;
  std::vector<DepthImage> iterations;

  BlockImages(int width, std::size_t kept_iterations)
      : depth_m(width, kBlockRows),
        sum_gkh(depth_m),
        sum_gk(depth_m),
        sum_gh(depth_m),
        slope_x(depth_m),
        slope_y(depth_m),
        iterations(kept_iterations, depth_m) {}
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

/// From level planes to those of each sample's surroundings.
Status FindSamplePlanes(const PlaneFilter& filter, const AlignedSamples& samples,
                        std::vector<SamplePlane>& planes, const RunContext& context) {
  const std::vector<SlopeCandidates> slopes = SlopesOnGrid(filter.samples, samples, planes);
  const int height = filter.samples.height();
  const bool finished = ParallelFor(BlockCount(height), context, [&](int block) {
    FitSamplePlanes(filter, slopes, block * kBlockRows, std::min((block + 1) * kBlockRows, height),
                    planes);
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "upsampling was cancelled");
  return {};
}

/// The rows of one block: depth, then confidence.
void FilterBlock(const PlaneFilter& filter, const SupportModel& support, const MaskImage& inside,
                 int top, DenseDepth& dense) {
  const int width = filter.samples.width();
  const int bottom = std::min(top + kBlockRows, filter.samples.height());
  BlockImages images(width, dense.iterations.size());
  FilterPlaneRows(filter, top, bottom,
                  {images.depth_m, images.sum_gkh, images.sum_gk, images.sum_gh, images.slope_x,
                   images.slope_y, images.iterations});
  for (int y = top; y < bottom; ++y) {
    const int row = y - top;
    std::copy_n(images.depth_m.row(row), width, dense.depth_m.row(y));
    for (std::size_t t = 0; t < dense.iterations.size(); ++t)
      std::copy_n(images.iterations[t].row(row), width, dense.iterations[t].row(y));
    const bool rays = filter.ray[0] != nullptr;
    MeasureSupport(support, y,
                   {images.depth_m.row(row), images.slope_x.row(row), images.slope_y.row(row),
                    images.sum_gkh.row(row), images.sum_gk.row(row), images.sum_gh.row(row),
                    rays ? filter.ray[0]->row(y) : nullptr, rays ? filter.ray[1]->row(y) : nullptr,
                    inside.row(y)},
                   dense.confidence.row(y));
  }
}

Status FilterPixels(const PlaneFilter& filter, const SupportModel& support, const MaskImage& inside,
                    DenseDepth& dense, const RunContext& context) {
  const int blocks = BlockCount(filter.samples.height());
  std::atomic<int> blocks_done{0};
  const bool finished = ParallelFor(blocks, context, [&](int block) {
    FilterBlock(filter, support, inside, block * kBlockRows, dense);
    context.Report(static_cast<double>(++blocks_done) / blocks, "upsampling");
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "upsampling was cancelled");
  return {};
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
  const LabImage lab(guide, context);
  const SparseDepthMap sparse(samples);
  const SpatialKernel spatial(dense.sigma_spatial_px,
                              options.radius_in_sigmas * dense.sigma_spatial_px);
  const std::vector<float> sample_lab[] = {sparse.ValuesAt(lab.channels[0]),
                                           sparse.ValuesAt(lab.channels[1]),
                                           sparse.ValuesAt(lab.channels[2])};
  std::vector<SamplePlane> planes = LevelPlanes(sparse, samples);
  PlaneFilter filter{sparse,
                     planes,
                     spatial,
                     {&lab.channels[0], &lab.channels[1], &lab.channels[2]},
                     {sample_lab[0], sample_lab[1], sample_lab[2]}};
  if (samples.rays) filter.ray = {&samples.rays->x, &samples.rays->y};
  filter.sigma_spatial_px = static_cast<float>(dense.sigma_spatial_px);
  filter.sigma_colour = static_cast<float>(options.sigma_color);
  filter.sigma_depth_m = static_cast<float>(options.sigma_depth_m);
  filter.ridge = static_cast<float>(options.ridge);
  filter.iterations = kSamplePasses;
  FORESIGHT_CHECK(FindSamplePlanes(filter, samples, planes, context));
  filter.iterations = options.iterations;
  FORESIGHT_TRY(const MaskImage inside,
                InsideConnectedCells(sparse, samples, planes, spacing, kOneSurface_m, context));
  const SupportModel support{
      sparse,
      planes,
      spacing.along_line_px,
      spacing.between_lines_px,
      kAgreementSigmas * options.sigma_depth_m,
      NominalWeight(dense.sigma_spatial_px, options.radius_in_sigmas, spacing)};

  dense.depth_m = DepthImage(guide.width(), guide.height());
  dense.confidence = FloatImage(guide.width(), guide.height());
  dense.max_confidence = 1.0f;
  if (options.keep_iterations)
    dense.iterations.assign(static_cast<std::size_t>(options.iterations) + 1, dense.depth_m);
  FORESIGHT_CHECK(FilterPixels(filter, support, inside, dense, context));
  for (std::size_t t = 1; t < dense.iterations.size(); ++t)
    dense.mean_change_m.push_back(MeanChange(dense.iterations[t - 1], dense.iterations[t]));
  return dense;
}

}  // namespace foresight
