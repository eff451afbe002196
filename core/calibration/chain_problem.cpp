#include "core/calibration/chain_problem.h"

#include <ceres/ceres.h>

#include <cmath>

#include "core/base/parallel.h"
#include "core/calibration/chain_angles.h"
#include "core/calibration/chain_costs.h"
#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"
#include "core/geometry/symmetric_eigen.h"

namespace foresight {
namespace {

using chain::BlockOf;
using chain::PoseBlock;
using chain::PoseOf;

/// Steps of a pose in its own frame, tangent.h: of all 6, or without turn and shift along x.
class PoseManifold : public ceres::Manifold {
 public:
  explicit PoseManifold(std::vector<int> steps) : steps_(std::move(steps)) {}

  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return static_cast<int>(steps_.size()); }

  bool Plus(const double* x, const double* delta, double* moved) const override {
    Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::size_t i = 0; i < steps_.size(); ++i) step[steps_[i]] = delta[i];
    const auto pose = PoseOf<frame::Camera, frame::Pattern>(x);
    const PoseBlock block = BlockOf(Perturbed(pose, step));
    std::copy(block.begin(), block.end(), moved);
    return true;
  }

  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> map(
        jacobian, 7, TangentSize());
    map.setZero();
    for (std::size_t i = 0; i < steps_.size(); ++i)
      map(steps_[i], static_cast<Eigen::Index>(i)) = 1.0;
    return true;
  }

  // Only solvers that are not used here ask for these.
  bool Minus(const double*, const double*, double*) const override { return false; }
  bool MinusJacobian(const double*, double*) const override { return false; }

 private:
  std::vector<int> steps_;
};

/// Stops the solver when the caller asks for it.
class StopCallback : public ceres::IterationCallback {
 public:
  explicit StopCallback(const RunContext& context) : context_(context) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    context_.Report(std::min(1.0, summary.iteration / 10.0), "least squares");
    return context_.Cancelled() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const RunContext& context_;
};

/// The unknowns as Ceres moves them, and the problem on them.
class Chain {
 public:
  Chain(const ChainData& data, const ChainSolveOptions& options, const ChainState& state);

  ceres::Problem& problem() { return *problem_; }
  void WriteTo(ChainState* state) const;

  /// Free blocks with their unknowns' names: those that all measurements share.
  struct SharedBlock {
    double* values;
    std::vector<SharedUnknown> unknowns;
  };
  std::vector<SharedBlock> SharedBlocks();
  std::vector<double*> PrivateBlocks();

 private:
  void AddCorners(const CornerSet& corners);
  void AddHits(const BoardHits& hits, const MotorTrack* track);
  void AddPriors();
  void AddBlocks();
  bool IsFree(const double* block) const {
    return problem_->HasParameterBlock(block) && !problem_->IsParameterBlockConstant(block) &&
           problem_->ParameterBlockTangentSize(block) > 0;
  }

  ChainSolveOptions options_;
  ChainState start_;
  std::vector<double> camera_;
  PoseBlock head_, lidar_, mount_;
  std::vector<double> angles_;
  std::vector<PoseBlock> poses_, views_;
  std::vector<double> jitter_;
  double range_offset_, stamp_offset_;
  std::shared_ptr<const chain::AngleTable> table_;
  PoseManifold all_steps_{{0, 1, 2, 3, 4, 5}};
  PoseManifold axis_steps_{{1, 2, 4, 5}};
  std::unique_ptr<ceres::Manifold> angles_but_one_;
  std::unique_ptr<ceres::Problem> problem_;
};

