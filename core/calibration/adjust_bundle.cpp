#include <ceres/ceres.h>

#include <array>
#include <cmath>
#include <memory>

#include "core/base/parallel.h"
#include "core/calibration/camera_bundle.h"
#include "core/calibration/rotation_step.h"

namespace foresight {
namespace {

/// A pose as Ceres holds it: quaternion x, y, z, w, then the translation.
using PoseBlock = std::array<double, 7>;
using PoseMap = Eigen::Map<const Eigen::Quaterniond>;

PoseBlock BlockOf(const CameraFromPattern& pose) {
  const Eigen::Quaterniond& q = pose.rotation();
  const Eigen::Vector3d& t = pose.translation();
  return {q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z()};
}

CameraFromPattern PoseOf(const double* block) {
  return {Eigen::Quaterniond(PoseMap(block)), Eigen::Map<const Eigen::Vector3d>(block + 4)};
}

/// Poses move by PoseStep. Cost functions give derivatives by the step itself, in the first six of
/// seven columns, so that is what this manifold passes on: its "derivative of Plus" only selects
/// them.
class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    const PoseBlock moved = BlockOf(Moved(PoseOf(x), Eigen::Map<const PoseStep>(delta)));
    std::copy(moved.begin(), moved.end(), x_plus_delta);
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> map(jacobian);
    map.setZero();
    map.topRows<6>().setIdentity();
    return true;
  }
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    const CameraFromPattern to = PoseOf(y), from = PoseOf(x);
    const Eigen::AngleAxisd turn(from.rotation().conjugate() * to.rotation());
    Eigen::Map<PoseStep> step(y_minus_x);
    step << turn.angle() * turn.axis(), to.translation() - from.translation();
    return true;
  }
  bool MinusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> map(jacobian);
    map.setZero();
    map.leftCols<6>().setIdentity();
    return true;
  }
};

/// What all corners share at one evaluation: a lens is made once, not once a corner.
class SharedState final : public ceres::EvaluationCallback {
 public:
  explicit SharedState(const CameraBundle& bundle) : camera_(bundle.camera), board_(bundle.board) {
    values_ = camera_.Values();
    warp_ = {bundle.warp.x_m, bundle.warp.y_m};
    for (const CameraFromPattern& pose : bundle.poses) poses_.push_back(BlockOf(pose));
    rotations_.resize(poses_.size());
    PrepareForEvaluation(true, true);
  }

  void PrepareForEvaluation(bool, bool new_point) override {
    if (!new_point) return;
    camera_ = camera_.WithValues(values_);
    // k on its way through 0 is a pinhole; other values out of their range are of no camera.
    usable_ = std::holds_alternative<FisheyeLens>(camera_.lens) || !camera_.FindFault();
    for (std::size_t i = 0; i < poses_.size(); ++i)
      rotations_[i] = PoseOf(poses_[i].data()).RotationMatrix();
  }

  void WriteTo(CameraBundle& bundle) const {
    bundle.camera = camera_.WithValues(values_);
    bundle.warp = {warp_[0], warp_[1]};
    for (std::size_t i = 0; i < poses_.size(); ++i) bundle.poses[i] = PoseOf(poses_[i].data());
  }

  bool usable() const { return usable_; }
  const CameraModel& camera() const { return camera_; }
  const CalibrationBoard& board() const { return board_; }
  const Eigen::Matrix3d& rotation(std::size_t view) const { return rotations_[view]; }

  double* values() { return values_.data(); }
  int value_count() const { return static_cast<int>(values_.size()); }
  double* warp() { return warp_.data(); }
  double* pose(std::size_t view) { return poses_[view].data(); }

 private:
  bool usable_ = true;
  CameraModel camera_;
  CalibrationBoard board_;
  CameraModel::Parameters values_;
  std::array<double, 2> warp_{};
  std::vector<PoseBlock> poses_;
  std::vector<Eigen::Matrix3d> rotations_;
};

