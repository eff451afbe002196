#include "core/measure/pick_point.h"

#include <cmath>
#include <limits>

#include "core/detection/fit_in_scan.h"
#include "core/fitting/range_noise.h"

namespace foresight {
namespace {

/// A point that lies this much further than the nearest one within reach is hidden by it.
constexpr double kHiddenBehind = 0.03;
constexpr double kHiddenBehind_m = 0.10;
/// The noise is told from the returns in a box of this size.
constexpr double kNoiseBox_m = 0.3;

double SigmaAround(const RegisteredScan& cloud, const SensorRig& rig,
                   const Eigen::Vector3d& in_base) {
  BoxRoi box;
  box.base_from_box = Rigid<frame::Base, frame::Object>(Eigen::Quaterniond::Identity(), in_base);
  box.size_m = Eigen::Vector3d::Constant(kNoiseBox_m);
  const auto rays = RaysInScan({rig, cloud}, FitSource::kRaw, box);
  return rays ? EstimateRangeSigma(*rays) : std::nan("");
}

}  // namespace

void ClickChoice::Offer(std::size_t index, const Eigen::Vector3d& point) {
  const Eigen::Vector4d clip = click_.clip_from_robot * point.homogeneous();
  if (!(clip.w() > 0.0)) return;
  const Eigen::Vector2d off = (clip.head<2>() / clip.w() - click_.at).cwiseQuotient(click_.reach);
  if (!(off.squaredNorm() <= 1.0)) return;
  if (click_.shown && !click_.shown(point)) return;
  candidates_.push_back({index, clip.w(), off.squaredNorm()});
  nearest_m_ = std::min(nearest_m_, clip.w());
}

std::optional<std::size_t> ClickChoice::Best() const {
  const double farthest_m = nearest_m_ * (1.0 + kHiddenBehind) + kHiddenBehind_m;
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates_)
    if (candidate.distance_m <= farthest_m && (best == nullptr || candidate.beside < best->beside))
      best = &candidate;
  return best == nullptr ? std::nullopt : std::optional(best->index);
}

MeasuredPoint ReturnAt(const RegisteredScan& cloud, const SensorRig& rig,
                       const std::string& scan_uuid, std::size_t index) {
  MeasuredPoint point;
  point.scan_uuid = scan_uuid;
  point.line = static_cast<int>(index / static_cast<std::size_t>(cloud.beams));
  point.beam = static_cast<int>(index % static_cast<std::size_t>(cloud.beams));
  const Eigen::Vector3d in_base = cloud.points[index].cast<double>();
  point.position_m = rig.robot_from_base * in_base;
  point.range_m = static_cast<double>(cloud.range_m[index]);
  const Eigen::Vector3d origin =
      cloud.origins.empty() ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                            : cloud.origins[static_cast<std::size_t>(point.line)].cast<double>();
  point.ray = rig.robot_from_base.Rotate((in_base - origin).normalized());
  point.sigma_m = SigmaAround(cloud, rig, in_base);
  return point;
}

std::optional<MeasuredPoint> PickReturn(const RegisteredScan& cloud, const SensorRig& rig,
                                        const std::string& scan_uuid, const CloudClick& click) {
  ClickChoice choice(click);
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (cloud.points[i].allFinite())
      choice.Offer(i, rig.robot_from_base * cloud.points[i].cast<double>());
  const auto best = choice.Best();
  if (!best) return std::nullopt;
  return ReturnAt(cloud, rig, scan_uuid, *best);
}

std::optional<MeasuredPoint> PickDepth(const DepthImage& depth_m, const MaskImage* mask,
                                       const CameraFrame& frame, const SensorRig& rig,
                                       const std::string& scan_uuid, int image, int u, int v) {
  if (u < 0 || v < 0 || u >= depth_m.width() || v >= depth_m.height()) return std::nullopt;
  const double depth = static_cast<double>(depth_m(u, v));
  if (!std::isfinite(depth) || (mask != nullptr && (*mask)(u, v) == 0)) return std::nullopt;
  const auto slope = rig.camera.UnprojectToPlane({u, v});
  if (!slope) return std::nullopt;
  const auto robot_from_camera =
      rig.robot_from_base * rig.CameraFromBase(frame.motor_angle_rad).Inverse();
  const Eigen::Vector3d in_camera(slope->x() * depth, slope->y() * depth, depth);
  MeasuredPoint picked;
  picked.source = MeasuredPoint::Source::kDepth;
  picked.scan_uuid = scan_uuid;
  picked.image = image;
  picked.pixel = {u, v};
  picked.position_m = robot_from_camera * in_camera;
  picked.range_m = in_camera.norm();
  picked.ray = robot_from_camera.Rotate(in_camera.normalized());
  return picked;
}

std::vector<Eigen::Vector3d> ReturnsWithin(const RegisteredScan& cloud, const SensorRig& rig,
                                           const Eigen::Vector3d& centre, double radius_m) {
  const Eigen::Vector3f in_base = (rig.robot_from_base.Inverse() * centre).cast<float>();
  const auto limit = static_cast<float>(radius_m * radius_m);
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3f& point : cloud.points.span())
    if ((point - in_base).squaredNorm() <= limit)  // false for NaN
      points.push_back(rig.robot_from_base * point.cast<double>());
  return points;
}

}  // namespace foresight