Chain::Chain(const ChainData& data, const ChainSolveOptions& options, const ChainState& state)
    : options_(options),
      start_(state),
      head_(BlockOf(state.camera_from_head)),
      lidar_(BlockOf(state.camera_from_lidar)),
      mount_(BlockOf(state.a_from_b)),
      angles_(state.plate_rad),
      jitter_(state.jitter_rad),
      range_offset_(state.range_offset_m),
      stamp_offset_(state.stamp_offset_s),
      table_(std::make_shared<chain::AngleTable>(state.motor_rad)) {
  const CameraModel::Parameters values = state.camera.Values();
  camera_.assign(values.data(), values.data() + values.size());
  for (const auto& pose : state.base_from_pattern) poses_.push_back(BlockOf(pose));
  for (const auto& view : state.camera_from_view) views_.push_back(BlockOf(view));
  ceres::Problem::Options problem_options;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_ = std::make_unique<ceres::Problem>(problem_options);
  AddBlocks();
  for (const CornerSet& corners : data.corners) AddCorners(corners);
  for (const BoardHits& hits : data.hits)
    AddHits(hits,
            data.tracks.empty() ? nullptr : &data.tracks[static_cast<std::size_t>(hits.pose)]);
  AddPriors();
}

void Chain::AddBlocks() {
  const FreeUnknowns& free = options_.free;
  const auto add_pose = [&](PoseBlock& block, ceres::Manifold* manifold, bool is_free) {
    problem_->AddParameterBlock(block.data(), 7, manifold);
    if (!is_free) problem_->SetParameterBlockConstant(block.data());
  };
  const auto add_number = [&](double& value, bool is_free) {
    problem_->AddParameterBlock(&value, 1);
    if (!is_free) problem_->SetParameterBlockConstant(&value);
  };
  problem_->AddParameterBlock(camera_.data(), static_cast<int>(camera_.size()));
  if (!free.camera) problem_->SetParameterBlockConstant(camera_.data());
  add_pose(head_, &axis_steps_, free.head);
  add_pose(lidar_, &all_steps_, free.lidar);
  add_pose(mount_, &all_steps_, free.mount);
  for (PoseBlock& pose : poses_) add_pose(pose, &all_steps_, free.head);
  for (PoseBlock& view : views_) add_pose(view, &all_steps_, free.views);
  for (double& jitter : jitter_) add_number(jitter, free.jitter);
  add_number(range_offset_, free.range_offset);
  add_number(stamp_offset_, free.stamp_offset);
  if (angles_.empty()) return;
  angles_but_one_ = std::make_unique<ceres::SubsetManifold>(
      static_cast<int>(angles_.size()), std::vector<int>{start_.reference_stop});
  problem_->AddParameterBlock(angles_.data(), static_cast<int>(angles_.size()),
                              angles_but_one_.get());
  if (!free.head || angles_.size() == 1) problem_->SetParameterBlockConstant(angles_.data());
}

void Chain::AddCorners(const CornerSet& corners) {
  if (corners.view != CornerSet::kNone) {
    problem_->AddResidualBlock(
        chain::MakeViewCost(corners, start_.camera, options_.noise.corner_px).release(), nullptr,
        camera_.data(), views_[static_cast<std::size_t>(corners.view)].data());
    return;
  }
  std::vector<double*> blocks = {camera_.data(), head_.data(), angles_.data(),
                                 &jitter_[static_cast<std::size_t>(corners.visit)],
                                 poses_[static_cast<std::size_t>(corners.pose)].data()};
  if (corners.on_b) blocks.push_back(mount_.data());
  problem_->AddResidualBlock(
      chain::MakeMountCost(corners, start_.camera, static_cast<int>(angles_.size()),
                           options_.noise.corner_px)
          .release(),
      nullptr, blocks);
}

void Chain::AddHits(const BoardHits& hits, const MotorTrack* track) {
  if (hits.returns.empty()) return;
  const bool in_sweep = hits.visit == BoardHits::kNone;
  double* own = in_sweep ? &stamp_offset_ : &jitter_[static_cast<std::size_t>(hits.visit)];
  std::vector<double*> blocks = {lidar_.data(), &range_offset_,
                                 head_.data(),  angles_.data(),
                                 own,           poses_[static_cast<std::size_t>(hits.pose)].data()};
  if (hits.on_b) blocks.push_back(mount_.data());
  const chain::HitCostOptions options{options_.residual, options_.huber_sigmas};
  problem_->AddResidualBlock(chain::MakeHitCost(hits, table_, track, options).release(), nullptr,
                             blocks);
}

