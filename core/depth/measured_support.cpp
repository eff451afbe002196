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

constexpr std::int32_t kLeft = 1, kRight = 2, kAbove = 4, kBelow = 8;

/// What a supporter at an offset means to a pixel, for one dy: by the pixel's place relative to it.
struct SupporterTable {
  std::vector<float> cells;         ///< distance in cells of the lidar's grid
  std::vector<std::int32_t> sides;  ///< where the supporter lies, if within reach
};

SupporterTable TableFor(int half_width, int dy, float du, float dv) {
  SupporterTable table;
  const float down = std::abs(static_cast<float>(dy)) / dv;
  for (int dx = half_width; dx >= -half_width; --dx) {
    const float aside = std::abs(static_cast<float>(dx)) / du;
    table.cells.push_back(std::max(aside, down));
    std::int32_t sides = 0;
    if (down <= 1.0f && aside <= kReachCells)
      sides |= (dx <= 0 ? kLeft : 0) | (dx >= 0 ? kRight : 0);
    if (aside <= 1.0f && down <= kReachCells)
      sides |= (dy <= 0 ? kAbove : 0) | (dy >= 0 ? kBelow : 0);
    table.sides.push_back(sides);
  }
  return table;
}

/// Supporters found so far for each pixel of a row.
struct RowSupport {
  std::vector<float> inverse_depth;  ///< NaN = no plane
  std::vector<float> nearest;        ///< cells
  std::vector<std::int32_t> sides;

  void Reset(const float* depth_m, int width) {
    inverse_depth.resize(static_cast<std::size_t>(width));
    for (std::size_t x = 0; x < inverse_depth.size(); ++x) inverse_depth[x] = 1.0f / depth_m[x];
    nearest.assign(inverse_depth.size(), kFarthestCells);
    sides.assign(inverse_depth.size(), 0);
  }
};

float Confidence(float nearest, std::int32_t sides, float weight) {
  const float one_sided = ((sides & kLeft) != 0 && (sides & kRight) != 0 ? 0.0f : kOneSidedRow) +
                          ((sides & kAbove) != 0 && (sides & kBelow) != 0 ? 0.0f : kOneSidedColumn);
  const float full = std::min(kFullestWeight, weight);
  return 1.0f /
         (1.0f + std::exp(-(kBias + kPerCell * nearest + kPerWeight2 * full * full + one_sided)));
}

}  // namespace

void MeasureSupport(const SupportModel& model, int y, const PlaneRow& planes, float* confidence) {
  const auto du = static_cast<float>(model.along_line_px);
  const auto dv = static_cast<float>(model.between_lines_px);
  const auto agreement = static_cast<float>(model.agreement_m);
  const int half_width = static_cast<int>(std::ceil(kFarthestCells * du));
  const int half_height = static_cast<int>(std::ceil(kFarthestCells * dv));
  const int width = model.samples.width();
  thread_local RowSupport support;
  support.Reset(planes.depth_m, width);
  for (int dy = std::max(-half_height, -y);
       dy <= std::min(half_height, model.samples.height() - 1 - y); ++dy) {
    if (model.samples.First(y + dy) == model.samples.First(y + dy + 1)) continue;
    const SupporterTable table = TableFor(half_width, dy, du, dv);
    const auto down = static_cast<float>(dy);
    for (std::int32_t i = model.samples.First(y + dy); i < model.samples.First(y + dy + 1); ++i) {
      const int column = model.samples.columns()[static_cast<std::size_t>(i)];
      const float depth_m = model.samples.depths_m()[static_cast<std::size_t>(i)];
      const int from = std::max(0, column - half_width);
      const int to = std::min(width - 1, column + half_width);
      const float* cells = table.cells.data() + (half_width - column);
      const std::int32_t* sides = table.sides.data() + (half_width - column);
      // Neighbouring pixels side by side: the compiler turns this loop into vector instructions.
      for (int x = from; x <= to; ++x) {
        const float predicted = support.inverse_depth[static_cast<std::size_t>(x)] +
                                planes.slope_x[x] * static_cast<float>(column - x) +
                                planes.slope_y[x] * down;
        // |R - 1 / rho| <= agreement, times rho; false for a NaN and behind infinity.
        const bool agrees = std::abs(depth_m * predicted - 1.0f) <= agreement * predicted;
        float& nearest = support.nearest[static_cast<std::size_t>(x)];
        nearest = agrees && cells[x] < nearest ? cells[x] : nearest;
        support.sides[static_cast<std::size_t>(x)] |= agrees ? sides[x] : 0;
      }
    }
  }
  for (int x = 0; x < width; ++x) {
    const auto i = static_cast<std::size_t>(x);
    confidence[x] = std::isnan(planes.depth_m[x])
                        ? 0.0f
                        : Confidence(support.nearest[i], support.sides[i],
                                     planes.sum_gh[x] / static_cast<float>(model.nominal_weight));
  }
}

}  // namespace foresight
