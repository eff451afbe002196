#pragma once

#include <cstdint>

#include "core/depth/aligned_samples.h"
#include "core/evaluation/stereo_scene.h"

namespace foresight {

/// How the testbed of Section V-A measures a scene.
struct StereoTestbedOptions {
  int column_step_px = 4;        ///< along a scan line of the left view
  int row_step_px = 12;          ///< between scan lines
  double noise_sigma_m = 0.010;  ///< of the sampled depth
  std::uint64_t seed = 1;

  Status Check() const;
};

/// A scene as the testbed's sensor sees it: noisy samples of the left view's depth moved into the
/// right view, where flipping points and disocclusions arise by themselves.
struct StereoTrial {
  AlignedSamples samples;
  DepthImage truth_m;  ///< of the right view; NaN = unknown
};

/// Fails with kTooFewPoints when no sample lands in the right view.
Result<StereoTrial> MakeStereoTrial(const StereoScene& scene, const StereoTestbedOptions& options);

/// True depth of the right view, NaN = unknown: from its own disparity where the data set has one,
/// what only the right view sees included; else WarpTruthToRight.
DepthImage TruthOfRight(const StereoScene& scene);

/// True depth of the right view as far as the left one tells: the surfaces that the left view knows
/// and both views see, moved into the right one; the nearest surface wins. Between neighbouring
/// left pixels of one surface disparity is linear, so a surface that the right view sees stretched
/// has no cracks. Pixels that no surface covers (disocclusions, unknown regions) are NaN.
DepthImage WarpTruthToRight(const StereoScene& scene);

}  // namespace foresight
