#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/depth/plane_filter.h"

namespace foresight {

/// What a supporter means to the pixels round it, by its place relative to them.
class SupporterTables {
 public:
  SupporterTables(double along_line_px, double between_lines_px);

  int half_width() const { return half_width_; }
  int reach() const { return reach_; }
  /// Values a row; a whole number of the widest registers.
  int stride() const { return stride_; }
  /// Of a supporter dy rows below the pixels, for the pixels from half_width to its left onwards:
  /// its distance in cells of the lidar's grid, and the sides on which it lies, if near enough.
  const float* Cells(int dy) const { return cells_.data() + (dy + reach_) * stride_; }
  const std::int32_t* Sides(int dy) const { return sides_.data() + (dy + reach_) * stride_; }

 private:
  int half_width_;
  int reach_;
  int stride_;
  std::vector<float> cells_;
  std::vector<std::int32_t> sides_;
};

/// What a pixel's neighbourhood is compared with.
struct SupportModel {
  const SparseDepthMap& samples;
  std::span<const SamplePlane> places;  ///< one a sample, for its ray
  SupporterTables tables;               ///< of the samples' spacing
  double agreement_m;                   ///< a sample this near to the pixel's plane supports it
  double nominal_weight;                ///< sum of G that a full neighbourhood would have
};

/// One image row of planes of inverse depth, as FilterPlaneRows makes them.
struct PlaneRow {
  const float* depth_m;  ///< at the pixel; NaN = no plane
  const float* slope_x;  ///< over the rays' coordinates
  const float* slope_y;
  const float* sum_gkh;
  const float* sum_gk;
  const float* sum_gh;
  const float* ray_x;  ///< the pixels' own; null = columns and rows
  const float* ray_y;
  const std::uint8_t* inside;  ///< not 0 = in a connected cell
};

/// What the log odds of a confidence are linear in: numbers of a pixel.
enum SupportTerm : std::size_t {
  kNearestCells,    ///< distance of the nearest supporter, in cells
  kSquaredWeight,   ///< squared fraction of the nominal weight
  kOneSidedRow,     ///< 1: no supporter within reach to the left or to the right
  kOneSidedColumn,  ///< the same above or below
  kAgreement,       ///< fraction of the weight of the pixel's colour
  kInsideCell,      ///< 1: in a connected cell
  kSupportTerms,
};
using SupportTerms = std::array<float, kSupportTerms>;
/// An image of each.
using SupportTermImages = std::array<FloatImage, kSupportTerms>;

struct ConfidenceWeights {
  float bias = 0.0f;
  SupportTerms of = {};

  /// In [0, 1].
  float Confidence(const SupportTerms& terms) const;
};

/// Those of the program. `packaging/refit-confidence` fits them again and prints both.
const ConfidenceWeights& ShippedConfidenceWeights();

/// For each pixel of row `y` the probability that its depth is right, within 50 mm or 1 %; 0 where
/// there is none. It knows how many samples agree with the pixel's plane against what their spacing
/// promises, what fraction of those of its colour do, how near the nearest one is in cells of the
/// lidar's grid, whether there are some on each side, and whether the pixel lies inside a cell on
/// one surface. O(samples around the row * samples' spacing).
/// @param terms what it was computed from; null = not wanted
void MeasureSupport(const SupportModel& model, int y, const PlaneRow& planes, float* confidence,
                    SupportTermImages* terms = nullptr);

/// How many rows away MeasureSupport still looks at samples.
inline int SupportReach(const SupportModel& model) {
  return model.tables.reach();
}

}  // namespace foresight
