#include "core/selfcheck/gather_rig.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/selfcheck/seen_drifts.h"

namespace foresight {
namespace {

/// Measurements of the same unknowns, averaged by their covariances.
class WeightedMean {
 public:
  explicit WeightedMean(Eigen::Index unknowns)
      : information_(Eigen::MatrixXd::Zero(unknowns, unknowns)),
        sum_(Eigen::VectorXd::Zero(unknowns)) {}

  void Add(const Eigen::VectorXd& value, const Eigen::MatrixXd& covariance) {
    const Eigen::MatrixXd information = covariance.inverse();
    information_ += information;
    sum_ += information * value;
    // What a scan does not see adds no misfit.
    constexpr double kUnseenVariance = 1.0;
    for (Eigen::Index i = 0; i < value.size(); ++i) unseen_ += covariance(i, i) >= kUnseenVariance;
    values_.push_back(value);
    informations_.push_back(information);
  }

  int count() const { return static_cast<int>(values_.size()); }
  Eigen::VectorXd Mean() const { return information_.inverse() * sum_; }

  /// Wider where the measurements differ by more than their covariances say.
  Eigen::MatrixXd Covariance() const {
    const Eigen::VectorXd mean = Mean();
    double misfit = 0.0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const Eigen::VectorXd off = values_[i] - mean;
      misfit += off.dot(informations_[i] * off);
    }
    const double freedoms = static_cast<double>((count() - 1) * mean.size() - unseen_);
    const double factor = freedoms > 0.0 ? std::max(1.0, misfit / freedoms) : 1.0;
    return factor * information_.inverse();
  }

 private:
  Eigen::MatrixXd information_;
  Eigen::VectorXd sum_;
  Eigen::Index unseen_ = 0;
  std::vector<Eigen::VectorXd> values_;
  std::vector<Eigen::MatrixXd> informations_;
};

/// Why no scan says anything.
tl::unexpected<Error> NothingIn(std::span<const RigCheck> checks, std::string RigCheck::*why) {
  return Fail(ErrorCode::kTooFewPoints, "{}",
              checks.empty() ? "there is no scan" : checks.front().*why);
}

Result<CameraCheck> GatherCamera(std::span<const RigCheck> checks) {
  WeightedMean turns(3);
  CameraCheck gathered;
  double gain = 0.0, edges = 0.0;
  gathered.outward_px.setZero();
  for (const RigCheck& check : checks) {
    if (!check.camera) continue;
    const CameraCheck& camera = *check.camera;
    turns.Add(camera.turn_rad, camera.covariance);
    gain += camera.gain_sigmas;
    edges += camera.edges;
    gathered.images += camera.images;
    gathered.scans = turns.count();
    gathered.score += camera.edges * camera.score;
    gathered.score_before += camera.edges * camera.score_before;
    gathered.score_aside += camera.edges * camera.score_aside;
    gathered.outward_px += camera.edges * camera.outward_px;
  }
  if (turns.count() == 0) return NothingIn(checks, &RigCheck::no_camera);
  gathered.turn_rad = turns.Mean();
  gathered.covariance = turns.Covariance();
  gathered.edges = static_cast<int>(edges);
  gathered.score /= edges;
  gathered.score_before /= edges;
  gathered.score_aside /= edges;
  gathered.outward_px /= edges;
  // Gains of several scans, each by its own deviation.
  gathered.gain_sigmas = gain / std::sqrt(turns.count());
  return gathered;
}

Result<PlateCheck> GatherPlate(std::span<const RigCheck> checks) {
  WeightedMean drifts(PlateCheck::kUnknowns);
  PlateCheck gathered;
  double squares = 0.0, speeds = 0.0;
  for (const RigCheck& check : checks) {
    if (!check.plate) continue;
    const PlateCheck seen = WithSeenDrifts(*check.plate);
    drifts.Add(seen.drift, seen.covariance);
    gathered.up_and_down |= check.plate->up_and_down;
    gathered.planes += check.plate->planes;
    gathered.cells += check.plate->cells;
    squares += check.plate->cells * std::pow(check.plate->residual_m, 2);
    speeds += check.plate->cells * std::pow(check.plate->speed_rad_s, 2);
  }
  if (drifts.count() == 0) return NothingIn(checks, &RigCheck::no_plate);
  gathered.drift = drifts.Mean();
  gathered.covariance = drifts.Covariance();
  gathered.residual_m = std::sqrt(squares / gathered.cells);
  gathered.speed_rad_s = std::sqrt(speeds / gathered.cells);
  return gathered;
}

Result<TurnCheck> GatherTurns(std::span<const RigCheck> checks) {
  WeightedMean drifts(TurnCheck::kUnknowns);
  TurnCheck gathered;
  for (const RigCheck& check : checks)
    if (check.turns) gathered.spread_rad = std::max(gathered.spread_rad, check.turns->spread_rad);
  for (const RigCheck& check : checks) {
    if (!check.turns) continue;
    TurnCheck known = *check.turns;
    // A bend is halfway between a scan's own outermost images: those of another spread have
    // another.
    constexpr double kLikeSpread = 0.8;
    known.bend_seen &= known.spread_rad > kLikeSpread * gathered.spread_rad;
    const TurnCheck seen = WithSeenDrifts(known);
    drifts.Add(seen.drift, seen.covariance);
    gathered.bend_seen |= known.bend_seen;
    gathered.images += known.images;
    gathered.points += known.points;
    gathered.explained += known.points * known.explained;
  }
  if (drifts.count() == 0) return NothingIn(checks, &RigCheck::no_turns);
  gathered.drift = drifts.Mean();
  gathered.covariance = drifts.Covariance();
  gathered.explained /= gathered.points;
  return gathered;
}

Result<PassCheck> GatherPasses(std::span<const RigCheck> checks) {
  WeightedMean stamps(1);
  PassCheck gathered;
  double speeds = 0.0;
  for (const RigCheck& check : checks) {
    if (!check.passes) continue;
    const PassCheck& passes = *check.passes;
    stamps.Add(Eigen::VectorXd::Constant(1, passes.stamp_s),
               Eigen::MatrixXd::Constant(1, 1, passes.sigma_s * passes.sigma_s));
    gathered.patches += passes.patches;
    speeds += passes.speed_rad_s;
  }
  if (stamps.count() == 0) return NothingIn(checks, &RigCheck::no_passes);
  gathered.stamp_s = stamps.Mean()[0];
  gathered.sigma_s = std::sqrt(stamps.Covariance()(0, 0));
  gathered.speed_rad_s = speeds / stamps.count();
  return gathered;
}

}  // namespace

RigCheck GatherRig(std::span<const RigCheck> checks, const SensorRig& rig,
                   const RigCheckLimits& limits) {
  return JudgeRig(rig, GatherPlate(checks), GatherCamera(checks), GatherTurns(checks),
                  GatherPasses(checks), limits);
}

}  // namespace foresight
