#include "core/fitting/cylinder/cylinder_evidence.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/quantile.h"
#include "core/fitting/beam_model.h"
#include "core/fitting/solids/solid_coverage.h"
#include "core/fitting/solids/solid_tracer.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kGross_m = 0.15;  // further off, it is something else
constexpr double kMadToSigma = 1.4826;
constexpr double kLeastSigma_m = 0.003, kLargestSigma_m = 0.060;
constexpr int kLeastHits = 12;
constexpr double kOnMantle = 0.999;  // of the radius
constexpr double kWhollyOn = 0.9;    // of a footprint

SolidTracer TracerOf(const CylinderState& cylinder) {
  const SolidPart part = cylinder.Part();
  return {{&part, 1}, {}};
}

/// |measured - predicted| over the hits, the gross ones left out.
std::vector<double> Differences(const RaySet& rays, const CylinderState& cylinder) {
  const SolidTracer tracer = TracerOf(cylinder);
  std::vector<double> differences;
  for (const RangeRay& ray : rays.rays) {
    const SolidIntersection intersection = tracer.Intersect(ray, 0.0);
    if (!intersection.Hits()) continue;
    const double difference = std::abs(ray.range_m - intersection.range_m);
    if (difference < kGross_m) differences.push_back(difference);
  }
  return differences;
}

/// Angle about the axis that a sorted-out set of directions spans: the circle less its largest gap.
double ArcOf(std::vector<double> angles) {
  if (angles.size() < 2) return 0.0;
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2.0 * std::numbers::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
  return 2.0 * std::numbers::pi - gap;
}

}  // namespace

double RangeSigmaFrom(const RaySet& rays, const CylinderState& cylinder) {
  const std::vector<double> differences = Differences(rays, cylinder);
  if (std::ssize(differences) < kLeastHits) return std::nan("");
  return std::clamp(kMadToSigma * UpperMedian(differences), kLeastSigma_m, kLargestSigma_m);
}

bool EndsInDrawnBox(const RaySet& rays, const RangeRay& ray, double within_m) {
  return rays.box && rays.box->Crosses(ray.Point() - within_m * ray.direction,
                                       ray.Point() + within_m * ray.direction);
}

CylinderEvidence GatherEvidence(const RaySet& rays, const CylinderState& cylinder) {
  const SolidTracer tracer = TracerOf(cylinder);
  const Eigen::Vector3d x = cylinder.axis.unitOrthogonal(), y = cylinder.axis.cross(x);
  const double agree_m = BeamModel::kAgreeSigmas * SigmaOf(rays, kRoundCylinderBeams);
  CylinderEvidence evidence;
  evidence.rays = static_cast<int>(rays.rays.size());
  evidence.range_sigma_m = rays.sigma_m;
  int inliers = 0, through = 0, in_box = 0;
  std::vector<double> angles;
  const BeamFootprints footprints(rays, {}, CylinderBeams(rays));
  const CoverBeam cover = CoverBy(tracer);
  // A footprint over the outline reads in between, or what is behind, and says nothing of either.
  const auto wholly_on = [&](std::size_t i) {
    const auto coverage = cover(footprints, i);
    return coverage && coverage->fraction > kWhollyOn;
  };
  const bool footprints_known = rays.footprint_height_rad > 0.0;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const RangeRay& ray = rays.rays[i];
    const SolidIntersection intersection = tracer.Intersect(ray, 0.0);
    if (!intersection.Hits() || (footprints_known && !wholly_on(i))) continue;
    const double behind = ray.range_m - intersection.range_m;
    ++evidence.hits;
    if (behind > agree_m) ++through;
    if (std::abs(behind) > agree_m) continue;
    ++inliers;
    if (EndsInDrawnBox(rays, ray, agree_m)) ++in_box;
    const Eigen::Vector3d at = cylinder.FromAxis(ray.origin + intersection.range_m * ray.direction);
    // A hit on an end is at any angle.
    if (at.norm() > kOnMantle * cylinder.radius_m)
      angles.push_back(std::atan2(y.dot(at), x.dot(at)));
  }
  if (evidence.hits == 0) return evidence;
  evidence.inlier_ratio = static_cast<double>(inliers) / evidence.hits;
  evidence.see_through = static_cast<double>(through) / evidence.hits;
  if (rays.box) evidence.in_drawn_box = static_cast<double>(in_box) / std::max(1, inliers);
  evidence.seen_arc_rad = ArcOf(std::move(angles));
  if (auto differences = Differences(rays, cylinder); !differences.empty())
    evidence.residual_mad_m = UpperMedian(std::move(differences));
  return evidence;
}

