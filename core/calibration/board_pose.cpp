#include "core/calibration/board_pose.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "core/calibration/rotation_step.h"
#include "core/geometry/nearest_rotation.h"
#include "core/geometry/symmetric_eigen.h"

namespace foresight {
namespace {

constexpr std::size_t kFewestPoseCorners = 4;
constexpr double kHiddenCorner_px = 200.0;

/// Corners moved and scaled so that the linear equations are well conditioned.
struct CenteredCorners {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1.0;
  std::vector<Eigen::Vector2d> corners;
  std::vector<Eigen::Vector3d> rays;
};

std::optional<CenteredCorners> CornersWithRays(const CalibrationBoard& board, const BoardView& view,
                                               const CameraModel& camera) {
  CenteredCorners result;
  std::vector<Eigen::Vector3d> corners;
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    const auto ray = camera.Unproject(view.pixels[i]);
    if (!ray) continue;
    corners.push_back(board.Corner(view.corner_ids[i]));
    result.rays.push_back(*ray);
    result.center += corners.back();
  }
  if (corners.size() < kFewestPoseCorners) return std::nullopt;
  result.center /= static_cast<double>(corners.size());
  double spread = 0.0;
  for (const Eigen::Vector3d& corner : corners) spread += (corner - result.center).squaredNorm();
  result.scale = std::sqrt(spread / static_cast<double>(corners.size()));
  for (const Eigen::Vector3d& corner : corners)
    result.corners.push_back((corner - result.center).head<2>() / result.scale);
  return result;
}

/// The matrix H with H (x, y, 1) along the ray of each corner. Rays, not image points: nothing is
/// divided by a depth, which may be 0 or negative. nullopt where corners lie on a line.
std::optional<Eigen::Matrix3d> RaysFromPlane(const CenteredCorners& corners) {
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (std::size_t i = 0; i < corners.rays.size(); ++i) {
    const Eigen::Vector3d point(corners.corners[i].x(), corners.corners[i].y(), 1.0);
    // The part of H point across the ray is 0.
    const Eigen::Matrix3d across = CrossMatrix(corners.rays[i]);
    Eigen::Matrix<double, 3, 9> rows;
    for (int column = 0; column < 3; ++column)
      rows.middleCols<3>(3 * column) = point[column] * across;
    normal += rows.transpose() * rows;
  }
  const SymmetricEigen eigen = EigenOf(normal);
  if (eigen.values[1] < 1e-10 * eigen.values[8]) return std::nullopt;
  Eigen::Matrix3d matrix = Eigen::Map<const Eigen::Matrix3d>(eigen.vectors.data());  // column 0
  double along = 0.0;
  for (std::size_t i = 0; i < corners.rays.size(); ++i)
    along += corners.rays[i].dot(
        matrix * Eigen::Vector3d(corners.corners[i].x(), corners.corners[i].y(), 1.0));
  if (along < 0.0) matrix = -matrix;
  return matrix;
}

std::optional<CameraFromPattern> LinearPose(const CenteredCorners& corners) {
  const auto matrix = RaysFromPlane(corners);
  if (!matrix) return std::nullopt;
  const double length = 0.5 * (matrix->col(0).norm() + matrix->col(1).norm());
  if (!(length > 0.0)) return std::nullopt;
  Eigen::Matrix3d axes;
  axes << matrix->col(0) / length, matrix->col(1) / length,
      matrix->col(0).cross(matrix->col(1)) / (length * length);
  if (!(axes.determinant() > 0.0)) return std::nullopt;
  const Eigen::Matrix3d rotation = NearestRotation(axes);
  const Eigen::Vector3d center_in_camera = matrix->col(2) * (corners.scale / length);
  return CameraFromPattern(rotation, center_in_camera - rotation * corners.center);
}

/// The other pose that looks almost the same from afar: the plane's normal mirrored at the line of
/// sight.
CameraFromPattern OtherPose(const CameraFromPattern& pose, const Eigen::Vector3d& center) {
  const Eigen::Vector3d center_in_camera = pose * center;
  const Eigen::Vector3d sight = center_in_camera.normalized();
  const Eigen::Matrix3d half_turn = 2.0 * sight * sight.transpose() - Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d rotation =
      half_turn * pose.RotationMatrix() * Eigen::Vector3d(-1.0, -1.0, 1.0).asDiagonal();
  return {rotation, center_in_camera - rotation * center};
}

struct NormalEquations {
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
  PoseStep gradient = PoseStep::Zero();
  double cost = 0.0;
  std::size_t shown = 0;
};

/// Corners of one view, in the pattern's frame.
struct ViewedCorners {
  std::vector<Eigen::Vector3d> corners;
  const std::vector<Eigen::Vector2d>& pixels;
};

NormalEquations Linearize(const ViewedCorners& view, const CameraModel& camera,
                          const CameraFromPattern& pose, bool with_derivatives) {
  NormalEquations equations;
  const Eigen::Matrix3d rotation = pose.RotationMatrix();
  CameraModel::ByPoint by_point;
  for (std::size_t i = 0; i < view.corners.size(); ++i) {
    const Eigen::Vector3d point = rotation * view.corners[i] + pose.translation();
    const auto pixel = camera.Project(point, with_derivatives ? &by_point : nullptr, nullptr);
    if (!pixel) {
      equations.cost += kHiddenCorner_px * kHiddenCorner_px;
      continue;
    }
    ++equations.shown;
    const Eigen::Vector2d error = *pixel - view.pixels[i];
    equations.cost += error.squaredNorm();
    if (!with_derivatives) continue;
    const Eigen::Matrix<double, 2, 6> by_step = by_point * ByPoseStep(rotation, view.corners[i]);
    equations.matrix += by_step.transpose() * by_step;
    equations.gradient += by_step.transpose() * error;
  }
  return equations;
}

}  // namespace

