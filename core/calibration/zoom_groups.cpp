#include "core/calibration/zoom_groups.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/calibration/tangent.h"

namespace foresight {
namespace {

using Unknowns = Eigen::Matrix<double, 7, 1>;  // a step of the pose, and the logarithm

/// The normal equations of one view at a pose and a focal length.
struct Normal {
  Eigen::Matrix<double, 7, 7> matrix = Eigen::Matrix<double, 7, 7>::Zero();
  Unknowns right = Unknowns::Zero();
  double squares = 0.0;
  bool seen = true;  ///< by the lens
};

Normal NormalOf(const CameraBundle& bundle, std::size_t view, const CameraFromPattern& pose,
                double log_ratio) {
  CameraModel camera = bundle.camera;
  camera.fx *= std::exp(log_ratio);
  camera.fy *= std::exp(log_ratio);
  const Eigen::Matrix3d rotation = pose.RotationMatrix();
  const BoardView& corners = bundle.views[view];
  Normal normal;
  for (std::size_t i = 0; i < corners.pixels.size(); ++i) {
    const Eigen::Vector3d on_board = bundle.board.Corner(corners.corner_ids[i], bundle.warp);
    CameraModel::ByPoint by_point;
    CameraModel::ByParameters by_parameters;
    const auto pixel = camera.Project(pose * on_board, &by_point, &by_parameters);
    if (!pixel) {
      normal.seen = false;
      return normal;
    }
    const Eigen::Vector2d error = *pixel - corners.pixels[i];
    Eigen::Matrix<double, 2, 7> jacobian;
    jacobian.leftCols<3>() = -by_point * rotation * Skew(on_board);
    jacobian.middleCols<3>(3) = by_point * rotation;
    jacobian.col(6) = camera.fx * by_parameters.col(0) + camera.fy * by_parameters.col(1);
    normal.matrix += jacobian.transpose() * jacobian;
    normal.right -= jacobian.transpose() * error;
    normal.squares += error.squaredNorm();
  }
  return normal;
}

ViewFocal FocalOf(const CameraBundle& bundle, std::size_t view) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  CameraFromPattern pose = bundle.poses[view];
  ViewFocal focal{0.0, kInfinite};
  double log_ratio = 0.0;
  for (int iteration = 0; iteration < 10; ++iteration) {
    const Normal normal = NormalOf(bundle, view, pose, log_ratio);
    if (!normal.seen) return focal;
    const Eigen::FullPivLU<Eigen::Matrix<double, 7, 7>> solver(normal.matrix);
    if (!solver.isInvertible()) return focal;
    const Unknowns step = solver.solve(normal.right);
    // Farther than a factor of two from the common camera an image says nothing.
    if (!step.allFinite() || std::abs(log_ratio + step[6]) > std::log(2.0)) return focal;
    pose = Perturbed(pose, Eigen::Matrix<double, 6, 1>(step.head<6>()));
    log_ratio += step[6];
    if (step.norm() > 1e-8) continue;
    const double freedom =
        std::max(1.0, 2.0 * static_cast<double>(bundle.views[view].pixels.size()) - 7.0);
    focal.log_ratio = log_ratio;
    focal.sigma = std::sqrt(solver.inverse()(6, 6) * normal.squares / freedom);
    return focal;
  }
  return focal;
}

struct Group {
  double mean = 0.0, squares = 0.0;
};

Group GroupOf(const std::vector<ViewFocal>& focals, const std::vector<std::size_t>& views) {
  Group group;
  for (const std::size_t view : views)
    group.mean += focals[view].log_ratio / static_cast<double>(views.size());
  for (const std::size_t view : views)
    group.squares += std::pow(focals[view].log_ratio - group.mean, 2);
  return group;
}

}  // namespace

std::vector<ViewFocal> FocalOfEachView(const CameraBundle& bundle) {
  std::vector<ViewFocal> focals;
  for (std::size_t view = 0; view < bundle.views.size(); ++view)
    focals.push_back(FocalOf(bundle, view));
  return focals;
}

std::optional<ZoomGroups> FindZoomGroups(const std::vector<ViewFocal>& focals) {
  constexpr double kMostSigma = 0.03, kLeastRatio = 1.05, kLeastGap = 5.0;
  constexpr std::size_t kLeastGroup = 3;
  std::vector<std::size_t> order;
  for (std::size_t view = 0; view < focals.size(); ++view)
    if (focals[view].sigma < kMostSigma) order.push_back(view);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return focals[a].log_ratio < focals[b].log_ratio;
  });
  std::optional<ZoomGroups> best;
  for (std::size_t split = kLeastGroup; split + kLeastGroup <= order.size(); ++split) {
    ZoomGroups groups;
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(split);
    groups.shorter.assign(order.begin(), middle);
    groups.longer.assign(middle, order.end());
    const Group shorter = GroupOf(focals, groups.shorter), longer = GroupOf(focals, groups.longer);
    // What the images themselves do not know better keeps few of them from a spread of nearly 0.
    double variance = 0.0;
    for (const std::size_t view : order)
      variance += std::pow(focals[view].sigma, 2) / static_cast<double>(order.size());
    const double spread = std::sqrt(std::max(
        variance, (shorter.squares + longer.squares) / (static_cast<double>(order.size()) - 2.0)));
    groups.ratio = std::exp(longer.mean - shorter.mean);
    groups.gap = (longer.mean - shorter.mean) / spread;
    if (!best || groups.gap > best->gap) best = groups;
  }
  // One group that is cut in its middle has a gap of 1.6 / 0.6 = 2.7 where it is normal.
  if (!best || best->ratio < kLeastRatio || best->gap < kLeastGap) return std::nullopt;
  return best;
}

}  // namespace foresight