/// The error of one corner. Parameters: the camera's values, the warp, the board's pose.
class CornerError final : public ceres::CostFunction {
 public:
  CornerError(const SharedState& state, std::size_t view, int corner_id,
              const Eigen::Vector2d& pixel)
      : state_(state), view_(view), corner_id_(corner_id), pixel_(pixel) {
    set_num_residuals(2);
    *mutable_parameter_block_sizes() = {state.value_count(), 2, 7};
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    if (!state_.usable()) return false;  // Ceres shortens its step
    const Eigen::Map<const Eigen::Vector2d> warp(parameters[1]);
    const Eigen::Map<const Eigen::Vector3d> translation(parameters[2] + 4);
    const Eigen::Matrix3d& rotation = state_.rotation(view_);
    const Eigen::Vector3d corner = state_.board().Corner(corner_id_, {warp.x(), warp.y()});
    CameraModel::ByPoint by_point;
    CameraModel::ByParameters by_parameters;
    const bool wanted = jacobians != nullptr;
    const auto pixel =
        state_.camera().Project(rotation * corner + translation, wanted ? &by_point : nullptr,
                                wanted ? &by_parameters : nullptr);
    if (!pixel) return false;
    Eigen::Map<Eigen::Vector2d> error(residuals);
    error = *pixel - pixel_;
    if (!wanted) return true;
    if (jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>> by_values(
          jacobians[0], 2, state_.value_count());
      by_values = by_parameters;
    }
    if (jacobians[1] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 2, 2, Eigen::RowMajor>> by_warp(jacobians[1]);
      by_warp = by_point * rotation.col(2) * state_.board().CornerByWarp(corner_id_).transpose();
    }
    if (jacobians[2] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 2, 7, Eigen::RowMajor>> by_pose(jacobians[2]);
      by_pose << by_point * ByPoseStep(rotation, corner), Eigen::Vector2d::Zero();
    }
    return true;
  }

 private:
  const SharedState& state_;
  std::size_t view_;
  int corner_id_;
  Eigen::Vector2d pixel_;
};

class StopWhenCancelled final : public ceres::IterationCallback {
 public:
  explicit StopWhenCancelled(const RunContext& context) : context_(context) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return context_.Cancelled() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const RunContext& context_;
};

void AddCorners(const CameraBundle& bundle, SharedState& state, double loss_px,
                ceres::Problem& problem) {
  ceres::LossFunction* loss = loss_px > 0.0 ? new ceres::CauchyLoss(loss_px) : nullptr;
  for (std::size_t view = 0; view < bundle.views.size(); ++view)
    for (std::size_t i = 0; i < bundle.views[view].pixels.size(); ++i)
      problem.AddResidualBlock(new CornerError(state, view, bundle.views[view].corner_ids[i],
                                               bundle.views[view].pixels[i]),
                               loss, state.values(), state.warp(), state.pose(view));
}

void FixValues(const BundleOptions& options, SharedState& state, ceres::Problem& problem) {
  std::vector<int> fixed;
  if (!options.free_principal_point) fixed = {2, 3};
  if (!options.free_lens)
    for (int i = 4; i < state.value_count(); ++i) fixed.push_back(i);
  if (!fixed.empty())
    problem.SetManifold(state.values(), new ceres::SubsetManifold(state.value_count(), fixed));
  if (!options.free_warp) problem.SetParameterBlockConstant(state.warp());
}

ceres::Solver::Options SolverOptions(SharedState& state, const CameraBundle& bundle,
                                     const BundleOptions& options, const RunContext& context) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_SCHUR;
  solver.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (std::size_t view = 0; view < bundle.poses.size(); ++view)
    solver.linear_solver_ordering->AddElementToGroup(state.pose(view), 0);
  solver.linear_solver_ordering->AddElementToGroup(state.values(), 1);
  solver.linear_solver_ordering->AddElementToGroup(state.warp(), 1);
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = 1e-10;
  solver.gradient_tolerance = 1e-12;
  solver.parameter_tolerance = 1e-10;
  solver.num_threads = ThreadCount(context);
  solver.logging_type = ceres::SILENT;
  return solver;
}

}  // namespace

Status AdjustBundle(CameraBundle& bundle, const BundleOptions& options, const RunContext& context) {
  SharedState state(bundle);
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &state;
  ceres::Problem problem(problem_options);
  AddCorners(bundle, state, options.loss_px, problem);
  auto* poses = new PoseManifold;  // the problem's, as losses and costs are
  for (std::size_t view = 0; view < bundle.poses.size(); ++view)
    problem.SetManifold(state.pose(view), poses);
  FixValues(options, state, problem);

  ceres::Solver::Options solver = SolverOptions(state, bundle, options, context);
  StopWhenCancelled stop(context);
  solver.callbacks = {&stop};
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "calibration was cancelled");
  if (!summary.IsSolutionUsable())
    return Fail(ErrorCode::kNoConvergence, "bundle adjustment: {}", summary.message);
  state.WriteTo(bundle);
  return {};
}

}  // namespace foresight
