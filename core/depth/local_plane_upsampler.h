#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "core/depth/changed_samples.h"
#include "core/depth/lab_image.h"
#include "core/depth/local_plane.h"
#include "core/depth/measured_support.h"
#include "core/depth/plane_filter.h"

namespace foresight {

/// Local planes for samples that come bit by bit: keeps what it found, and after each change finds
/// again what the changed samples can influence. What it hands out never depends on the way there:
/// it equals the answer to the last samples alone in every bit.
///
/// With R = radius_in_sigmas * sigma_s, in rows of the image:
///   a sample's plane      its disc: changed samples within R; and its slopes, which its neighbours
///                         on the lidar's grid decide, wherever these are seen
///   a pixel's plane       its disc: samples within R that changed or whose plane changed
///   a pixel's confidence  as well the samples within reach of MeasureSupport, and the connected
///                         cells that it lies in
/// A cell changes with its corners and their planes, within three spacings. Slopes are made anew
/// each time, being cheap, and compared. Rows are filtered again in
/// whole blocks of eight. An automatic sigma_s or spacing follows the measured density: where that
/// changes, all is done again; fix both to gain anything.
class LocalPlaneUpsampler {
 public:
  /// The guide must outlive this. Options that Check() refuses make each Update fail.
  LocalPlaneUpsampler(const ColorImage& guide, const LocalPlaneOptions& options)
      : guide_(guide), options_(options) {}

  /// Keeps what each confidence is computed from, too: of pixels with a depth. From the first
  /// Update on; `terms` must outlive this.
  void KeepTerms(SupportTermImages& terms) { terms_ = &terms; }

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
  /// What the dense map was made from.
  struct Cached {
    MappedSamples samples;
    SampleSpacing spacing;
    double sigma_px;
    SpatialKernel spatial;
    std::array<std::vector<float>, 3> sample_lab = {};
    std::vector<SlopeCandidates> slopes = {};
    std::vector<SamplePlane> planes = {};
    MaskImage inside = {};  ///< connected cells

    bool SameWindow(const Cached& other) const;
  };

  Result<Cached> Describe(const AlignedSamples& samples, const RunContext& context) const;
  PlaneFilter FilterOf(const Cached& cached) const;
  Status FindPlanes(const Cached* before, const SampleChange& change, Cached& now,
                    const RunContext& context) const;
  Status FindCells(const Cached* before, const SampleChange& change, Cached& now,
                   const RunContext& context) const;
  void Reset(double sigma_px);
  Status FilterPixels(const Cached* before, const SampleChange& change, const Cached& now,
                      const RunContext& context);

  const ColorImage& guide_;
  LocalPlaneOptions options_;
  LabImage lab_;                  ///< of the guide, from the first Update on
  std::optional<Cached> cached_;  ///< none = nothing can be kept
  DenseDepth dense_;
  SupportTermImages* terms_ = nullptr;
  int filtered_rows_ = 0;
};

}  // namespace foresight
