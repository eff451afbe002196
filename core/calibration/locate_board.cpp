#include "core/calibration/locate_board.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "core/calibration/tangent.h"
#include "core/geometry/rotation_between.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Camera, frame::Pattern>;
using Homography = Eigen::Matrix3d;

struct Correspondences {
  std::vector<Eigen::Vector3d> on_board;
  std::vector<Eigen::Vector2d> pixels;
  std::vector<Eigen::Vector3d> rays;

  Eigen::Vector3d MeanOnBoard() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : on_board) sum += point;
    return sum / static_cast<double>(on_board.size());
  }
};

Correspondences CorrespondencesOf(const CameraModel& camera, const CalibrationBoard& board,
                                  const BoardView& view) {
  Correspondences all;
  for (std::size_t i = 0; i < view.corner_ids.size(); ++i) {
    const auto ray = camera.Unproject(view.pixels[i]);
    if (!ray) continue;
    all.on_board.push_back(board.Corner(view.corner_ids[i]));
    all.pixels.push_back(view.pixels[i]);
    all.rays.push_back(*ray);
  }
  return all;
}

/// Moves the points' mean to 0 and their mean distance from it to 1.
Eigen::Matrix3d Normalizer(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  double distance = 0.0;
  for (const auto& p : points) distance += (p - mean).norm();
  const double scale = static_cast<double>(points.size()) / std::max(distance, 1e-12);
  Eigen::Matrix3d normalizer;
  normalizer << scale, 0.0, -scale * mean.x(),  //
      0.0, scale, -scale * mean.y(),            //
      0.0, 0.0, 1.0;
  return normalizer;
}

/// nullopt where the points of the board lie on a line.
std::optional<Homography> FindHomography(const std::vector<Eigen::Vector2d>& from,
                                         const std::vector<Eigen::Vector2d>& to) {
  const Eigen::Matrix3d normal_from = Normalizer(from), normal_to = Normalizer(to);
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Eigen::Vector3d p = normal_from * from[i].homogeneous();
    const Eigen::Vector3d q = normal_to * to[i].homogeneous();
    Eigen::Matrix<double, 2, 9> rows;
    rows << p.transpose(), Eigen::RowVector3d::Zero(), -q.x() * p.transpose(),
        Eigen::RowVector3d::Zero(), p.transpose(), -q.y() * p.transpose();
    normal += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
  if (solver.eigenvalues()[1] < 1e-9 * solver.eigenvalues()[8]) return std::nullopt;
  const Eigen::Matrix<double, 9, 1> h = solver.eigenvectors().col(0);
  Homography homography;
  homography << h.segment<3>(0).transpose(), h.segment<3>(3).transpose(),
      h.segment<3>(6).transpose();
  return normal_to.inverse() * homography * normal_from;
}

Pose PoseFromHomography(Homography h) {
  h *= 2.0 / (h.col(0).norm() + h.col(1).norm());
  if (h(2, 2) < 0.0) h = -h;
  Eigen::Matrix3d near;
  near << h.col(0), h.col(1), h.col(0).cross(h.col(1));
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(near, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose()), h.col(2)};
}

std::optional<Pose> StartPose(const Correspondences& all) {
  Eigen::Vector3d mean_ray = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& ray : all.rays) mean_ray += ray;
  if (mean_ray.norm() < 1e-6) return std::nullopt;
  const Eigen::Quaterniond virtual_from_camera =
      RotationBetween(mean_ray, Eigen::Vector3d::UnitZ());
  std::vector<Eigen::Vector2d> from, to;
  for (std::size_t i = 0; i < all.rays.size(); ++i) {
    const Eigen::Vector3d ray = virtual_from_camera * all.rays[i];
    if (ray.z() < 0.05) return std::nullopt;
    from.emplace_back(all.on_board[i].head<2>());
    to.emplace_back(ray.head<2>() / ray.z());
  }
  const auto homography = FindHomography(from, to);
  if (!homography) return std::nullopt;
  const Pose virtual_pose = PoseFromHomography(*homography);
  const Eigen::Quaterniond back = virtual_from_camera.conjugate();
  return Pose(back * virtual_pose.rotation(), back * virtual_pose.translation());
}

