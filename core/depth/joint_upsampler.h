#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/depth/changed_samples.h"
#include "core/depth/upsample.h"

namespace foresight {

/// The joint filter for samples that come bit by bit: filters again what the changed samples can
/// influence, and keeps the rest. What it hands out equals the answer to the last samples alone in
/// every bit.
///
/// A pixel sees the samples of its disc, so rows within radius_in_sigmas * sigma_s of a changed
/// sample are filtered again, in whole blocks of eight. An automatic sigma_s follows the measured
/// density: where that changes, all is done again; fix it to gain anything.
class JointUpsampler {
 public:
  /// The guide must outlive this. Options that Check() refuses make each Update fail.
  JointUpsampler(const ColorImage& guide, const UpsampleOptions& options)
      : guide_(guide), options_(options) {}

  /// Fails as UpsampleDepth does; all is done again after a failure. O(samples in all), and
  /// O(pixels
  /// * samples in Omega * passes) of the rows that are filtered.
  Status Update(const AlignedSamples& samples, const RunContext& context);

  /// Of the last Update, where that succeeded.
  const DenseDepth& dense() const { return dense_; }
  /// The same, to keep; the next Update does all again.
  DenseDepth TakeDense() {
    cached_.reset();
    return std::move(dense_);
  }
  /// How many rows the last Update filtered.
  int filtered_rows() const { return filtered_rows_; }

 private:
  void Reset(double sigma_px);
  Status FilterRowsOf(const SparseDepthMap& map, const SpatialKernel& spatial,
                      const std::vector<int>& blocks, const RunContext& context);

  const ColorImage& guide_;
  UpsampleOptions options_;
  GrayImage gray_;                       ///< of the guide, from the first Update on
  std::optional<MappedSamples> cached_;  ///< what dense_ was made from; none = nothing can be kept
  DenseDepth dense_;
  // One place a block: the sums do not depend on which thread came first.
  std::vector<double> change_sums_;   ///< metres; a block's passes side by side
  std::vector<std::int64_t> pixels_;  ///< with a depth, one a block
  int filtered_rows_ = 0;
};

}  // namespace foresight
