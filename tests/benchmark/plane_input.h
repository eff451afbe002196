#pragma once

#include <vector>

#include "core/base/parallel.h"
#include "core/depth/plane_filter.h"
#include "core/depth/sample_planes.h"
#include "tests/benchmark/room.h"

namespace foresight {

/// What the plane filter's stages need, made once from a room: its disc has a radius of sigma_s.
class PlaneInput {
 public:
  PlaneInput(Room room, double sigma_px)
      : room_(std::move(room)),
        sparse_(room_.samples),
        spatial_(sigma_px, sigma_px),
        sigma_px_(static_cast<float>(sigma_px)),
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

  /// The samples' planes, from all candidates with four passes.
  void FitPlanes(const RunContext& context) {
    ParallelFor((sparse_.height() + 7) / 8, context, [&](int block) {
      FitSamplePlanes(filter(4), slopes_, 8 * block, std::min(8 * block + 8, sparse_.height()),
                      planes_);
    });
  }

 private:
  Room room_;
  SparseDepthMap sparse_;
  SpatialKernel spatial_;
  float sigma_px_;
  FloatImage guide_;
  std::vector<float> at_samples_;
  std::vector<SamplePlane> planes_;
  std::vector<SlopeCandidates> slopes_;
};

}  // namespace foresight
