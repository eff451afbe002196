#pragma once

#include "core/depth/aligned_samples.h"
#include "core/depth/local_plane.h"
#include "core/depth/nonlocal.h"
#include "core/depth/reject_flipping.h"
#include "core/depth/reject_flying.h"
#include "core/depth/reject_isolated.h"
#include "core/depth/tgv.h"
#include "core/depth/upsample.h"
#include "core/sensor/camera_frame.h"
#include "core/sensor/scan_plan.h"

namespace foresight {

/// How the dense map is made from the samples. depth_method.h has names and defaults.
enum class DepthMethod {
  kForesight,       ///< local planes, rejection with a margin, absolute confidence
  kPaper,           ///< Section IV of the paper
  kJointBilateral,  ///< [7] Kopf et al. 2007
  kTgv,             ///< Ferstl et al. 2013
  kNonlocal,        ///< Park et al. 2011
};

struct DepthOptions {
  DepthMethod method = DepthMethod::kPaper;
  FlyingPointOptions flying;
  IsolatedPointOptions isolated;
  FlippingPointOptions flipping;
  UpsampleOptions upsample;  ///< of the joint filters
  LocalPlaneOptions local_plane;
  TgvOptions tgv;
  NonlocalOptions nonlocal;
  ConfidenceMaskOptions mask;

  Status Check() const;
};

/// Everything the pipeline made on the way, so that any stage can be looked at.
struct DepthResult {
  DepthOptions options;         ///< that it was made with
  std::int64_t image_seq = -1;  ///< CameraFrame::seq of the image; -1 = not an image of a head
  AlignedSamples samples;       ///< with the reason of each rejection
  DenseDepth dense;
  MaskImage mask;
  double density = 0.0;  ///< LocalDensity of the samples
  double seconds = 0.0;

  /// Fewer samples than the paper wants: there is a depth map, but it is not to be trusted.
  bool BelowDensityFloor() const { return density < ScanPrediction::kMinDensity; }
};

/// The three rejections in their order; samples that are rejected already stay so. Fails as they
/// do.
Status RejectOutliers(AlignedSamples& samples, const DepthOptions& options,
                      const RunContext& context);

/// Section IV from the aligned samples to the mask; calls the stages in their order and nothing
/// else.
Result<DepthResult> ComputeDepth(AlignedSamples samples, const ColorImage& guide,
                                 const DepthOptions& options, const RunContext& context);

/// The depth map of one of the head's images: AlignToImage at the image's own angle, then
/// ComputeDepth. Fails as these do.
Result<DepthResult> ComputeDepthInFrame(const RegisteredScan& scan, const SensorRig& rig,
                                        const CameraFrame& frame, const DepthOptions& options,
                                        const RunContext& context);

}  // namespace foresight
