#include "core/depth/local_plane_upsampler.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include "core/base/parallel.h"
#include "core/depth/connected_cells.h"
#include "core/depth/measured_support.h"
#include "core/depth/sample_planes.h"

namespace foresight {
namespace {

constexpr int kBlockRows = 8;
/// A sample supports a pixel within this many sigma_depth of its plane.
constexpr double kAgreementSigmas = 2.0;
/// Passes from each candidate to a sample's plane; more change no score.
constexpr int kSamplePasses = 2;
/// Neighbours on the grid lie on one surface within this.
constexpr double kOneSurface_m = 0.050;

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

Result<SampleSpacing> SpacingOf(const Result<SampleSpacing>& measured,
                                const LocalPlaneOptions& options) {
  SampleSpacing spacing{options.along_line_px, options.between_lines_px};
  if (spacing.along_line_px > 0.0 && spacing.between_lines_px > 0.0) return spacing;
  if (!measured) return measured;
  if (spacing.along_line_px == 0.0) spacing.along_line_px = std::max(1.0, measured->along_line_px);
  if (spacing.between_lines_px == 0.0)
    spacing.between_lines_px = std::max(1.0, measured->between_lines_px);
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

template <class T>
bool SameBits(const T& a, const T& b) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Rows of samples that were there before and now differ in `now[q]` from `before[p]`.
template <class T>
RowSet RowsThatDiffer(const SparseDepthMap& map, const SampleChange& change,
                      const std::vector<T>& before, const std::vector<T>& now) {
  RowSet rows(map.height());
  for (std::size_t q = 0; q < now.size(); ++q) {
    const std::int32_t p = change.before[q];
    if (p >= 0 && !SameBits(before[static_cast<std::size_t>(p)], now[q])) rows.Add(map.rows()[q]);
  }
  return rows;
}

RowSet RowsThatDiffer(const MaskImage& before, const MaskImage& now) {
  RowSet rows(now.height());
  for (int y = 0; y < now.height(); ++y)
    if (!std::equal(now.row(y), now.row(y) + now.width(), before.row(y))) rows.Add(y);
  return rows;
}

/// The rows of one block: depth, then confidence.
void FilterBlock(const PlaneFilter& filter, const SupportModel& support, const MaskImage& inside,
                 int top, DenseDepth& dense, SupportTermImages* terms) {
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
                   dense.confidence.row(y), terms);
  }
}

}  // namespace

bool LocalPlaneUpsampler::Cached::SameWindow(const Cached& other) const {
  return sigma_px == other.sigma_px && spacing.along_line_px == other.spacing.along_line_px &&
         spacing.between_lines_px == other.spacing.between_lines_px &&
         samples.samples.rays == other.samples.samples.rays;
}

Status LocalPlaneUpsampler::Update(const AlignedSamples& samples, const RunContext& context) {
  // A failure on the way leaves nothing behind.
  const std::optional<Cached> last = std::exchange(cached_, std::nullopt);
  FORESIGHT_CHECK(options_.Check());
  FORESIGHT_CHECK(CheckUpsamplingInput(samples, guide_));
  if (lab_.channels[0].empty()) {
    FORESIGHT_TRY(lab_, ToLab(guide_, context));
  }
  FORESIGHT_TRY(Cached now, Describe(samples, context));
  const Cached* before = last && last->SameWindow(now) ? &*last : nullptr;
  const SampleChange change =
      before ? CompareSamples(before->samples, now.samples) : EverythingNew(now.samples);
  FORESIGHT_CHECK(FindPlanes(before, change, now, context));
  FORESIGHT_CHECK(FindCells(before, change, now, context));
  if (!before) Reset(now.sigma_px);
  FORESIGHT_CHECK(FilterPixels(before, change, now, context));
  cached_ = std::move(now);
  return {};
}

Result<LocalPlaneUpsampler::Cached> LocalPlaneUpsampler::Describe(const AlignedSamples& samples,
                                                                  const RunContext& context) const {
  const bool given = options_.along_line_px > 0.0 && options_.between_lines_px > 0.0 &&
                     options_.sigma_spatial_px > 0.0;
  const Result<SampleSpacing> measured = given ? SampleSpacing() : MeasureSpacing(samples);
  FORESIGHT_TRY(const SampleSpacing spacing, SpacingOf(measured, options_));
  const double sigma_px = options_.sigma_spatial_px > 0.0
                              ? options_.sigma_spatial_px
                              : LocalPlaneSigmaForDensity(LocalDensity(samples, measured));
  Cached cached{MappedSamples(samples), spacing, sigma_px,
                SpatialKernel(sigma_px, options_.radius_in_sigmas * sigma_px)};
  for (std::size_t c = 0; c < cached.sample_lab.size(); ++c)
    cached.sample_lab[c] = cached.samples.map.ValuesAt(lab_.channels[c]);
  cached.planes = LevelPlanes(cached.samples.map, samples, context);
  cached.slopes = SlopesOnGrid(cached.samples.map, samples, cached.planes, context);
  if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "upsampling was cancelled");
  return cached;
}

