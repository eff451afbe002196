#pragma once

#include <vector>

#include "core/base/parallel.h"
#include "core/depth/connected_cells.h"
#include "core/depth/measured_support.h"
#include "tests/benchmark/room.h"

namespace foresight {

/// What the plane filter hands out for a block of rows.
struct PlaneBlock {
  FloatImage depth_m, sum_gkh, sum_gk, sum_gh, slope_x, slope_y;

  explicit PlaneBlock(int width)
      : depth_m(width, 8),
        sum_gkh(depth_m),
        sum_gk(depth_m),
        sum_gh(depth_m),
        slope_x(depth_m),
        slope_y(depth_m) {}
  PlaneFilterOutput Output() { return {depth_m, sum_gkh, sum_gk, sum_gh, slope_x, slope_y}; }
  PlaneRow Row(int row, const std::uint8_t* inside) const {
    return {depth_m.row(row), slope_x.row(row), slope_y.row(row),
            sum_gkh.row(row), sum_gk.row(row),  sum_gh.row(row),
            nullptr,          nullptr,          inside};
  }
};

/// What the plane filter's stages need, made once from a room: its disc has a radius of sigma_s.
class PlaneInput {
 public:
  static constexpr int kBlockRows = 8;

  PlaneInput(Room room, double sigma_px)
      : room_(std::move(room)),
        sparse_(room_.samples),
        spatial_(sigma_px, sigma_px),
        sigma_px_(static_cast<float>(sigma_px)),
        spacing_(*MeasureSpacing(room_.samples)),
        guide_(room_.guide.width(), room_.guide.height()),
        planes_(LevelPlanes(sparse_, room_.samples)),
        slopes_(SlopesOnGrid(sparse_, room_.samples, planes_)) {
    for (std::size_t i = 0; i < guide_.size(); ++i)
      guide_.values()[i] = static_cast<float>(room_.guide.values()[i].g);
    at_samples_ = sparse_.ValuesAt(guide_);
  }
  PlaneInput(const PlaneInput&) = delete;
  PlaneInput& operator=(const PlaneInput&) = delete;

  const AlignedSamples& samples() const { return room_.samples; }
  const SparseDepthMap& sparse() const { return sparse_; }
  const std::vector<SamplePlane>& planes() const { return planes_; }

  PlaneFilter filter(int iterations) const {
    PlaneFilter filter{sparse_,
                       planes_,
                       spatial_,
                       {&guide_, &guide_, &guide_},
                       {at_samples_, at_samples_, at_samples_}};
    filter.sigma_spatial_px = sigma_px_;
    filter.iterations = iterations;
    return filter;
  }

  /// Calls body(top, bottom) for each block of rows.
  template <class Body>
  void ForEachBlock(const RunContext& context, const Body& body) const {
    ParallelFor((sparse_.height() + kBlockRows - 1) / kBlockRows, context, [&](int block) {
      body(block * kBlockRows, std::min((block + 1) * kBlockRows, sparse_.height()));
    });
  }

  /// The samples' planes, from all candidates with four passes.
  void FitPlanes(const RunContext& context) {
    ForEachBlock(context, [&](int top, int bottom) {
      FitSamplePlanes(filter(4), slopes_, top, bottom, planes_);
    });
  }
  Result<MaskImage> InsideCells(const RunContext& context) const {
    return InsideConnectedCells(sparse_, room_.samples, planes_, spacing_, 0.050, context);
  }
  SupportModel Support() const {
    const double weight = 4.0 * sigma_px_ * sigma_px_;
    return {sparse_,
            planes_,
            {spacing_.along_line_px, spacing_.between_lines_px},
            0.040,
            weight / (spacing_.along_line_px * spacing_.between_lines_px)};
  }

 private:
  Room room_;
  SparseDepthMap sparse_;
  SpatialKernel spatial_;
  float sigma_px_;
  SampleSpacing spacing_;
  FloatImage guide_;
  std::vector<float> at_samples_;
  std::vector<SamplePlane> planes_;
  std::vector<SlopeCandidates> slopes_;
};

}  // namespace foresight
