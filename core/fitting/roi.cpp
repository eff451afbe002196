#include "core/fitting/roi.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foresight {
namespace {

constexpr double kMinSize_px = 4.0;

bool OnSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * along).squaredNorm() < 1e-12;
}

}  // namespace

ImageRoi ImageRoi::Rectangle(double motor_rad, const Eigen::Vector2d& corner_a,
                             const Eigen::Vector2d& corner_b) {
  const Eigen::Vector2d low = corner_a.cwiseMin(corner_b);
  const Eigen::Vector2d high = corner_a.cwiseMax(corner_b);
  return {motor_rad, {low, {high.x(), low.y()}, high, {low.x(), high.y()}}};
}

ImageRoi ImageRoi::AroundTwoClicks(double motor_rad, const Eigen::Vector2d& click_a,
                                   const Eigen::Vector2d& click_b) {
  constexpr int kCorners = 32;
  constexpr double kWider = 1.3;
  const Eigen::Vector2d middle = 0.5 * (click_a + click_b);
  const double radius = 0.5 * kWider * (click_a - click_b).norm();
  ImageRoi roi{motor_rad, {}};
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    roi.polygon.push_back(middle + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return roi;
}

bool ImageRoi::Contains(const Eigen::Vector2d& pixel) const {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[j];
    if (OnSegment(pixel, a, b)) return true;
    if ((a.y() > pixel.y()) == (b.y() > pixel.y())) continue;
    const double crossing = a.x() + (pixel.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (pixel.x() < crossing) inside = !inside;
  }
  return inside;
}

PixelBox ImageRoi::Bounds() const {
  PixelBox box;
  if (polygon.empty()) return box;
  box.low = box.high = polygon.front();
  for (const Eigen::Vector2d& corner : polygon) {
    box.low = box.low.cwiseMin(corner);
    box.high = box.high.cwiseMax(corner);
  }
  return box;
}

Status ImageRoi::Check() const {
  if (!std::isfinite(motor_rad))
    return Fail(ErrorCode::kInvalidInput, "region: its motor angle is not a number");
  if (polygon.size() < 3)
    return Fail(ErrorCode::kInvalidInput, "region: {} corners, needs at least 3", polygon.size());
  for (const Eigen::Vector2d& corner : polygon)
    if (!corner.allFinite())
      return Fail(ErrorCode::kInvalidInput, "region: corner ({}, {}) is not a pixel", corner.x(),
                  corner.y());
  const Eigen::Vector2d size = Bounds().high - Bounds().low;
  if (size.minCoeff() < kMinSize_px)
    return Fail(ErrorCode::kInvalidInput,
                "region: {:.1f} x {:.1f} px is too small, draw at least 4", size.x(), size.y());
  return {};
}

bool BoxRoi::Contains(const Eigen::Vector3d& point_in_base) const {
  const Eigen::Vector3d in_box = base_from_box.Inverse() * point_in_base;
  return (in_box.cwiseAbs().array() <= 0.5 * size_m.array()).all();
}

bool BoxRoi::Crosses(const Eigen::Vector3d& from_in_base, const Eigen::Vector3d& to_in_base) const {
  const Rigid<frame::Object, frame::Base> box_from_base = base_from_box.Inverse();
  const Eigen::Vector3d from = box_from_base * from_in_base;
  const Eigen::Vector3d way = box_from_base * to_in_base - from;
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * size_m[axis];
    if (std::abs(way[axis]) < 1e-12) {
      if (std::abs(from[axis]) > half) return false;
      continue;
    }
    const double a = (-half - from[axis]) / way[axis], b = (half - from[axis]) / way[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

Status BoxRoi::Check() const {
  constexpr double kMinSide_m = 0.01, kMaxSide_m = 100.0;
  if (!base_from_box.translation().allFinite() || !base_from_box.rotation().coeffs().allFinite())
    return Fail(ErrorCode::kInvalidInput, "region: the box's pose is not finite");
  if (!(size_m.minCoeff() >= kMinSide_m) || !(size_m.maxCoeff() <= kMaxSide_m))
    return Fail(ErrorCode::kInvalidInput,
                "region: a box of {} x {} x {} m; each side is {} to {} m", size_m.x(), size_m.y(),
                size_m.z(), kMinSide_m, kMaxSide_m);
  return {};
}

Status CheckRoi(const Roi& roi) {
  return std::visit([](const auto& region) { return region.Check(); }, roi);
}

}  // namespace foresight
