#include "core/depth/pipeline.h"

#include <chrono>

namespace foresight {
namespace {

Result<DenseDepth> Densify(const AlignedSamples& samples, const ColorImage& guide,
                           const DepthOptions& options, const RunContext& context) {
  switch (options.method) {
    case DepthMethod::kForesight:
      return UpsampleLocalPlanes(samples, guide, options.local_plane, context);
    case DepthMethod::kPaper:
    case DepthMethod::kJointBilateral:
      return UpsampleDepth(samples, guide, options.upsample, context);
    case DepthMethod::kTgv:
      return UpsampleTgv(samples, guide, options.tgv, context);
    case DepthMethod::kNonlocal:
      return UpsampleNonlocal(samples, guide, options.nonlocal, context);
  }
  throw ContractViolation("method", "every method has its case", __FILE__, __LINE__);
}

}  // namespace

Status DepthOptions::Check() const {
  FORESIGHT_CHECK(flying.Check());
  FORESIGHT_CHECK(isolated.Check());
  FORESIGHT_CHECK(flipping.Check());
  FORESIGHT_CHECK(upsample.Check());
  FORESIGHT_CHECK(local_plane.Check());
  FORESIGHT_CHECK(tgv.Check());
  FORESIGHT_CHECK(nonlocal.Check());
  return mask.Check();
}

Status RejectOutliers(AlignedSamples& samples, const DepthOptions& options,
                      const RunContext& context) {
  context.Report(0.0, "rejecting outliers");
  FORESIGHT_CHECK(RejectFlying(samples, options.flying));
  FORESIGHT_CHECK(RejectIsolated(samples, options.isolated));
  return RejectFlipping(samples, options.flipping, context);
}

Result<DepthResult> ComputeDepth(AlignedSamples samples, const ColorImage& guide,
                                 const DepthOptions& options, const RunContext& context) {
  const auto start = std::chrono::steady_clock::now();
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_CHECK(samples.Check());
  FORESIGHT_CHECK(RejectOutliers(samples, options, context));

  DepthResult result;
  result.options = options;
  FORESIGHT_TRY(result.dense, Densify(samples, guide, options, context.Part(0.1, 1.0)));
  FORESIGHT_TRY(result.mask, MaskLowConfidence(result.dense, options.mask));
  result.density = LocalDensity(samples);
  result.samples = std::move(samples);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

Result<DepthResult> ComputeDepthInFrame(const RegisteredScan& scan, const SensorRig& rig,
                                        const CameraFrame& frame, const DepthOptions& options,
                                        const RunContext& context) {
  FORESIGHT_TRY(AlignedSamples samples,
                AlignToImage(scan, rig, frame.motor_angle_rad, context.Part(0.0, 0.1)));
  FORESIGHT_TRY(DepthResult result,
                ComputeDepth(std::move(samples), frame.image, options, context.Part(0.1, 1.0)));
  result.image_seq = frame.seq;
  return result;
}

}  // namespace foresight