void SetSigmas(const RaySet& rays, const CylinderState& cylinder, CylinderDetection& detection) {
  constexpr int kInner = 5;  // the ends are not the object's
  constexpr double kStep_m = 0.002;
  constexpr double kReach_m = 0.2;
  const double lever_m = std::max(0.5 * cylinder.length_m, cylinder.radius_m);
  const double steps[kInner] = {kStep_m, kStep_m, kStep_m / lever_m, kStep_m / lever_m, kStep_m};
  std::vector<SolidTracer> moved;
  for (int i = 0; i < kInner; ++i)
    moved.push_back(TracerOf(Retract(cylinder, steps[i] * CylinderStep::Unit(i))));
  const SolidTracer tracer = TracerOf(cylinder);
  const double sigma_m = SigmaOf(rays, kRoundCylinderBeams);
  Eigen::Matrix<double, kInner, kInner> information =
      Eigen::Matrix<double, kInner, kInner>::Identity() * 1e-6;
  for (const RangeRay& ray : rays.rays) {
    const double width_m =
        0.5 * rays.footprint_rad * ray.range_m + kRoundCylinderBeams.edge_error_m;
    const SolidIntersection intersection = tracer.IntersectWithDepth(ray, kReach_m);
    if (intersection.part < 0) continue;
    const bool agrees =
        std::abs(ray.range_m - intersection.range_m) < BeamModel::kAgreeSigmas * sigma_m;
    // A ray that grazes the outline knows where that is, one further in how far the surface is.
    const bool outline = std::abs(intersection.clearance_m) < width_m;
    if (!outline && !(intersection.Hits() && agrees)) continue;
    Eigen::Matrix<double, kInner, 1> slope = Eigen::Matrix<double, kInner, 1>::Zero();
    for (int i = 0; i < kInner; ++i) {
      const SolidIntersection there =
          moved[static_cast<std::size_t>(i)].IntersectWithDepth(ray, kReach_m);
      if (there.part < 0 || (!outline && !there.Hits())) continue;
      slope[i] = (outline ? (there.clearance_m - intersection.clearance_m) / width_m
                          : (there.range_m - intersection.range_m) / sigma_m) /
                 steps[i];
    }
    information += slope * slope.transpose();
  }
  information *= rays.Worth();
  const Eigen::Matrix<double, kInner, kInner> covariance =
      information.ldlt().solve(Eigen::Matrix<double, kInner, kInner>::Identity());
  const auto deviation = [&](int i) { return std::sqrt(std::max(0.0, covariance(i, i))); };
  detection.sigma_across_m = std::max(deviation(0), deviation(1));
  detection.sigma_axis_rad = std::max(deviation(2), deviation(3));
  // How far beside its middle a beam still returns is not known: anywhere on its footprint.
  const double range_m = (cylinder.middle - rays.viewpoint).norm();
  detection.sigma_radius_m =
      std::hypot(deviation(4), 0.5 * rays.footprint_rad * range_m / std::numbers::sqrt3);
  detection.covariance = PoseCovariance::Zero();
  for (const int i : {0, 1})
    detection.covariance(i, i) = detection.sigma_across_m * detection.sigma_across_m;
  for (const int i : {3, 4})
    detection.covariance(i, i) = detection.sigma_axis_rad * detection.sigma_axis_rad;
  for (const int i : {2, 5}) {
    detection.covariance.row(i).setConstant(std::nan(""));
    detection.covariance.col(i).setConstant(std::nan(""));
  }
}

}  // namespace foresight
