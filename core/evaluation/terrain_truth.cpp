#include "core/evaluation/terrain_truth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/evaluation/sigma_errors.h"
#include "core/geometry/angles.h"
#include "core/simulation/lidar_view.h"
#include "core/simulation/ray_caster.h"

namespace foresight {
namespace {

constexpr int kSamples = 12;  // of a top, in each direction
constexpr double kMatched_mm = 50.0, kMatched_deg = 5.0;
constexpr double kRight_mm = 25.0, kRight_deg = 2.5;
constexpr double kStandsOn_m = 0.030;  // height of a claimed foothold from a block's top

/// Points of a rectangle, evenly.
std::vector<Eigen::Vector2d> Spread(const Eigen::Vector2d& size_m, int count) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      points.emplace_back(((i + 0.5) / count - 0.5) * size_m.x(),
                          ((j + 0.5) / count - 0.5) * size_m.y());
  return points;
}

Eigen::Vector3d OnTop(const Eigen::Vector2d& at) {
  return {at.x(), at.y(), 0.0};
}

/// What the camera of a trial sees inside the drawn region.
class CameraView {
 public:
  CameraView(const FitTrial& trial, const RayCaster& caster) : trial_(trial), caster_(caster) {
    const SensorRig& rig = trial.world.true_rig();
    const double plate_rad =
        trial.world.PlateAngle(trial.scene.plan.image_angles_rad.front(), true);
    robot_from_camera_ =
        rig.robot_from_base * HeadFromBase(plate_rad).Inverse() * rig.camera_from_head.Inverse();
  }

  bool Sees(const Eigen::Vector3d& in_robot) const {
    const auto pixel =
        trial_.world.true_rig().camera.Project(robot_from_camera_.Inverse() * in_robot);
    if (!pixel || !InRegion(*pixel, in_robot)) return false;
    const Eigen::Vector3d sight = in_robot - robot_from_camera_.translation();
    const SceneRay ray{robot_from_camera_.translation().cast<float>(),
                       sight.normalized().cast<float>()};
    return !caster_.Occluded(ray, static_cast<float>(sight.norm() - LidarView::kTolerance_m));
  }

 private:
  bool InRegion(const Eigen::Vector2d& pixel, const Eigen::Vector3d& in_robot) const {
    if (const auto* box = std::get_if<BoxRoi>(&trial_.roi))
      return box->Contains(trial_.TrueBaseFromRobot() * in_robot);
    return std::get<ImageRoi>(trial_.roi).Contains(pixel);
  }

  const FitTrial& trial_;
  const RayCaster& caster_;
  Rigid<frame::Robot, frame::Camera> robot_from_camera_;
};

struct Comparison {
  double center_mm = 0.0;
  double tilt_deg = 0.0;
  double yaw_deg = 0.0;
  double height_mm = 0.0;

