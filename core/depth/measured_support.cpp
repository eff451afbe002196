#include "core/depth/measured_support.h"

#include <algorithm>
#include <cmath>

namespace foresight {
namespace {

/// Logistic regression of "this pixel has a truth" over seven Middlebury scenes at quarter and full
/// size; leaving one scene out gives the same masks. docs/evaluation.md.
constexpr float kBias = 2.46f;
constexpr float kPerCell = -3.58f;      ///< distance of the nearest supporter, in cells
constexpr float kPerWeight2 = 5.34f;    ///< squared share of the nominal weight
constexpr float kOneSidedRow = -0.86f;  ///< no supporter within reach to the left or to the right
constexpr float kOneSidedColumn = -0.23f;
constexpr float kReachCells = 1.25f;
constexpr float kFarthestCells = 1.5f;
constexpr float kFullestWeight = 1.2f;

}  // namespace

float MeasuredSupport(const SupportModel& model, int x, int y, const PixelPlane& plane,
                      float sum_gh) {
  const auto du = static_cast<float>(model.along_line_px);
  const auto dv = static_cast<float>(model.between_lines_px);
  const auto agreement = static_cast<float>(model.agreement_m);
  const int half_width = static_cast<int>(std::ceil(kFarthestCells * du));
  const int half_height = static_cast<int>(std::ceil(kFarthestCells * dv));
  const std::span<const std::int32_t> columns = model.samples.columns();
  const std::span<const float> depths_m = model.samples.depths_m();
  float nearest = kFarthestCells;
  bool left = false, right = false, above = false, below = false;
  for (int dy = std::max(-half_height, -y);
       dy <= std::min(half_height, model.samples.height() - 1 - y); ++dy) {
    const auto first = columns.begin() + model.samples.First(y + dy);
    const auto last = columns.begin() + model.samples.First(y + dy + 1);
    for (auto at = std::lower_bound(first, last, x - half_width);
         at < last && *at <= x + half_width; ++at) {
      const float depth_m = depths_m[static_cast<std::size_t>(at - columns.begin())];
      const auto dx = static_cast<float>(*at - x);
      const auto down = static_cast<float>(dy);
      const float predicted = plane.inverse_depth + plane.slope_x * dx + plane.slope_y * down;
      if (!(predicted > 0.0f) || std::abs(depth_m - 1.0f / predicted) > agreement) continue;
      const float cells_aside = std::abs(dx) / du;
      const float cells_down = std::abs(down) / dv;
      nearest = std::min(nearest, std::max(cells_aside, cells_down));
      if (cells_down <= 1.0f && cells_aside <= kReachCells) (dx <= 0.0f ? left : right) = true;
      if (cells_aside <= 1.0f && cells_down <= kReachCells) (dy <= 0 ? above : below) = true;
      if (dx == 0.0f && cells_down <= 1.0f) right = true;
      if (dy == 0 && cells_aside <= 1.0f) below = true;
    }
  }
  const float weight = std::min(kFullestWeight, sum_gh / static_cast<float>(model.nominal_weight));
  const float score = kBias + kPerCell * nearest + kPerWeight2 * weight * weight +
                      (left && right ? 0.0f : kOneSidedRow) +
                      (above && below ? 0.0f : kOneSidedColumn);
  return 1.0f / (1.0f + std::exp(-score));
}

}  // namespace foresight
