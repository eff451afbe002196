#pragma once

#include <optional>
#include <vector>

#include "core/base/image.h"
#include "core/depth/aligned_samples.h"
#include "core/depth/row_filter.h"

namespace foresight {

/// Section IV-C. Defaults are the paper's values in the recommended reading (docs/paper_map.md).
struct UpsampleOptions {
  enum class Weights {
    kProduct,  ///< G K H: the reading that reproduces Table I
    kLiteral,  ///< exp(G + K + H) as Eq. (8) prints it
  };
  Weights weights = Weights::kProduct;
  /// The terms of C, Eq. (9): G H or exp(G + H). Unset: the form of the weights.
  std::optional<Weights> confidence_terms;
  ConfidencePasses confidence_passes = ConfidencePasses::kAll;  ///< that Eq. (9) sums over
  double sigma_spatial_px = 0.0;  ///< sigma_s; 0 = from the density, Fig. 6(a)
  double radius_in_sigmas = 1.0;  ///< Omega: a disc of this many sigma_s
  double sigma_intensity = 20.0;  ///< sigma_i, grey levels
  double sigma_depth_m = 0.030;   ///< sigma_d
  int iterations = 5;             ///< passes after D0
  bool keep_iterations = false;   ///< also hand out D0, D1, ...

  Status Check() const;
};

/// A dense depth map with what is known about its trustworthiness.
struct DenseDepth {
  DepthImage depth_m;     ///< metres along z; NaN where no sample supports the pixel
  FloatImage confidence;  ///< C of Eq. (9); 0 where there is no depth
  /// False: the method knows none, and `confidence` is the lidar's coverage, 1 or 0
  /// (LidarCoverage).
  bool has_confidence = true;
  float max_confidence = 0.0f;  ///< the largest in the image
  /// What a pixel amid samples at the image's density that all agree would have; 1 where the
  /// confidence is absolute.
  float nominal_confidence = 1.0f;
  double sigma_spatial_px = 0.0;       ///< the sigma_s that was used
  std::vector<DepthImage> iterations;  ///< D0 .. Dn where asked for
  std::vector<double> mean_change_m;   ///< mean |D(t+1) - D(t)| of each pass, Fig. 6(b)
};

/// Joint filter with rolling guidance, Eq. (8), and its confidence, Eq. (9), in one go: D0 without
/// H, then `iterations` passes in which H compares the sample with the pixel's last depth; C sums
/// G (first pass) and G H of the passes. Pixels are independent. Fails with
/// kInvalidInput when the guide has another size than the samples' image, kTooFewPoints when no
/// sample is kept, kCancelled. O(pixels * samples in Omega * passes).
Result<DenseDepth> UpsampleDepth(const AlignedSamples& samples, const ColorImage& guide,
                                 const UpsampleOptions& options, const RunContext& context);

struct ConfidenceMaskOptions {
  enum class Reference {
    kLargest,  ///< max C in the image, as printed: one dense spot decides for all pixels
    kNominal,  ///< DenseDepth::nominal_confidence
  };
  double threshold = 0.35;  ///< of the reference, Section IV-C.2
  Reference reference = Reference::kLargest;

  bool operator==(const ConfidenceMaskOptions&) const = default;
  Status Check() const;
};

/// 255 where the depth is to be trusted: confidence >= threshold * reference. Pixels without depth
/// are 0.
Result<MaskImage> MaskLowConfidence(const DenseDepth& dense, const ConfidenceMaskOptions& options);

/// The depth with masked pixels set to NaN.
DepthImage ApplyMask(const DepthImage& depth_m, const MaskImage& mask);

/// Luma of ITU-R BT.601, rounded: the intensity I of Eq. (8).
GrayImage ToGray(const ColorImage& image);

}  // namespace foresight