  bool Matched() const { return center_mm < kMatched_mm && tilt_deg < kMatched_deg; }
  bool Right() const { return center_mm < kRight_mm && tilt_deg < kRight_deg; }
};

Comparison Compare(const TerrainSurface& found, const TrueBlock& truth) {
  const Rigid<frame::Object, frame::Object> truth_from_found =
      truth.base_from_object.Inverse() * found.base_from_object;
  const Eigen::Vector3d z = truth_from_found.Rotate(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d x = truth_from_found.Rotate(Eigen::Vector3d::UnitX());
  Comparison result;
  result.center_mm = 1000.0 * truth_from_found.translation().norm();
  result.tilt_deg = DegreesFromRadians(std::acos(std::clamp(z.z(), -1.0, 1.0)));
  // A quarter turn of a nearly square top cannot be seen.
  result.yaw_deg = DegreesFromRadians(
      std::abs(std::remainder(std::atan2(x.y(), x.x()), 0.5 * std::numbers::pi)));
  result.height_mm = 1000.0 * std::abs(truth_from_found.translation().z());
  return result;
}

bool Holds(const TrueBlock& block, const Eigen::Vector3d& in_base, double margin_m) {
  const Eigen::Vector3d at = block.base_from_object.Inverse() * in_base;
  return std::abs(at.z()) < kStandsOn_m && std::abs(at.x()) < 0.5 * block.size_m.x() - margin_m &&
         std::abs(at.y()) < 0.5 * block.size_m.y() - margin_m;
}

/// Overlap of the claimed foothold with the true one, as a fraction of both together.
double ToeholdOverlap(const TerrainSurface& found, const TrueBlock& truth) {
  const double margin_m = 0.25 * (found.size_m - found.toehold.size_m).sum();
  const double claimed = found.toehold.size_m.prod();
  const double right = (truth.size_m.array() - 2.0 * margin_m).prod();
  int common = 0;
  const auto points = Spread(found.toehold.size_m, 60);
  for (const Eigen::Vector2d& at : points)
    common += Holds(truth, found.base_from_object * OnTop(at), margin_m) ? 1 : 0;
  const double both = claimed * common / static_cast<double>(points.size());
  return both / (claimed + right - both);
}

/// Fraction of the claimed foothold that no block's top is under.
double FalseArea(const TerrainSurface& found, std::span<const TrueBlock> blocks) {
  int off = 0;
  const auto points = Spread(found.toehold.size_m, 40);
  for (const Eigen::Vector2d& at : points) {
    const Eigen::Vector3d in_base = found.base_from_object * OnTop(at);
    off += std::none_of(blocks.begin(), blocks.end(),
                        [&](const TrueBlock& block) { return Holds(block, in_base, 0.0); })
               ? 1
               : 0;
  }
  return off / static_cast<double>(points.size());
}

/// The nearest block; -1 = there is none.
int Nearest(const TerrainSurface& found, std::span<const TrueBlock> blocks) {
  int nearest = -1;
  double least = 1e9;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const double distance =
        (blocks[i].base_from_object.translation() - found.base_from_object.translation()).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

FitOutcome JudgeOne(const TerrainSurface& found, std::span<const TrueBlock> blocks,
                    std::vector<bool>& taken) {
  FitOutcome outcome;
  outcome.found = true;
  outcome.verdict = found.verdict;
  outcome.reason = found.verdict.reason;
  outcome.evidence = {{"confirmed_edges", static_cast<double>(found.evidence.confirmed_edges)},
                      {"outline_nats", found.evidence.outline_nats},
                      {"size_margin", found.evidence.size_margin},
                      {"size_nats", found.evidence.size_nats}};
  outcome.errors = {{"false_area", FalseArea(found, blocks)}};
  const int nearest = Nearest(found, blocks);
  if (nearest < 0) return outcome;
  const TrueBlock& truth = blocks[static_cast<std::size_t>(nearest)];
  const Comparison result = Compare(found, truth);
  outcome.pose_ok = result.Matched();
  outcome.all_ok = result.Right();
  const bool first = outcome.pose_ok && !taken[static_cast<std::size_t>(nearest)];
  if (first) taken[static_cast<std::size_t>(nearest)] = true;
  outcome.errors.insert(outcome.errors.end(), {{"center_mm", result.center_mm},
                                               {"tilt_deg", result.tilt_deg},
                                               {"yaw_deg", result.yaw_deg},
                                               {"height_mm", result.height_mm},
                                               {"toehold_iou", ToeholdOverlap(found, truth)},
                                               {"in_view", first && truth.Visible() ? 1.0 : 0.0}});
  AddSigmaErrors(found.base_from_object.Inverse() * truth.base_from_object, found.covariance,
                 0.5 * std::numbers::pi, outcome.errors);
  return outcome;
}

}  // namespace

std::vector<TrueBlock> TrueBlocksOf(const FitTrial& trial) {
  const RayCaster caster(trial.scene.scene);
  const LidarView lidar(caster, trial.world.true_rig(),
                        trial.world.PlateAngle(trial.scene.plan.from_rad, true),
                        trial.world.PlateAngle(trial.scene.plan.to_rad, true));
  const CameraView camera(trial, caster);
  std::vector<TrueBlock> blocks;
  for (const BlockTruth& truth : trial.scene.scene->blocks) {
    std::vector<Eigen::Vector3d> points;
    for (const Eigen::Vector2d& at : Spread(truth.size_m.head<2>(), kSamples))
      points.push_back(truth.robot_from_object * OnTop(at));
    std::vector<std::uint8_t> seen(points.size());
    lidar.Seen(points, seen);
    double count = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      count += seen[i] != 0 && camera.Sees(points[i]) ? 1.0 : 0.0;
    blocks.push_back({trial.TrueBaseFromRobot() * truth.robot_from_object, truth.size_m.head<2>(),
                      count / static_cast<double>(points.size())});
  }
  return blocks;
}

std::vector<FitOutcome> JudgeTerrain(std::span<const TrueBlock> blocks,
                                     const Result<TerrainDetection>& found) {
  std::vector<FitOutcome> outcomes;
  std::vector<bool> taken(blocks.size(), false);
  if (found)
    for (const TerrainSurface& surface : found->surfaces)
      if (surface.kind == TerrainSurface::Kind::kBlock)
        outcomes.push_back(JudgeOne(surface, blocks, taken));
  FitOutcome missed;
  missed.reason = found ? "a block in view was missed" : found.error().message;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (blocks[i].Visible() && !taken[i]) outcomes.push_back(missed);
  if (outcomes.empty()) {
    missed.reason = found ? "no block" : found.error().message;
    outcomes.push_back(missed);
  }
  return outcomes;
}

}  // namespace foresight
