#include "core/depth/measured_support.h"

#include <algorithm>
#include <cmath>

namespace foresight {
namespace {

/// Logistic regression over seven Middlebury scenes at quarter and full size, see
/// docs/evaluation.md.
constexpr float kBias = 0.81f;
constexpr float kPerCell = -3.22f;      ///< distance of the nearest supporter, in cells
constexpr float kPerWeight2 = 4.89f;    ///< squared share of the nominal weight
constexpr float kOneSidedRow = -0.87f;  ///< no supporter within reach to the left or to the right
constexpr float kOneSidedColumn = -0.09f;
constexpr float kPerAgreement = 0.90f;  ///< share of the weight of the pixel's colour
constexpr float kInsideCell = 1.17f;
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
  std::vector<float> at_origin;  ///< inverse depth of the plane at x = y = 0; NaN = no plane
  std::vector<float> nearest;    ///< cells
  std::vector<std::int32_t> sides;

  void Reset(const PlaneRow& planes, int y, int width) {
    at_origin.resize(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x) {
      const float ray_x = planes.ray_x != nullptr ? planes.ray_x[x] : static_cast<float>(x);
      const float ray_y = planes.ray_y != nullptr ? planes.ray_y[x] : static_cast<float>(y);
      at_origin[static_cast<std::size_t>(x)] =
          1.0f / planes.depth_m[x] - planes.slope_x[x] * ray_x - planes.slope_y[x] * ray_y;
    }
    nearest.assign(at_origin.size(), kFarthestCells);
    sides.assign(at_origin.size(), 0);
  }
};

float Confidence(float nearest, std::int32_t sides, float weight, float agreement, bool inside) {
  const float one_sided = ((sides & kLeft) != 0 && (sides & kRight) != 0 ? 0.0f : kOneSidedRow) +
                          ((sides & kAbove) != 0 && (sides & kBelow) != 0 ? 0.0f : kOneSidedColumn);
  const float full = std::min(kFullestWeight, weight);
  const float score = kBias + kPerCell * nearest + kPerWeight2 * full * full + one_sided +
                      kPerAgreement * agreement + (inside ? kInsideCell : 0.0f);
  return 1.0f / (1.0f + std::exp(-score));
}

}  // namespace

int SupportReach(const SupportModel& model) {
  const auto dv = static_cast<float>(model.between_lines_px);
  return static_cast<int>(std::ceil(kFarthestCells * dv));
}

void MeasureSupport(const SupportModel& model, int y, const PlaneRow& planes, float* confidence) {
  const auto du = static_cast<float>(model.along_line_px);
  const auto dv = static_cast<float>(model.between_lines_px);
  const auto agreement = static_cast<float>(model.agreement_m);
  const int half_width = static_cast<int>(std::ceil(kFarthestCells * du));
  const int half_height = SupportReach(model);
  const int width = model.samples.width();
  thread_local RowSupport support;
  support.Reset(planes, y, width);
  for (int dy = std::max(-half_height, -y);
       dy <= std::min(half_height, model.samples.height() - 1 - y); ++dy) {
    if (model.samples.First(y + dy) == model.samples.First(y + dy + 1)) continue;
    const SupporterTable table = TableFor(half_width, dy, du, dv);
    for (std::int32_t i = model.samples.First(y + dy); i < model.samples.First(y + dy + 1); ++i) {
      const int column = model.samples.columns()[static_cast<std::size_t>(i)];
      const float depth_m = model.samples.depths_m()[static_cast<std::size_t>(i)];
      const float place_x = model.places[static_cast<std::size_t>(i)].x;
      const float place_y = model.places[static_cast<std::size_t>(i)].y;
      const int from = std::max(0, column - half_width);
      const int to = std::min(width - 1, column + half_width);
      const float* cells = table.cells.data() + (half_width - column);
      const std::int32_t* sides = table.sides.data() + (half_width - column);
      // Neighbouring pixels side by side: the compiler turns this loop into vector instructions.
      for (int x = from; x <= to; ++x) {
        const float predicted = support.at_origin[static_cast<std::size_t>(x)] +
                                planes.slope_x[x] * place_x + planes.slope_y[x] * place_y;
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
                                     planes.sum_gh[x] / static_cast<float>(model.nominal_weight),
                                     planes.sum_gkh[x] / planes.sum_gk[x], planes.inside[x] != 0);
  }
}

}  // namespace foresight