std::optional<BoardPose> RefineBoardPose(const CalibrationBoard& board, const BoardView& view,
                                         const CameraModel& camera, const CameraFromPattern& start,
                                         const BoardWarp& warp, int iterations) {
  ViewedCorners corners{{}, view.pixels};
  for (const int id : view.corner_ids) corners.corners.push_back(board.Corner(id, warp));
  CameraFromPattern pose = start;
  NormalEquations here = Linearize(corners, camera, pose, true);
  double damping = 1e-3;
  for (int i = 0; i < iterations && damping < 1e8; ++i) {
    Eigen::Matrix<double, 6, 6> damped = here.matrix;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-12;
    const PoseStep step = -damped.ldlt().solve(here.gradient);
    if (!step.allFinite()) break;
    const CameraFromPattern next = Moved(pose, step);
    const double cost = Linearize(corners, camera, next, false).cost;
    if (!(cost < here.cost)) {
      damping *= 8.0;
      continue;
    }
    const bool settled = here.cost - cost < 1e-10 * here.cost;
    pose = next;
    damping *= 0.1;
    here = Linearize(corners, camera, pose, true);
    if (settled) break;
  }
  if (here.shown < kFewestPoseCorners || !std::isfinite(here.cost)) return std::nullopt;
  return BoardPose{pose, std::sqrt(here.cost / static_cast<double>(view.pixels.size()))};
}

std::optional<BoardPose> FindBoardPose(const CalibrationBoard& board, const BoardView& view,
                                       const CameraModel& camera, const BoardWarp& warp) {
  const auto corners = CornersWithRays(board, view, camera);
  if (!corners) return std::nullopt;
  const auto linear = LinearPose(*corners);
  if (!linear) return std::nullopt;
  auto best = RefineBoardPose(board, view, camera, *linear, warp);
  if (!best) return std::nullopt;
  const CameraFromPattern other = OtherPose(best->camera_from_pattern, corners->center);
  if (const auto second = RefineBoardPose(board, view, camera, other, warp);
      second && second->rms_px < best->rms_px)
    best = second;
  return best;
}

}  // namespace foresight
