#include "core/depth/measured_support.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/depth/supporters.h"

namespace foresight {
namespace {

constexpr float kReachCells = 1.25f;
constexpr float kFarthestCells = 1.5f;
constexpr float kFullestWeight = 1.2f;

constexpr std::int32_t kLeft = 1, kRight = 2, kAbove = 4, kBelow = 8;

/// The row's planes, and no supporters yet.
void Begin(const SupportModel& model, int y, const PlaneRow& planes, RowSupport& row) {
  const int width = model.samples.width();
  row.margin = model.tables.half_width();
  const int padded = width + row.margin + model.tables.stride();
  row.values.Reset(4, 1, padded);
  row.sides.assign(static_cast<std::size_t>(padded), 0);
  std::fill_n(row.AtOrigin() - row.margin, padded, std::numeric_limits<float>::quiet_NaN());
  std::fill_n(row.Nearest() - row.margin, padded, kFarthestCells);
  std::copy_n(planes.slope_x, width, row.SlopeX());
  std::copy_n(planes.slope_y, width, row.SlopeY());
  for (int x = 0; x < width; ++x) {
    const float ray_x = planes.ray_x != nullptr ? planes.ray_x[x] : static_cast<float>(x);
    const float ray_y = planes.ray_y != nullptr ? planes.ray_y[x] : static_cast<float>(y);
    row.AtOrigin()[x] =
        1.0f / planes.depth_m[x] - planes.slope_x[x] * ray_x - planes.slope_y[x] * ray_y;
  }
}

SupportTerms TermsOf(float nearest, std::int32_t sides, float weight, float agreement,
                     bool inside) {
  const float full = std::min(kFullestWeight, weight);
  SupportTerms terms;
  terms[kNearestCells] = nearest;
  terms[kSquaredWeight] = full * full;
  terms[kOneSidedRow] = (sides & kLeft) != 0 && (sides & kRight) != 0 ? 0.0f : 1.0f;
  terms[kOneSidedColumn] = (sides & kAbove) != 0 && (sides & kBelow) != 0 ? 0.0f : 1.0f;
  terms[kAgreement] = agreement;
  terms[kInsideCell] = inside ? 1.0f : 0.0f;
  return terms;
}

}  // namespace

SupporterTables::SupporterTables(double along_line_px, double between_lines_px)
    : half_width_(static_cast<int>(std::ceil(kFarthestCells * along_line_px))),
      reach_(static_cast<int>(std::ceil(kFarthestCells * between_lines_px))),
      stride_((2 * half_width_ + SpatialKernel::kMargin) / SpatialKernel::kMargin *
              SpatialKernel::kMargin) {
  const auto size = static_cast<std::size_t>((2 * reach_ + 1) * stride_);
  cells_.assign(size, kFarthestCells);
  sides_.assign(size, 0);
  for (int dy = -reach_; dy <= reach_; ++dy)
    for (int dx = half_width_; dx >= -half_width_; --dx) {
      const auto at = static_cast<std::size_t>((dy + reach_) * stride_ + half_width_ - dx);
      const float aside = std::abs(static_cast<float>(dx)) / static_cast<float>(along_line_px);
      const float down = std::abs(static_cast<float>(dy)) / static_cast<float>(between_lines_px);
      cells_[at] = std::max(aside, down);
      if (down <= 1.0f && aside <= kReachCells)
        sides_[at] |= (dx <= 0 ? kLeft : 0) | (dx >= 0 ? kRight : 0);
      if (aside <= 1.0f && down <= kReachCells)
        sides_[at] |= (dy <= 0 ? kAbove : 0) | (dy >= 0 ? kBelow : 0);
    }
}

float ConfidenceWeights::Confidence(const SupportTerms& terms) const {
  float score = bias;
  for (std::size_t i = 0; i < kSupportTerms; ++i) score += of[i] * terms[i];
  return 1.0f / (1.0f + std::exp(-score));
}

const ConfidenceWeights& ShippedConfidenceWeights() {
  static constexpr ConfidenceWeights kWeights = {
      .bias = 0.81f, .of = {-3.22f, 4.89f, -0.87f, -0.09f, 0.90f, 1.17f}};
  return kWeights;
}

void MeasureSupport(const SupportModel& model, int y, const PlaneRow& planes, float* confidence,
                    SupportTermImages* terms) {
  thread_local RowSupport row;
  Begin(model, y, planes, row);
  FindSupporters(model, y, row);
  const float* nearest = row.Nearest();
  const std::int32_t* sides = row.Sides();
  const ConfidenceWeights& weights = ShippedConfidenceWeights();
  for (int x = 0; x < model.samples.width(); ++x) {
    confidence[x] = 0.0f;
    if (std::isnan(planes.depth_m[x])) continue;
    const SupportTerms of_pixel =
        TermsOf(nearest[x], sides[x], planes.sum_gh[x] / static_cast<float>(model.nominal_weight),
                planes.sum_gkh[x] / planes.sum_gk[x], planes.inside[x] != 0);
    confidence[x] = weights.Confidence(of_pixel);
    if (terms == nullptr) continue;
    for (std::size_t i = 0; i < kSupportTerms; ++i) (*terms)[i](x, y) = of_pixel[i];
  }
}

}  // namespace foresight