/// The pose that looks nearly the same from afar: tilted the other way about the line of sight.
Pose MirrorSolution(const Pose& pose, const Eigen::Vector3d& centre_on_board) {
  const Eigen::Vector3d centre = pose * centre_on_board;
  const Eigen::Vector3d sight = centre.normalized();
  const Eigen::Matrix3d half_turn = 2.0 * sight * sight.transpose() - Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d rotation =
      half_turn * pose.RotationMatrix() * Eigen::Vector3d(-1.0, -1.0, 1.0).asDiagonal();
  return {rotation, centre - rotation * centre_on_board};
}

/// Sum of squared pixel distances; infinite where a corner has no image.
double CostOf(const CameraModel& camera, const Correspondences& all, const Pose& pose) {
  double cost = 0.0;
  for (std::size_t i = 0; i < all.pixels.size(); ++i) {
    const auto pixel = camera.Project(pose * all.on_board[i]);
    if (!pixel) return std::numeric_limits<double>::infinity();
    cost += (*pixel - all.pixels[i]).squaredNorm();
  }
  return cost;
}

struct NormalEquations {
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
};

NormalEquations Linearize(const CameraModel& camera, const Correspondences& all, const Pose& pose) {
  NormalEquations equations;
  const Eigen::Matrix3d rotation = pose.RotationMatrix();
  for (std::size_t i = 0; i < all.pixels.size(); ++i) {
    CameraModel::ByPoint by_point;
    const auto pixel = camera.Project(pose * all.on_board[i], &by_point, nullptr);
    if (!pixel) continue;
    Eigen::Matrix<double, 2, 6> by_step;
    by_step << -by_point * rotation * Skew(all.on_board[i]), by_point * rotation;
    equations.matrix += by_step.transpose() * by_step;
    equations.right += by_step.transpose() * (all.pixels[i] - *pixel);
  }
  return equations;
}

struct Refined {
  Pose pose;
  double cost = std::numeric_limits<double>::infinity();
};

Refined Refine(const CameraModel& camera, const Correspondences& all, const Pose& start) {
  Refined best{start, CostOf(camera, all, start)};
  double damping = 1e-3;
  for (int i = 0; i < 30 && std::isfinite(best.cost) && damping < 1e6; ++i) {
    NormalEquations equations = Linearize(camera, all, best.pose);
    equations.matrix.diagonal() *= 1.0 + damping;
    const Eigen::Matrix<double, 6, 1> step = equations.matrix.ldlt().solve(equations.right);
    const Pose moved = Perturbed(best.pose, step);
    const double cost = CostOf(camera, all, moved);
    if (!(cost < best.cost)) {
      damping *= 10.0;
      continue;
    }
    const bool done = best.cost - cost < 1e-10 * best.cost;
    best = {moved, cost};
    damping = std::max(0.1 * damping, 1e-9);
    if (done) break;
  }
  return best;
}

}  // namespace

Result<LocatedBoard> LocateBoard(const CameraModel& camera, const CalibrationBoard& board,
                                 const BoardView& view, const std::string& source) {
  constexpr std::size_t kLeastCorners = 6;
  const Correspondences all = CorrespondencesOf(camera, board, view);
  if (all.rays.size() < kLeastCorners)
    return Fail(ErrorCode::kTooFewPoints,
                "{}: {} corners of the board are within the camera's view, at least {} are needed",
                source, all.rays.size(), kLeastCorners);
  const auto start = StartPose(all);
  if (!start)
    return Fail(ErrorCode::kTooFewPoints,
                "{}: the {} corners lie on a line, or the camera's start values are far off",
                source, all.rays.size());
  const Eigen::Vector3d centre = all.MeanOnBoard();
  Refined best = Refine(camera, all, *start);
  const Refined mirror = Refine(camera, all, MirrorSolution(best.pose, centre));
  if (mirror.cost < best.cost) best = mirror;
  if (!std::isfinite(best.cost))
    return Fail(ErrorCode::kNoConvergence, "{}: no pose of the board explains its corners", source);
  if (best.pose.Rotate(Eigen::Vector3d::UnitZ()).dot(best.pose * centre) < 0.0)
    return Fail(ErrorCode::kInvalidInput,
                "{}: the board is seen from behind, so its corners are mirrored. Check the image "
                "and the print, and that columns and rows are not exchanged",
                source);
  return LocatedBoard{best.pose, std::sqrt(best.cost / static_cast<double>(all.rays.size()))};
}

}  // namespace foresight
