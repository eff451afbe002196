#include "core/depth/aligned_samples.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"

namespace foresight {
namespace {

constexpr const char* kReasonNames[] = {"kept", "flying", "isolated", "flipping"};

}  // namespace

const char* ToString(RejectReason reason) {
  return kReasonNames[static_cast<int>(reason)];
}

std::size_t AlignedSamples::KeptCount() const {
  return static_cast<std::size_t>(std::count(reasons.begin(), reasons.end(), RejectReason::kKept));
}

Status AlignedSamples::Check() const {
  if (reasons.size() != samples.size())
    return Fail(ErrorCode::kInvalidInput, "samples: {} reasons for {} samples", reasons.size(),
                samples.size());
  if (rays &&
      (rays->x.width() != width || rays->x.height() != height || !rays->x.SameSize(rays->y)))
    return Fail(ErrorCode::kInvalidInput, "samples in {} x {} pixels, but rays of {} x {}", width,
                height, rays->x.width(), rays->x.height());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const AlignedSample& s = samples[i];
    const auto fail = [&](const char* what) {
      return Fail(ErrorCode::kInvalidInput,
                  "sample {} (line {}, beam {}, u {}, v {}, depth {} m): {}", i, s.line, s.beam,
                  s.u, s.v, s.depth_m, what);
    };
    if (!(s.depth_m > 0.0f) || !std::isfinite(s.depth_m)) return fail("the depth is not positive");
    if (!IsDepth(s.depth_m)) return fail("no lidar measures such a depth");
    const auto w = static_cast<float>(width);
    const auto h = static_cast<float>(height);
    if (!(s.u >= -0.5f && s.v >= -0.5f && s.u < w - 0.5f && s.v < h - 0.5f))
      return fail("outside the image");
    if (s.line < 0 || s.beam < 0 || s.line >= lines || s.beam >= beams)
      return fail("outside the lidar's grid");
  }
  return {};
}

Status CheckUpsamplingInput(const AlignedSamples& samples, const ColorImage& guide) {
  if (guide.width() != samples.width || guide.height() != samples.height)
    return Fail(ErrorCode::kInvalidInput,
                "the image has {} x {} pixels, but the samples were projected into {} x {}",
                guide.width(), guide.height(), samples.width, samples.height);
  if (samples.KeptCount() == 0)
    return Fail(ErrorCode::kTooFewPoints, "none of {} samples is left to upsample",
                samples.samples.size());
  return {};
}

Image<std::int32_t> GridOf(const AlignedSamples& samples, bool only_kept) {
  Image<std::int32_t> grid(samples.beams, samples.lines, -1);
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    if (only_kept && samples.reasons[i] != RejectReason::kKept) continue;
    const AlignedSample& s = samples.samples[i];
    grid(s.beam, s.line) = static_cast<std::int32_t>(i);
  }
  return grid;
}

Result<SampleSpacing> MeasureSpacing(const AlignedSamples& samples) {
  const Image<std::int32_t> grid = GridOf(samples, false);
  std::vector<float> along;
  std::vector<float> between;
  along.reserve(samples.samples.size());
  between.reserve(samples.samples.size());
  const auto distance = [&](std::int32_t a, std::int32_t b) {
    const AlignedSample& p = samples.samples[static_cast<std::size_t>(a)];
    const AlignedSample& q = samples.samples[static_cast<std::size_t>(b)];
    // Not std::hypot: pixels do not overflow, and it takes ten times as long.
    return std::sqrt((p.u - q.u) * (p.u - q.u) + (p.v - q.v) * (p.v - q.v));
  };
  for (int line = 0; line < grid.height(); ++line)
    for (int beam = 0; beam < grid.width(); ++beam) {
      const std::int32_t here = grid(beam, line);
      if (here < 0) continue;
      if (beam + 1 < grid.width() && grid(beam + 1, line) >= 0)
        along.push_back(distance(here, grid(beam + 1, line)));
      if (line + 1 < grid.height() && grid(beam, line + 1) >= 0)
        between.push_back(distance(here, grid(beam, line + 1)));
    }
  if (along.empty() || between.empty())
    return Fail(ErrorCode::kTooFewPoints, "{} samples have no neighbours on the lidar's grid",
                samples.samples.size());
  return SampleSpacing{UpperMedian(std::move(along)), UpperMedian(std::move(between))};
}

double LocalDensity(const AlignedSamples& samples) {
  return LocalDensity(samples, MeasureSpacing(samples));
}

double LocalDensity(const AlignedSamples& samples, const Result<SampleSpacing>& spacing) {
  if (!spacing) return samples.Density();
  const double area_px = spacing->along_line_px * spacing->between_lines_px;
  return std::max(samples.Density(), std::min(1.0, 1.0 / std::max(1.0, area_px)));
}

}  // namespace foresight
