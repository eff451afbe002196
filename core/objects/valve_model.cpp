#include "core/objects/valve_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace foresight {
namespace {

/// Distance of a point to a segment.
double SegmentDistance(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                       const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (point - a - t * along).norm();
}

/// Signed distance of a point to an ellipse around the origin: four steps along its evolute, which
/// leave micrometres.
double EllipseDistance(double x, double y, double half_x, double half_y) {
  if (half_x == half_y) return std::hypot(x, y) - half_x;
  x = std::abs(x);
  y = std::abs(y);
  const double squares = half_x * half_x - half_y * half_y;
  Eigen::Vector2d on_circle = Eigen::Vector2d::Constant(std::numbers::sqrt2 / 2.0);
  for (int step = 0; step < 4; ++step) {
    const Eigen::Vector2d evolute(squares * std::pow(on_circle.x(), 3) / half_x,
                                  -squares * std::pow(on_circle.y(), 3) / half_y);
    const Eigen::Vector2d outwards(x - evolute.x(), y - evolute.y());
    const double radius =
        std::hypot(half_x * on_circle.x() - evolute.x(), half_y * on_circle.y() - evolute.y());
    const Eigen::Vector2d nearest = evolute + radius / std::max(outwards.norm(), 1e-12) * outwards;
    on_circle = Eigen::Vector2d(std::clamp(nearest.x() / half_x, 0.0, 1.0),
                                std::clamp(nearest.y() / half_y, 0.0, 1.0));
    on_circle.normalize();
  }
  const double away = std::hypot(x - half_x * on_circle.x(), y - half_y * on_circle.y());
  const bool inside = std::hypot(x / half_x, y / half_y) < 1.0;
  return inside ? -away : away;
}

/// Distance of a point to a spoke of elliptic section with flat ends; y = 0 is the plane of its
/// axis and the wheel's.
double SpokeDistance(const Eigen::Vector3d& point, const Eigen::Vector3d& hub,
                     const Eigen::Vector3d& rim, const ValveModel& model) {
  if (model.spoke_depth_ratio == 1.0)
    return SegmentDistance(point, hub, rim) - model.spoke_radius_m;
  const double length = (rim - hub).norm();
  const Eigen::Vector3d along = (rim - hub) / length;
  const Eigen::Vector3d across = along.cross(Eigen::Vector3d::UnitY());
  const double at = (point - hub).dot(along);
  const double beyond = at - std::clamp(at, 0.0, length);
  const double beside = EllipseDistance(point.y(), (point - hub).dot(across), model.spoke_radius_m,
                                        model.SpokeDepth());
  return beyond == 0.0 ? beside : std::hypot(std::max(beside, 0.0), beyond);
}

Status CheckLever(const ValveModel& lever) {
  if (!std::isfinite(lever.lever_length_m) || !(lever.tube_radius_m > 0.0) ||
      !(lever.tube_radius_m < lever.lever_length_m))
    return Fail(ErrorCode::kInvalidOptions,
                "valve: lever_length_m {} and tube_radius_m {} make no lever", lever.lever_length_m,
                lever.tube_radius_m);
  if (!(lever.hub_radius_m > 0.0) || !std::isfinite(lever.hub_radius_m))
    return Fail(ErrorCode::kInvalidOptions, "valve: hub_radius_m {} is not usable",
                lever.hub_radius_m);
  return {};
}

double LeverDistance(const ValveModel& lever, const Eigen::Vector3d& point) {
  const Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
  const double bar =
      SegmentDistance(point, pivot, lever.lever_length_m * Eigen::Vector3d::UnitX()) -
      lever.tube_radius_m;
  const double stem =
      SegmentDistance(point, pivot, -ValveModel::kLeverStem_m * Eigen::Vector3d::UnitZ()) -
      ValveModel::kLeverStemPerHub * lever.hub_radius_m;
  return std::min({bar, stem, point.norm() - lever.hub_radius_m});
}

Wireframe LeverLines(const ValveModel& lever) {
  const double length = lever.lever_length_m;
  const double half = lever.tube_radius_m;
  std::vector<Eigen::Vector3d> outline;
  constexpr int kCorners = 16;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / kCorners - 0.5);
    outline.emplace_back(length + half * std::cos(angle), half * std::sin(angle), 0.0);
  }
  outline.emplace_back(0.0, half, 0.0);
  outline.emplace_back(0.0, -half, 0.0);
  outline.push_back(outline.front());
  return {outline,
          CircleAroundZ(lever.hub_radius_m, 0.0),
          {{0.0, 0.0, -ValveModel::kLeverStem_m}, {0.0, 0.0, 0.1}}};
}

}  // namespace