void Chain::AddPriors() {
  if (options_.free.jitter)
    for (double& jitter : jitter_)
      problem_->AddResidualBlock(chain::MakePriorCost(options_.noise.repeatability_rad).release(),
                                 nullptr, &jitter);
  if (options_.free.range_offset)
    problem_->AddResidualBlock(chain::MakePriorCost(options_.noise.range_offset_m).release(),
                               nullptr, &range_offset_);
}

void Chain::WriteTo(ChainState* state) const {
  CameraModel::Parameters values = start_.camera.Values();
  std::copy(camera_.begin(), camera_.end(), values.data());
  state->camera = start_.camera.WithValues(values);
  state->camera_from_head = PoseOf<frame::Camera, frame::Head>(head_.data());
  state->camera_from_lidar = PoseOf<frame::Camera, frame::Lidar>(lidar_.data());
  state->a_from_b = PoseOf<frame::Pattern, frame::Pattern>(mount_.data());
  state->plate_rad = angles_;
  state->jitter_rad = jitter_;
  state->range_offset_m = range_offset_;
  state->stamp_offset_s = stamp_offset_;
  for (std::size_t i = 0; i < poses_.size(); ++i)
    state->base_from_pattern[i] = PoseOf<frame::Base, frame::Pattern>(poses_[i].data());
  for (std::size_t i = 0; i < views_.size(); ++i)
    state->camera_from_view[i] = PoseOf<frame::Camera, frame::Pattern>(views_[i].data());
}

/// Turn and shift of a pose in its own frame.
std::vector<SharedUnknown> PoseUnknowns(const std::string& name, const std::string& in_words,
                                        const std::vector<const char*>& axes_in_words,
                                        const std::string& hint) {
  std::vector<SharedUnknown> unknowns;
  for (const bool turn : {true, false})
    for (std::size_t axis = 0; axis < 3; ++axis)
      unknowns.push_back({fmt::format("{} {} {}", name, turn ? "turn" : "shift", "xyz"[axis]),
                          fmt::format("{} {} {}", turn ? "the turn of" : "the place of", in_words,
                                      fmt::format(fmt::runtime(turn ? "about {}" : "along {}"),
                                                  axes_in_words[axis])),
                          turn ? "rad" : "m", hint});
  return unknowns;
}

std::vector<SharedUnknown> CameraUnknowns(const CameraModel& camera) {
  std::vector<SharedUnknown> unknowns;
  for (const std::string_view name : camera.ParameterNames()) {
    const bool in_pixels = unknowns.size() < 4;
    unknowns.push_back({std::string(name), fmt::format("{} of the camera", name),
                        in_pixels ? "px" : "",
                        "add images of a board that is near, tilted, and at the image's edges"});
  }
  return unknowns;
}

std::vector<Chain::SharedBlock> Chain::SharedBlocks() {
  const std::string more_poses = "add poses of the stand at other places and elevations";
  const std::string hinges = "add poses with the hinge turned and the stand tilted";
  std::vector<SharedBlock> blocks;
  blocks.push_back({camera_.data(), CameraUnknowns(start_.camera)});
  blocks.push_back(
      {head_.data(),
       {{"axis turn y", "the direction of the motor's axis, about the head's y", "rad", more_poses},
        {"axis turn z", "the direction of the motor's axis, about the head's z", "rad", more_poses},
        {"axis shift y", "the place of the motor's axis along the head's y", "m", more_poses},
        {"axis shift z", "the place of the motor's axis along the head's z", "m", more_poses}}});
  SharedBlock angles{angles_.data(), {}};
  for (std::size_t stop = 0; stop < angles_.size(); ++stop) {
    if (static_cast<int>(stop) == start_.reference_stop) continue;
    const double degrees = DegreesFromRadians(start_.motor_rad[stop]);
    angles.unknowns.push_back({fmt::format("plate angle at {:.6g} deg", degrees),
                               fmt::format("the plate's angle at the stop {:.6g} deg", degrees),
                               "rad", "add poses of the stand that this stop sees"});
  }
  blocks.push_back(std::move(angles));
  blocks.push_back({mount_.data(), PoseUnknowns("board B", "board B on the stand",
                                                {"its rows", "its columns", "its normal"},
                                                "add images that show both boards")});
  blocks.push_back({lidar_.data(), PoseUnknowns("lidar", "the lidar against the camera",
                                                {"the lidar's x (ahead)", "the lidar's y (left)",
                                                 "the lidar's z (spin axis)"},
                                                hinges)});
  blocks.push_back(
      {&range_offset_, {{"range offset", "the offset of the lidar's ranges", "m", hinges}}});
  blocks.push_back(
      {&stamp_offset_,
       {{"stamp offset", "the offset of the lidar's time stamps", "s",
         "sweep up and down at 50 deg/s or more, in front of a stand whose hinge is level"}}});
  std::erase_if(blocks, [this](const SharedBlock& block) { return !IsFree(block.values); });
  return blocks;
}

