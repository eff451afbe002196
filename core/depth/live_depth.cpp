#include "core/depth/live_depth.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

/// The first line of `now` that was not in `before`, or looked different there.
int FirstNewLine(const RegisteredScan& before, const RegisteredScan& now) {
  if (before.beams != now.beams) return 0;
  const auto beams = static_cast<std::size_t>(now.beams);
  const int common = std::min(before.lines, now.lines);
  for (int line = 0; line < common; ++line) {
    const std::size_t i = now.Index(line, 0);
    // Bytes, as a beam without a return is NaN.
    const auto same = [&](const auto& a, const auto& b) {
      return std::memcmp(a.data() + i, b.data() + i, beams * sizeof(a[0])) == 0;
    };
    if (!same(before.points, now.points) || !same(before.range_m, now.range_m)) return line;
  }
  return common;
}

}  // namespace

Result<DepthOptions> FixedForPlan(DepthOptions options, const ScanPlan& plan,
                                  const SensorRig& rig) {
  FORESIGHT_TRY(const ScanPrediction predicted, PredictScan(plan, rig));
  const auto fix = [](double& length_px, double predicted_px) {
    if (length_px == 0.0) length_px = predicted_px;
  };
  const double along_line_px = std::max(1.0, predicted.beam_spacing_px);
  const double between_lines_px = std::max(1.0, predicted.line_spacing_px);
  fix(options.upsample.sigma_spatial_px, predicted.sigma_spatial_px);
  fix(options.local_plane.sigma_spatial_px, LocalPlaneSigmaForDensity(predicted.density));
  fix(options.local_plane.along_line_px, along_line_px);
  fix(options.local_plane.between_lines_px, between_lines_px);
  fix(options.isolated.along_line_px, along_line_px);
  fix(options.isolated.between_lines_px, between_lines_px);
  return options;
}

LiveDepth::LiveDepth(const SensorRig& rig, CameraFrame frame, const DepthOptions& options)
    : rig_(rig), frame_(std::move(frame)), options_(options) {
  if (options.method == DepthMethod::kForesight)
    upsampler_.emplace<LocalPlaneUpsampler>(frame_.image, options.local_plane);
  if (options.method == DepthMethod::kPaper || options.method == DepthMethod::kJointBilateral)
    upsampler_.emplace<JointUpsampler>(frame_.image, options.upsample);
}

Status LiveDepth::AlignNewLines(const RegisteredScan& scan, const RunContext& context) {
  const int first = FirstNewLine(seen_, scan);
  seen_ = {};  // until the lines are in
  auto& samples = aligned_.samples;
  samples.erase(std::find_if(samples.begin(), samples.end(),
                             [&](const AlignedSample& s) { return s.line >= first; }),
                samples.end());
  aligned_.reasons.resize(samples.size());
  FORESIGHT_CHECK(AlignMoreLines(scan, first, rig_, frame_.motor_angle_rad, aligned_, context));
  seen_ = scan;
  if (samples.empty())
    return Fail(ErrorCode::kTooFewPoints,
                "no return of the {} lidar lines so far lies in the image taken at {:.1f} deg",
                scan.lines, DegreesFromRadians(frame_.motor_angle_rad));
  return {};
}

Result<DenseDepth> LiveDepth::Densify(const AlignedSamples& samples, const RunContext& context) {
  const auto update = [&](auto& upsampler) -> Result<DenseDepth> {
    FORESIGHT_CHECK(upsampler.Update(samples, context));
    filtered_rows_ = upsampler.filtered_rows();
    return upsampler.dense();
  };
  if (auto* planes = std::get_if<LocalPlaneUpsampler>(&upsampler_)) return update(*planes);
  return update(std::get<JointUpsampler>(upsampler_));
}

Result<DepthResult> LiveDepth::Update(const RegisteredScan& scan, const RunContext& context) {
  const auto start = std::chrono::steady_clock::now();
  filtered_rows_ = 0;
  FORESIGHT_CHECK(options_.Check());
  FORESIGHT_CHECK(AlignNewLines(scan, context.Part(0.0, 0.05)));
  if (std::holds_alternative<std::monostate>(upsampler_)) {
    filtered_rows_ = aligned_.height;
    FORESIGHT_TRY(DepthResult all,
                  ComputeDepth(aligned_, frame_.image, options_, context.Part(0.05, 1.0)));
    all.image_seq = frame_.seq;
    return all;
  }
  DepthResult result;
  result.options = options_;
  result.image_seq = frame_.seq;
  result.samples = aligned_;
  FORESIGHT_CHECK(result.samples.Check());
  FORESIGHT_CHECK(RejectOutliers(result.samples, options_, context.Part(0.05, 0.1)));
  FORESIGHT_TRY(result.dense, Densify(result.samples, context.Part(0.1, 1.0)));
  FORESIGHT_TRY(result.mask, MaskLowConfidence(result.dense, options_.mask));
  result.density = LocalDensity(result.samples);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace foresight
