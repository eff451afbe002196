#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/depth/aligned_samples.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr int kBlockLines = 16;

/// The returns of one line that lie in the image, in the order of the beams.
void AppendLine(const RegisteredScan& scan, int line, const CameraModel& camera,
                const Rigid<frame::Camera, frame::Base>& camera_from_base,
                std::vector<AlignedSample>& samples) {
  for (int beam = 0; beam < scan.beams; ++beam) {
    if (!scan.Valid(line, beam)) continue;
    const Eigen::Vector3d in_base = scan.points[scan.Index(line, beam)].cast<double>();
    const Eigen::Vector3d point = camera_from_base * in_base;
    if (!AlignedSamples::IsDepth(static_cast<float>(point.z()))) continue;
    const auto pixel = camera.Project(point);
    if (!pixel) continue;
    // As it will be kept: a pixel just inside the edge may round to one that is outside.
    const Eigen::Vector2f kept = pixel->cast<float>();
    if (!camera.InImage(kept.cast<double>())) continue;
    AlignedSample sample;
    sample.u = kept.x();
    sample.v = kept.y();
    sample.depth_m = static_cast<float>(point.z());
    sample.line = line;
    sample.beam = beam;
    sample.point = point.cast<float>();
    samples.push_back(sample);
  }
}

}  // namespace

Status AlignMoreLines(const RegisteredScan& scan, int first_line, const SensorRig& rig,
                      double motor_rad, AlignedSamples& aligned, const RunContext& context) {
  FORESIGHT_CHECK(rig.Check());
  if (!std::isfinite(motor_rad))
    return Fail(ErrorCode::kInvalidInput, "alignment: the image has no motor angle");
  const Rigid<frame::Camera, frame::Base> camera_from_base = rig.CameraFromBase(motor_rad);
  aligned.motor_rad = motor_rad;
  aligned.width = rig.camera.width;
  aligned.height = rig.camera.height;
  aligned.lines = scan.lines;
  aligned.beams = scan.beams;
  aligned.rays = RaysOf(rig.camera);
  const int more = std::max(0, scan.lines - first_line);
  const int blocks = (more + kBlockLines - 1) / kBlockLines;
  std::vector<std::vector<AlignedSample>> found(static_cast<std::size_t>(blocks));
  const bool finished = ParallelFor(blocks, context, [&](int block) {
    const int first = first_line + block * kBlockLines;
    const int last = std::min(first + kBlockLines, scan.lines);
    for (int line = first; line < last; ++line)
      AppendLine(scan, line, rig.camera, camera_from_base, found[static_cast<std::size_t>(block)]);
    context.Report(static_cast<double>(last) / scan.lines, "projecting into the image");
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "alignment was cancelled");
  for (const std::vector<AlignedSample>& block : found)
    aligned.samples.insert(aligned.samples.end(), block.begin(), block.end());
  aligned.reasons.resize(aligned.samples.size(), RejectReason::kKept);
  return {};
}

Result<AlignedSamples> AlignToImage(const RegisteredScan& scan, const SensorRig& rig,
                                    double motor_rad, const RunContext& context) {
  AlignedSamples aligned;
  FORESIGHT_CHECK(AlignMoreLines(scan, 0, rig, motor_rad, aligned, context));
  if (aligned.samples.empty())
    return Fail(
        ErrorCode::kTooFewPoints,
        "no lidar return lies in the image taken at {:.1f} deg; scan a scope that covers it",
        DegreesFromRadians(motor_rad));
  return aligned;
}

}  // namespace foresight
