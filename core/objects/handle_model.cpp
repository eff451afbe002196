#include "core/objects/handle_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foresight {
namespace {

constexpr double kNeckPerLever = 0.9;  // radius of the neck, as a fraction of the lever's

double BarDistance(const HandleBar& bar, const Eigen::Vector3d& point) {
  const Eigen::Vector3d along = bar.to - bar.from;
  const double s = std::clamp((point - bar.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (point - bar.from - s * along).norm() - bar.radius_m;
}

/// Of the plate as a solid of its own thickness.
double PlateDistance(const HandleModel& model, const Eigen::Vector3d& point) {
  const double half = 0.5 * HandleModel::kPlateThickness_m;
  const double beyond_z = std::abs(point.z() + model.standoff_m - half) - half;
  Eigen::Vector2d beyond(point.head<2>().norm() - HandleModel::kRosetteRadius_m, beyond_z);
  if (model.plate == HandleModel::Plate::kLong)
    beyond.x() = std::max(std::abs(point.x()) - 0.5 * HandleModel::kPlateWidth_m,
                          std::abs(point.y()) - 0.5 * HandleModel::kPlateLength_m);
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

/// Of a bar seen along z: two sides and round ends.
std::vector<Eigen::Vector3d> OutlineOf(const HandleModel& model) {
  constexpr int kCorners = 12;
  std::vector<Eigen::Vector3d> outline;
  for (int i = 0; i <= 2 * kCorners; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / kCorners - 0.5);
    const double at = i <= kCorners ? model.length_m : -model.behind_m;
    outline.emplace_back(at + model.radius_m * std::cos(angle), model.radius_m * std::sin(angle),
                         0.0);
    if (i == kCorners) outline.emplace_back(-model.behind_m, model.radius_m, 0.0);
  }
  outline.push_back(outline.front());
  return outline;
}

std::vector<Eigen::Vector3d> PlateOutline(const HandleModel& model) {
  const double z = HandleModel::kPlateThickness_m - model.standoff_m;
  if (model.plate == HandleModel::Plate::kLong) {
    const double x = 0.5 * HandleModel::kPlateWidth_m, y = 0.5 * HandleModel::kPlateLength_m;
    return {{-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}, {-x, -y, z}};
  }
  constexpr int kCorners = 24;
  std::vector<Eigen::Vector3d> circle;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    circle.emplace_back(HandleModel::kRosetteRadius_m * std::cos(angle),
                        HandleModel::kRosetteRadius_m * std::sin(angle), z);
  }
  return circle;
}

}  // namespace

const char* ToString(HandleModel::Plate plate) {
  return plate == HandleModel::Plate::kLong ? "long" : "rosette";
}

Status HandleModel::Check() const {
  const auto usable = [](double size_m) { return size_m > 0.0 && size_m < 1.0; };
  if (!usable(length_m) || !usable(radius_m) || !usable(standoff_m))
    return Fail(ErrorCode::kInvalidOptions,
                "door handle: length_m {}, radius_m {} or standoff_m {} is not within 0 to 1",
                length_m, radius_m, standoff_m);
  if (!(behind_m >= 0.0 && behind_m <= length_m))
    return Fail(ErrorCode::kInvalidOptions,
                "door handle: behind_m {} is not within 0 and length_m {}", behind_m, length_m);
  return {};
}

double HandleModel::Distance(const Eigen::Vector3d& point) const {
  double distance = PlateDistance(*this, point);
  for (const HandleBar& bar : BarsOf(*this)) distance = std::min(distance, BarDistance(bar, point));
  return distance;
}

std::vector<HandleBar> BarsOf(const HandleModel& model) {
  const Eigen::Vector3d end(model.length_m, 0.0, 0.0);
  std::vector<HandleBar> bars = {
      {{-model.behind_m, 0.0, 0.0}, end, model.radius_m},
      {Eigen::Vector3d::Zero(), {0.0, 0.0, -model.standoff_m}, kNeckPerLever * model.radius_m}};
  const double back_m = model.standoff_m - model.radius_m - HandleModel::kReturnGap_m;
  if (model.returned && back_m > 0.0)
    bars.push_back({end, end - Eigen::Vector3d(0.0, 0.0, back_m), model.radius_m});
  return bars;
}

Wireframe WireframeOf(const HandleModel& model) {
  Wireframe lines = {OutlineOf(model), PlateOutline(model)};
  for (const HandleBar& bar : BarsOf(model))
    if (bar.from.z() != bar.to.z()) lines.push_back({bar.from, bar.to});
  return lines;
}

}  // namespace foresight