std::vector<double*> Chain::PrivateBlocks() {
  std::vector<double*> blocks;
  for (PoseBlock& pose : poses_) blocks.push_back(pose.data());
  for (PoseBlock& view : views_) blocks.push_back(view.data());
  for (double& jitter : jitter_) blocks.push_back(&jitter);
  std::erase_if(blocks, [this](const double* block) { return !IsFree(block); });
  return blocks;
}

/// J^T J with unit diagonal, and what was divided out.
struct ScaledNormal {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd scale;
};

ScaledNormal NormalOf(const ceres::CRSMatrix& jacobian) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(jacobian.num_cols, jacobian.num_cols);
  for (int row = 0; row < jacobian.num_rows; ++row)
    for (int i = jacobian.rows[row]; i < jacobian.rows[row + 1]; ++i)
      for (int j = jacobian.rows[row]; j < jacobian.rows[row + 1]; ++j)
        normal(jacobian.cols[i], jacobian.cols[j]) += jacobian.values[i] * jacobian.values[j];
  ScaledNormal scaled;
  scaled.scale = normal.diagonal().cwiseSqrt();
  // A column of zeros stays one: it is an unknown that no measurement depends on.
  const Eigen::VectorXd inverse =
      (scaled.scale.array() > 0.0).select(scaled.scale.cwiseInverse(), 0.0);
  scaled.matrix = inverse.asDiagonal() * normal * inverse.asDiagonal();
  return scaled;
}

}  // namespace

Status ChainNoise::Check() const {
  for (const auto& [name, value] : {std::pair<const char*, double>("corner_px", corner_px),
                                    {"repeatability_rad", repeatability_rad},
                                    {"range_offset_m", range_offset_m}})
    if (!(value > 0.0) || !std::isfinite(value))
      return Fail(ErrorCode::kInvalidOptions, "calibration: {} {} is not positive", name, value);
  return {};
}

int ChainCovariance::Find(const std::string& name) const {
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].name == name) return static_cast<int>(i);
  return -1;
}

Result<ChainFit> SolveChain(const ChainData& data, const ChainSolveOptions& options,
                            ChainState* state, const RunContext& context) {
  FORESIGHT_CHECK(options.noise.Check());
  Chain chain(data, options, *state);
  StopCallback stop(context);
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = 1e-9;
  solver.parameter_tolerance = 1e-10;
  solver.num_threads = ThreadCount(context);
  solver.logging_type = ceres::SILENT;
  solver.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &chain.problem(), &summary);
  if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "calibration: cancelled");
  if (!summary.IsSolutionUsable())
    return Fail(ErrorCode::kNoConvergence, "calibration: least squares found no answer: {}",
                summary.message);
  if (summary.termination_type == ceres::NO_CONVERGENCE)
    return Fail(ErrorCode::kNoConvergence, "calibration: no convergence after {} steps",
                options.max_iterations);
  chain.WriteTo(state);
  return ChainFit{.cost = 2.0 * (summary.final_cost - summary.fixed_cost),
                  .residuals = summary.num_residuals_reduced,
                  .unknowns = summary.num_effective_parameters_reduced,
                  .iterations = static_cast<int>(summary.iterations.size())};
}

