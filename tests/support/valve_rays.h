#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/fitting/ray_set.h"
#include "core/fitting/valve/valve_detection.h"

namespace foresight::samples {

/// A wheel in front of a wall as a lidar sees it, by tracing spheres through distance functions: it
/// shares no geometry with the fit's closed forms.
struct ValveView {
  ValveModel model;
  double distance_m = 1.3;
  double view_rad = 0.3;       ///< between the wheel's axis and the line of sight
  double turn_rad = 0.2;       ///< of the wheel around its axis
  double wall_m = 0.12;        ///< from the rim's plane back to the wall
  double wall_turn_rad = 0.0;  ///< of the wall about x: near 90 deg it is a floor, wall_m below
  /// kRing: the rim alone, before a pipe along x that goes on beyond it.
  enum class Object { kWheel, kNothing, kBox, kBall, kRing } object = Object::kWheel;
  bool pipe = true;                  ///< a pipe runs along the wall beside the wheel
  double half_angle_rad = 0.0;       ///< of the region; 0 = a third more than the rim
  double line_spacing_rad = 0.0087;  ///< 0.5 deg
  double beam_spacing_rad = 0.0044;  ///< 0.25 deg
  double footprint_rad = 0.0044;
  double sigma_m = 0.010;
  double spurious_fraction = 0.005;
  std::uint64_t seed = 1;
};

struct ValveScene {
  RaySet rays;
  ValveCandidate truth;
};

namespace valve_rays_internal {

inline double CapsuleDistance(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                              const Eigen::Vector3d& b, double radius) {
  const Eigen::Vector3d along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).norm() - radius;
}

/// Distance of a point in the object's frame to anything.
inline double SceneDistance(const ValveView& view, const Eigen::Vector3d& p) {
  double distance =
      std::sin(view.wall_turn_rad) * p.y() + std::cos(view.wall_turn_rad) * p.z() + view.wall_m;
  const double far = view.model.rim_radius_m;
  if (view.pipe)
    distance = std::min(distance, CapsuleDistance(p, {-1.0, 0.8 * far, -view.wall_m + 0.03},
                                                  {1.0, 0.9 * far, -view.wall_m + 0.03}, 0.025));
  if (view.object == ValveView::Object::kNothing) return distance;
  if (view.object == ValveView::Object::kBall)
    return std::min(distance, p.norm() - view.model.rim_radius_m);
  if (view.object == ValveView::Object::kBox) {
    const Eigen::Vector3d half(far, 0.7 * far, 0.5 * view.wall_m);
    const Eigen::Vector3d q = (p + Eigen::Vector3d(0, 0, half.z())).cwiseAbs() - half;
    return std::min(distance, q.cwiseMax(0.0).norm() + std::min(0.0, q.maxCoeff()));
  }
  if (view.object == ValveView::Object::kRing) {
    const Eigen::Vector3d begin(-1.0, 0.0, -view.model.dish_m), end(1.0, 0.0, -view.model.dish_m);
    const double ring = std::hypot(p.head<2>().norm() - far, p.z()) - view.model.tube_radius_m;
    return std::min({distance, ring, CapsuleDistance(p, begin, end, view.model.spoke_radius_m)});
  }
  const Eigen::Vector3d hub(0.0, 0.0, -view.model.dish_m);
  const Eigen::Vector3d foot(0.0, 0.0, -view.wall_m);
  distance = std::min(distance, CapsuleDistance(p, hub, foot, 0.011));
  return std::min(distance, view.model.Distance(p));
}

inline double Trace(const ValveView& view, const Eigen::Vector3d& origin,
                    const Eigen::Vector3d& direction) {
  double t = std::max(0.0, origin.norm() - 1.5 * view.model.rim_radius_m - 0.2);
  for (int step = 0; step < 200; ++step) {
    const double distance = SceneDistance(view, origin + t * direction);
    if (distance < 1e-4) return t;
    t += distance;
    if (t > 20.0) break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace valve_rays_internal

/// The view's rays in base and the truth in them. A beam is five rays; where they intersect
/// surfaces at different ranges the return comes from one of them or, once in three, from between.
inline ValveScene MakeValveScene(const ValveView& view) {
  Random random(view.seed, 77);
  const Eigen::Vector3d center(0.1, -0.05, view.distance_m);
  const Eigen::Vector3d to_viewer = -center.normalized();
  const double tilt_way = random.Uniform(0.0, 6.283185307179586);
  const Eigen::Vector3d across = to_viewer.unitOrthogonal();
  const Eigen::Vector3d hinge = Eigen::AngleAxisd(tilt_way, to_viewer) * across;
  const Eigen::Vector3d axis = Eigen::AngleAxisd(view.view_rad, hinge) * to_viewer;
  const Eigen::Vector3d x = Eigen::AngleAxisd(view.turn_rad, axis) * axis.unitOrthogonal();
  Eigen::Matrix3d rotation;
  rotation << x, axis.cross(x), axis;

  ValveScene scene;
  scene.truth = {Rigid<frame::Base, frame::Object>(rotation, center), view.model, 0.0};
  scene.rays.sigma_m = view.sigma_m;
  scene.rays.footprint_rad = view.footprint_rad;
  const auto object_from_base = scene.truth.base_from_object.Inverse();
  const Eigen::Vector3d origin = object_from_base * Eigen::Vector3d::Zero().eval();
  const double half = view.half_angle_rad > 0.0 ? view.half_angle_rad
                                                : 1.35 * view.model.rim_radius_m / view.distance_m;
  const double azimuth = std::atan2(center.x(), center.z());
  const double elevation = std::atan2(center.y(), std::hypot(center.x(), center.z()));
  const auto direction_of = [](double az, double el) {
    return Eigen::Vector3d(std::cos(el) * std::sin(az), std::sin(el), std::cos(el) * std::cos(az));
  };
  const double phase_az = random.Uniform();
  const double phase_el = random.Uniform();
  const int lines = static_cast<int>(half / view.line_spacing_rad);
  const int beams = static_cast<int>(half / view.beam_spacing_rad);
  for (int line = -lines; line <= lines; ++line) {
    const double jitter = 0.0005 * random.Normal();  // 0.03 deg of encoder
    for (int beam = -beams; beam <= beams; ++beam) {
      const double az = azimuth + (beam + phase_az) * view.beam_spacing_rad;
      const double el = elevation + (line + phase_el) * view.line_spacing_rad;
      std::array<double, 5> ranges;
      const double off = 0.35 * view.footprint_rad;
      const std::array<Eigen::Vector2d, 5> offsets = {
          Eigen::Vector2d(0, 0), {off, off}, {-off, off}, {off, -off}, {-off, -off}};
      for (std::size_t i = 0; i < ranges.size(); ++i)
        ranges[i] =
            valve_rays_internal::Trace(view, origin,
                                       object_from_base.Rotate(direction_of(
                                           az + offsets[i].x(), el + jitter + offsets[i].y())));
      const auto [low, high] = std::minmax_element(ranges.begin(), ranges.end());
      double range = ranges[static_cast<std::size_t>(random.Index(5))];
      if (*high - *low > 0.03 && random.Uniform() < 0.35) range = random.Uniform(*low, *high);
      range += view.sigma_m * random.Normal();
      if (random.Uniform() < view.spurious_fraction) range = random.Uniform(0.3, view.distance_m);
      scene.rays.rays.push_back(
          {Eigen::Vector3d::Zero(), direction_of(az, el), range, {beam + beams, line + lines}});
    }
  }
  return scene;
}

/// How far a fitted valve is from the truth.
struct ValveError {
  double center_m = 0.0;
  double axis_rad = 0.0;
  double radius_m = 0.0;
  double phase_rad = 0.0;  ///< modulo the spokes' symmetry
  bool spokes_right = false;
};

inline ValveError CompareValves(const ValveCandidate& found, const ValveCandidate& truth) {
  const auto& a = found.base_from_object;
  const auto& b = truth.base_from_object;
  ValveError error;
  error.center_m = (a.translation() - b.translation()).norm();
  error.axis_rad = std::acos(std::clamp(
      a.Rotate(Eigen::Vector3d::UnitZ()).dot(b.Rotate(Eigen::Vector3d::UnitZ())), -1.0, 1.0));
  error.radius_m = std::abs(found.model.rim_radius_m - truth.model.rim_radius_m);
  error.spokes_right = found.model.spokes == truth.model.spokes;
  if (truth.model.spokes > 0) {
    const Eigen::Vector3d x = (b.Inverse() * a).Rotate(Eigen::Vector3d::UnitX());
    const double sector = 6.283185307179586 / truth.model.spokes;
    error.phase_rad = std::abs(std::remainder(std::atan2(x.y(), x.x()), sector));
  }
  return error;
}

/// A wheel drawn at random from what is built: 95 to 200 mm rims, 2 to 6 spokes, 0.8 to 2 m away.
inline ValveView RandomValveView(std::uint64_t seed) {
  Random random(seed, 5);
  ValveView view;
  view.seed = seed;
  view.model.rim_radius_m = random.Uniform(0.095, 0.200);
  view.model.tube_radius_m = random.Uniform(0.009, 0.016);
  view.model.spoke_radius_m = random.Uniform(0.006, 0.011);
  view.model.hub_radius_m = random.Uniform(0.15, 0.30) * view.model.rim_radius_m;
  view.model.dish_m = random.Uniform(0.0, 0.050);
  view.model.spokes = 2 + random.Index(5);
  view.distance_m = random.Uniform(0.8, 2.0);
  view.view_rad = random.Uniform(0.0, 0.70);
  view.turn_rad = random.Uniform(0.0, 6.283185307179586);
  view.wall_m = random.Uniform(0.08, 0.20);
  view.pipe = random.Uniform() < 0.7;
  return view;
}

}  // namespace foresight::samples
