#include "core/objects/handle_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foresight {
namespace {

constexpr int kPieces = 4;             // of a bowed lever: a sixteenth of its bow off the parabola
constexpr double kStraight_m = 2e-4;   // bows below that are none
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
  const std::vector<Eigen::Vector3d> path = LeverPathOf(model);
  std::vector<Eigen::Vector3d> outline;
  const auto round_end = [&](const Eigen::Vector3d& middle, double from_rad) {
    for (int i = 0; i <= kCorners; ++i) {
      const double angle = from_rad + std::numbers::pi * i / kCorners;
      outline.push_back(middle +
                        model.radius_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0));
    }
  };
  const Eigen::Vector3d aside(0.0, model.radius_m, 0.0);
  round_end(path.back(), -0.5 * std::numbers::pi);
  for (std::size_t i = path.size() - 2; i > 0; --i) outline.push_back(path[i] + aside);
  round_end(path.front(), 0.5 * std::numbers::pi);
  for (std::size_t i = 1; i + 1 < path.size(); ++i) outline.push_back(path[i] - aside);
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
  if (!(std::hypot(bow_m, lift_m) <= 0.5 * length_m))
    return Fail(ErrorCode::kInvalidOptions,
                "door handle: bow_m {} and lift_m {} are more than half of length_m {}", bow_m,
                lift_m, length_m);
  return {};
}

double HandleModel::Distance(const Eigen::Vector3d& point) const {
  double distance = PlateDistance(*this, point);
  for (const HandleBar& bar : BarsOf(*this)) distance = std::min(distance, BarDistance(bar, point));
  return distance;
}

std::vector<Eigen::Vector3d> LeverPathOf(const HandleModel& model) {
  const Eigen::Vector3d end(model.length_m, 0.0, 0.0);
  if (std::hypot(model.bow_m, model.lift_m) < kStraight_m)
    return {{-model.behind_m, 0.0, 0.0}, end};
  std::vector<Eigen::Vector3d> path;
  if (model.behind_m > 0.0) path.emplace_back(-model.behind_m, 0.0, 0.0);
  for (int i = 0; i <= kPieces; ++i) {
    const double s = static_cast<double>(i) / kPieces, off = HandleModel::BowAt(s);
    path.emplace_back(s * model.length_m, off * model.bow_m, off * model.lift_m);
  }
  return path;
}

std::vector<HandleBar> BarsOf(const HandleModel& model) {
  const Eigen::Vector3d end(model.length_m, 0.0, 0.0);
  const std::vector<Eigen::Vector3d> path = LeverPathOf(model);
  std::vector<HandleBar> bars;
  for (std::size_t i = 1; i < path.size(); ++i)
    bars.push_back({path[i - 1], path[i], model.radius_m});
  bars.push_back(
      {Eigen::Vector3d::Zero(), {0.0, 0.0, -model.standoff_m}, kNeckPerLever * model.radius_m});
  const double back_m = model.standoff_m - model.radius_m - HandleModel::kReturnGap_m;
  if (model.returned && back_m > 0.0)
    bars.push_back({end, end - Eigen::Vector3d(0.0, 0.0, back_m), model.radius_m});
  return bars;
}

Wireframe WireframeOf(const HandleModel& model) {
  Wireframe lines = {OutlineOf(model), PlateOutline(model)};
  const std::vector<HandleBar> bars = BarsOf(model);
  for (std::size_t i = LeverPathOf(model).size() - 1; i < bars.size(); ++i)
    lines.push_back({bars[i].from, bars[i].to});
  return lines;
}

}  // namespace foresight