const char* ToString(ValveModel::Kind kind) {
  return kind == ValveModel::Kind::kLever ? "lever" : "wheel";
}

Status ValveModel::Check() const {
  if (IsLever()) return CheckLever(*this);
  if (!std::isfinite(rim_radius_m) || !(tube_radius_m > 0.0) || !(tube_radius_m < rim_radius_m))
    return Fail(ErrorCode::kInvalidOptions,
                "valve: rim_radius_m {} and tube_radius_m {} make no wheel", rim_radius_m,
                tube_radius_m);
  if (spokes != 0 && (spokes < 2 || spokes > 6))
    return Fail(ErrorCode::kInvalidOptions, "valve: spokes {} is neither 0 (disc) nor 2 to 6",
                spokes);
  if (!(spoke_radius_m > 0.0) || !(hub_radius_m > 0.0) ||
      !std::isfinite(spoke_radius_m + hub_radius_m + dish_m))
    return Fail(ErrorCode::kInvalidOptions,
                "valve: spoke_radius_m {}, hub_radius_m {} or dish_m {} is not usable",
                spoke_radius_m, hub_radius_m, dish_m);
  if (!(rim_depth_ratio > 0.0) || !(spoke_depth_ratio > 0.0) ||
      !std::isfinite(rim_depth_ratio + spoke_depth_ratio))
    return Fail(ErrorCode::kInvalidOptions,
                "valve: rim_depth_ratio {} or spoke_depth_ratio {} is not usable", rim_depth_ratio,
                spoke_depth_ratio);
  return {};
}

double ValveModel::Distance(const Eigen::Vector3d& point) const {
  if (IsLever()) return LeverDistance(*this, point);
  const double radial = std::hypot(point.x(), point.y());
  double distance = EllipseDistance(radial - rim_radius_m, point.z(), tube_radius_m, RimDepth());
  const Eigen::Vector3d hub(0.0, 0.0, -dish_m);
  distance = std::min(distance, (point - hub).norm() - hub_radius_m);
  if (spokes == 0) {
    // A disc from hub to rim: a cone of the spokes' thickness, measured in the half plane of the
    // point.
    const Eigen::Vector3d in_plane(radial, 0.0, point.z());
    return std::min(distance,
                    SegmentDistance(in_plane, hub, {rim_radius_m, 0.0, 0.0}) - spoke_radius_m);
  }
  // Only the nearest spoke matters: turn the point into the sector around the first one.
  const double sector = 2.0 * std::numbers::pi / spokes;
  const double angle = std::atan2(point.y(), point.x());
  const double turned = angle - sector * std::round(angle / sector);
  const Eigen::Vector3d in_sector(radial * std::cos(turned), radial * std::sin(turned), point.z());
  return std::min(distance, SpokeDistance(in_sector, hub, {rim_radius_m, 0.0, 0.0}, *this));
}

Wireframe WireframeOf(const ValveModel& model) {
  if (model.IsLever()) return LeverLines(model);
  Wireframe lines;
  lines.push_back(CircleAroundZ(model.rim_radius_m + model.tube_radius_m, 0.0));
  lines.push_back(CircleAroundZ(model.rim_radius_m - model.tube_radius_m, 0.0));
  lines.push_back(CircleAroundZ(model.hub_radius_m, -model.dish_m));
  for (int i = 0; i < model.spokes; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / model.spokes;
    lines.push_back(
        {{0.0, 0.0, -model.dish_m},
         {model.rim_radius_m * std::cos(angle), model.rim_radius_m * std::sin(angle), 0.0}});
  }
  lines.push_back({{0.0, 0.0, -model.dish_m}, {0.0, 0.0, 0.1}});
  return lines;
}

}  // namespace foresight