Result<ChainCovariance> CovarianceOfChain(const ChainData& data, const ChainSolveOptions& options,
                                          const ChainState& state) {
  Chain chain(data, options, state);
  ceres::Problem::EvaluateOptions evaluate;
  ChainCovariance covariance;
  for (const Chain::SharedBlock& block : chain.SharedBlocks()) {
    evaluate.parameter_blocks.push_back(block.values);
    covariance.unknowns.insert(covariance.unknowns.end(), block.unknowns.begin(),
                               block.unknowns.end());
  }
  for (double* block : chain.PrivateBlocks()) evaluate.parameter_blocks.push_back(block);
  ceres::CRSMatrix jacobian;
  if (!chain.problem().Evaluate(evaluate, nullptr, nullptr, nullptr, &jacobian))
    return Fail(ErrorCode::kNoConvergence, "calibration: the covariance cannot be computed");

  const ScaledNormal normal = NormalOf(jacobian);
  const SymmetricEigen eigen = EigenOf(normal.matrix);
  const auto shared = static_cast<Eigen::Index>(covariance.unknowns.size());
  constexpr double kLeastEigenvalue = 1e-11;  // rounding leaves 1e-15 times the number of unknowns
  if (eigen.values[0] < kLeastEigenvalue) {
    Eigen::Index worst = 0;
    eigen.vectors.col(0).head(shared).cwiseAbs().maxCoeff(&worst);
    const SharedUnknown& unknown = covariance.unknowns[static_cast<std::size_t>(worst)];
    return Fail(ErrorCode::kTooFewPoints, "calibration: the data do not say {}: {}",
                unknown.in_words, unknown.hint);
  }
  const Eigen::MatrixXd half = normal.scale.head(shared).cwiseInverse().asDiagonal() *
                               eigen.vectors.topRows(shared) *
                               eigen.values.cwiseSqrt().cwiseInverse().asDiagonal();
  covariance.matrix = half * half.transpose();
  return covariance;
}

std::vector<double> RangeResiduals(const ChainData& data, const ChainState& state,
                                   const BoardHits& hits) {
  const PlateAngles plate(data, state);
  const auto base_from_mount = state.base_from_pattern[static_cast<std::size_t>(hits.pose)];
  const auto base_from_board = hits.on_b ? base_from_mount * state.a_from_b : base_from_mount;
  const auto head_from_lidar = state.camera_from_head.Inverse() * state.camera_from_lidar;
  std::vector<double> residuals;
  for (const LidarReturn& r : hits.returns) {
    const double plate_rad = plate.At(hits.pose, hits.stop, hits.visit, r.time_s);
    const auto board_from_lidar =
        base_from_board.Inverse() * HeadFromBase(plate_rad).Inverse() * head_from_lidar;
    const double along = board_from_lidar.Rotate(r.direction).z();
    const double depth =
        (board_from_lidar * ((r.range_m + state.range_offset_m) * r.direction)).z();
    residuals.push_back(std::abs(along) < 0.02 ? std::nan("") : depth / along);
  }
  return residuals;
}

std::vector<Eigen::Vector2d> CornerResiduals(const ChainState& state, const CornerSet& corners) {
  Rigid<frame::Camera, frame::Pattern> camera_from_board;
  if (corners.view != CornerSet::kNone) {
    camera_from_board = state.camera_from_view[static_cast<std::size_t>(corners.view)];
  } else {
    const double jitter = state.jitter_rad[static_cast<std::size_t>(corners.visit)];
    camera_from_board = state.CameraFromBase(corners.stop, jitter) *
                        state.base_from_pattern[static_cast<std::size_t>(corners.pose)];
    if (corners.on_b) camera_from_board = camera_from_board * state.a_from_b;
  }
  std::vector<Eigen::Vector2d> residuals;
  for (std::size_t i = 0; i < corners.pixels.size(); ++i) {
    const auto pixel = state.camera.Project(camera_from_board * corners.on_board[i]);
    residuals.push_back(pixel ? Eigen::Vector2d(corners.pixels[i] - *pixel)
                              : Eigen::Vector2d::Constant(std::nan("")));
  }
  return residuals;
}

}  // namespace foresight