PlaneFilter LocalPlaneUpsampler::FilterOf(const Cached& cached) const {
  PlaneFilter filter{cached.samples.map,
                     cached.planes,
                     cached.spatial,
                     {&lab_.channels[0], &lab_.channels[1], &lab_.channels[2]},
                     {cached.sample_lab[0], cached.sample_lab[1], cached.sample_lab[2]}};
  if (const auto& rays = cached.samples.samples.rays) filter.ray = {&rays->x, &rays->y};
  filter.sigma_spatial_px = static_cast<float>(cached.sigma_px);
  filter.sigma_colour = static_cast<float>(options_.sigma_color);
  filter.sigma_depth_m = static_cast<float>(options_.sigma_depth_m);
  filter.ridge = static_cast<float>(options_.ridge);
  filter.iterations = options_.iterations;
  return filter;
}

/// From level planes to those of each sample's neighbourhood.
Status LocalPlaneUpsampler::FindPlanes(const Cached* before, const SampleChange& change,
                                       Cached& now, const RunContext& context) const {
  const SparseDepthMap& map = now.samples.map;
  RowSet rows = change.rows.GrownBy(now.spatial.radius());
  if (before) {
    rows |= RowsThatDiffer(map, change, before->slopes, now.slopes);
    for (std::size_t q = 0; q < map.size(); ++q)
      if (change.before[q] >= 0)
        now.planes[q] = before->planes[static_cast<std::size_t>(change.before[q])];
  }
  PlaneFilter filter = FilterOf(now);
  filter.iterations = kSamplePasses;
  const std::vector<int> blocks = rows.Blocks(kBlockRows);
  const bool finished = ParallelFor(static_cast<int>(blocks.size()), context, [&](int i) {
    const int top = blocks[static_cast<std::size_t>(i)] * kBlockRows;
    FitSamplePlanes(filter, now.slopes, top, std::min(top + kBlockRows, map.height()), now.planes);
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "upsampling was cancelled");
  return {};
}

Status LocalPlaneUpsampler::FindCells(const Cached* before, const SampleChange& change, Cached& now,
                                      const RunContext& context) const {
  const SparseDepthMap& map = now.samples.map;
  RowSet rows = change.rows;
  if (before) {
    now.inside = before->inside;
    rows |= RowsThatDiffer(map, change, before->planes, now.planes);
  } else {
    now.inside = MaskImage(map.width(), map.height(), 0);
  }
  return UpdateConnectedCells(map, now.samples.samples, now.planes, now.spacing, kOneSurface_m,
                              rows, now.inside, context);
}

void LocalPlaneUpsampler::Reset(double sigma_px) {
  dense_ = DenseDepth();
  dense_.sigma_spatial_px = sigma_px;
  dense_.depth_m = DepthImage(guide_.width(), guide_.height());
  dense_.confidence = dense_.depth_m;
  dense_.max_confidence = 1.0f;
  if (options_.keep_iterations)
    dense_.iterations.assign(static_cast<std::size_t>(options_.iterations) + 1, dense_.depth_m);
  if (terms_ != nullptr) terms_->fill(dense_.depth_m);
}

Status LocalPlaneUpsampler::FilterPixels(const Cached* before, const SampleChange& change,
                                         const Cached& now, const RunContext& context) {
  const SparseDepthMap& map = now.samples.map;
  const PlaneFilter filter = FilterOf(now);
  const SupportModel support{map,
                             now.planes,
                             {now.spacing.along_line_px, now.spacing.between_lines_px},
                             kAgreementSigmas * options_.sigma_depth_m,
                             NominalWeight(now.sigma_px, options_.radius_in_sigmas, now.spacing)};
  const int radius = now.spatial.radius();
  RowSet rows = change.rows.GrownBy(std::max(radius, SupportReach(support)));
  if (before) {
    rows |= RowsThatDiffer(map, change, before->planes, now.planes).GrownBy(radius);
    rows |= RowsThatDiffer(before->inside, now.inside);
  }
  const std::vector<int> blocks = rows.Blocks(kBlockRows);
  const int count = static_cast<int>(blocks.size());
  std::atomic<int> blocks_done{0};
  const bool finished = ParallelFor(count, context, [&](int i) {
    FilterBlock(filter, support, now.inside, blocks[static_cast<std::size_t>(i)] * kBlockRows,
                dense_, terms_);
    context.Report(static_cast<double>(++blocks_done) / count, "upsampling");
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "upsampling was cancelled");
  filtered_rows_ = std::min(guide_.height(), count * kBlockRows);
  dense_.mean_change_m.clear();
  for (std::size_t t = 1; t < dense_.iterations.size(); ++t)
    dense_.mean_change_m.push_back(MeanChange(dense_.iterations[t - 1], dense_.iterations[t]));
  return {};
}

}  // namespace foresight
