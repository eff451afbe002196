#pragma once

#include <variant>
#include <vector>

#include "core/depth/joint_upsampler.h"
#include "core/depth/local_plane_upsampler.h"
#include "core/depth/pipeline.h"

namespace foresight {

/// The options with every length that would follow the measured density fixed at what the plan
/// promises, so that a line more does not change the whole image: sigma_s of both filters and the
/// samples' spacings. What is given already stays. Fails as PredictScan does.
Result<DepthOptions> FixedForPlan(DepthOptions options, const ScanPlan& plan, const SensorRig& rig);

/// The depth map of one image while its scan still runs. Each Update aligns the new lines,
/// rejects among all samples (cheap, and compared with the last time), and filters the rows that
/// they can influence; the rules are in local_plane_upsampler.h and joint_upsampler.h. The result
/// equals ComputeDepthInFrame of the lines so far in every bit (but for the seconds).
///
/// Only kForesight, kPaper and kJointBilateral gain, and only with the lengths fixed, see
/// FixedForPlan; the other methods solve for the whole image each time. One thread at a time.
class LiveDepth {
 public:
  LiveDepth(const SensorRig& rig, CameraFrame frame, const DepthOptions& options);
  LiveDepth(const LiveDepth&) = delete;  // the upsamplers hold on to the image
  LiveDepth& operator=(const LiveDepth&) = delete;

  /// @param scan all lines so far. Lines may also have changed: those from the first one that did
  /// are aligned again (the motor's angle at the last beams is known a moment later). Fails as
  /// ComputeDepthInFrame does; the next Update is as right as after a success.
  Result<DepthResult> Update(const RegisteredScan& scan, const RunContext& context);

  /// How many of the image's rows the last Update filtered.
  int filtered_rows() const { return filtered_rows_; }

 private:
  Status AlignNewLines(const RegisteredScan& scan, const RunContext& context);
  Result<DenseDepth> Densify(const AlignedSamples& samples, const RunContext& context);

  SensorRig rig_;
  CameraFrame frame_;
  DepthOptions options_;
  RegisteredScan seen_;     ///< the points that aligned_ was made from
  AlignedSamples aligned_;  ///< none rejected
  std::variant<std::monostate, LocalPlaneUpsampler, JointUpsampler> upsampler_;
  int filtered_rows_ = 0;
};

}  // namespace foresight
