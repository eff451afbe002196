#include "core/fitting/drill/drill_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/parallel.h"
#include "core/fitting/best_distinct.h"
#include "core/fitting/drill/drill_slopes.h"
#include "core/fitting/solids/pattern_search.h"
#include "core/fitting/solids/principal_axes_climb.h"
#include "core/fitting/solids/solid_coverage.h"

namespace foresight {
namespace {

constexpr double kMinBodyHeight_m = 0.04;  // of points that may be a grip's
constexpr double kMaxBodyHeight_m = 0.22;
constexpr std::size_t kBodyTrials = 160;
constexpr std::size_t kBodies = 5;
constexpr double kBodiesApart_m = 0.025;

constexpr int kYaws = 40;  // 9 deg
constexpr std::array<double, 3> kScales = {0.9, 1.0, 1.12};
constexpr std::size_t kModesPerTemplate = 5;
constexpr double kSameMode_m = 0.03;
constexpr double kSameMode_rad = 0.4;

constexpr double kBitStep_m = 0.01;
constexpr double kHeadHeight_m = 0.2;   // about, of any drill
constexpr double kTiltHeight_m = 0.15;  // a lean about this height keeps the body in place

SolidPart BodyCylinder(double radius_m) {
  constexpr double kLow_m = 0.04, kHigh_m = 0.19;
  SolidPart body;
  body.shape = SolidPart::Shape::kCylinder;
  body.size_m = {2.0 * radius_m, 2.0 * radius_m, kHigh_m - kLow_m};
  body.object_from_part = {Eigen::Quaterniond::Identity(), {0.0, 0.0, 0.5 * (kLow_m + kHigh_m)}};
  return body;
}

struct Scored {
  double score;
  Eigen::Vector2d at;
};

/// The best scales at each yaw of a template on a body.
std::vector<DrillState> BestByYaw(const BeamLikelihood& likelihood, const DrillTemplate& kind,
                                  const Eigen::Vector2d& body, const TableFrame& base_from_table,
                                  const DrillPrior& prior) {
  std::vector<DrillState> best(kYaws);
  for (int i = 0; i < kYaws; ++i) {
    DrillState at;
    at.values.head<2>() = body;
    at.values[kDrillYaw] = 2.0 * std::numbers::pi * i / kYaws;
    best[static_cast<std::size_t>(i)] = OfKind(likelihood, kind, at, base_from_table, prior);
  }
  return best;
}

/// The yaws that are better than those beside them. Points that say nothing about the yaw, as those
/// of a vertical line do, make all yaws equal: the first stands for all then.
void AppendPeaks(const std::vector<DrillState>& by_yaw, std::vector<DrillState>& peaks) {
  const std::size_t before = peaks.size();
  for (std::size_t i = 0; i < kYaws; ++i) {
    const double score = by_yaw[i].log_likelihood;
    if (score >= by_yaw[(i + 1) % kYaws].log_likelihood &&
        score > by_yaw[(i + kYaws - 1) % kYaws].log_likelihood)
      peaks.push_back(by_yaw[i]);
  }
  if (peaks.size() == before && std::isfinite(by_yaw.front().log_likelihood))
    peaks.push_back(by_yaw.front());
}

bool SameMode(const DrillState& a, const DrillState& b) {
  return (a.values.head<2>() - b.values.head<2>()).norm() < kSameMode_m &&
         TurnBetween(a.yaw(), b.yaw()) < kSameMode_rad;
}

PatternSearchOptions Steps(LocalSearchEffort effort) {
  PatternSearchOptions options;
  const auto add = [&options](std::initializer_list<std::pair<int, double>> entries) {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(kDrillParameters);
    for (const auto& [parameter, size] : entries) step[parameter] = size;
    options.steps.push_back(step);
  };
  add({{kDrillX, 0.010}});
  add({{kDrillY, 0.010}});
  add({{kDrillYaw, 0.080}});
  add({{kDrillScale, 0.040}});
  add({{kDrillTiltX, 0.050}});
  add({{kDrillTiltY, 0.050}});
  add({{kDrillHeadUp, 0.008}});
  add({{kDrillFront, 0.008}});
  add({{kDrillBack, 0.008}});
  add({{kDrillRake, 0.050}});
  add({{kDrillFootForward, 0.008}});
  add({{kDrillFoot, 0.080}});
  // Thicker or thinner, as tall and on as large a foot as before.
  add({{kDrillScale, 0.040}, {kDrillHeadUp, -0.040 * kHeadHeight_m}, {kDrillFoot, -0.040}});
  options.rounds = 3;
  if (effort == LocalSearchEffort::kCoarse) return options;
  add({{kDrillFootHeight, 0.10}});
  add({{kDrillGrip, 0.06}});
  add({{kDrillHead, 0.06}});
  add({{kDrillZ, 0.004}});
  add({{kDrillBit, 0.010}});
  add({{kDrillNose, 0.08}});
  add({{kDrillChuck, 0.08}});
  add({{kDrillChuckLonger, 0.008}});
  // The head slides; a longer chuck on a shorter nose.
  add({{kDrillFront, 0.008}, {kDrillBack, -0.008}});
  add({{kDrillFront, 0.008}, {kDrillChuckLonger, -0.008}});
  // The grip leans under the head as it was.
  add({{kDrillRake, 0.050}, {kDrillTiltY, -0.050}});
  return options;
}

/// The grip leans about kTiltHeight_m while foot and head stay where they are.
Eigen::VectorXd GripAlone(double yaw) {
  constexpr double kLean_rad = 0.08;
  const double below_m = kLean_rad * kTiltHeight_m;
  const double above_m = kLean_rad * (kHeadHeight_m - kTiltHeight_m);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(kDrillParameters);
  step[kDrillRake] = kLean_rad;
  step[kDrillX] = -below_m * std::cos(yaw);
  step[kDrillY] = -below_m * std::sin(yaw);
  step[kDrillFootForward] = below_m;
  step[kDrillFront] = -above_m;
  step[kDrillBack] = above_m;
  return step;
}

/// The bit's length by trying all: its few rays make many local maxima.
DrillState WithBestBit(const BeamLikelihood& likelihood, const DrillState& state,
                       const TableFrame& base_from_table, const DrillPrior& prior) {
  DrillState best = state;
  const int lengths = static_cast<int>(state.kind->max_bit_length_m / kBitStep_m);
  for (int i = 0; i <= lengths; ++i) {
    DrillState tried = state;
    tried.values[kDrillBit] = i * kBitStep_m;
    tried.log_likelihood = Score(likelihood, tried, base_from_table, prior);
    if (tried.log_likelihood > best.log_likelihood) best = tried;
  }
  return best;
}

}  // namespace

double Score(const BeamLikelihood& likelihood, const DrillState& state,
             const TableFrame& base_from_table, const DrillPrior& prior) {
  const double log_prior = prior(state);
  if (!std::isfinite(log_prior)) return log_prior;
  return LogLikelihoodOf(state.Model().parts, state.Pose(base_from_table), likelihood) + log_prior;
}

std::vector<Eigen::Vector2d> FindBodies(const BeamLikelihood& likelihood,
                                        const std::vector<Eigen::Vector3d>& foreground,
                                        const TableFrame& base_from_table, double radius_m) {
  const auto table_from_base = base_from_table.Inverse();
  const Eigen::Vector2d viewer = (table_from_base * likelihood.rays().viewpoint).head<2>();
  std::vector<Eigen::Vector2d> facing;
  for (const Eigen::Vector3d& point : foreground) {
    const Eigen::Vector3d at = table_from_base * point;
    if (at.z() < kMinBodyHeight_m || at.z() > kMaxBodyHeight_m) continue;
    facing.push_back(at.head<2>() + radius_m * (at.head<2>() - viewer).normalized());
  }
  const std::array<SolidPart, 1> body = {BodyCylinder(radius_m)};
  std::vector<Scored> scored;
  const std::size_t stride = std::max<std::size_t>(1, facing.size() / kBodyTrials);
  for (std::size_t i = 0; i < facing.size(); i += stride) {
    const Rigid<frame::Object, frame::Object> at(Eigen::Quaterniond::Identity(),
                                                 {facing[i].x(), facing[i].y(), 0.0});
    scored.push_back({LogLikelihoodOf(body, base_from_table * at, likelihood), facing[i]});
  }
  std::stable_sort(scored.begin(), scored.end(),
                   [](const Scored& a, const Scored& b) { return a.score > b.score; });
  std::vector<Eigen::Vector2d> bodies;
  for (const Scored& candidate : scored) {
    if (bodies.size() == kBodies) break;
    const auto near = [&](const Eigen::Vector2d& other) {
      return (other - candidate.at).norm() < kBodiesApart_m;
    };
    if (std::none_of(bodies.begin(), bodies.end(), near)) bodies.push_back(candidate.at);
  }
  return bodies;
}

Result<std::vector<DrillState>> FindModes(const BeamLikelihood& likelihood,
                                          std::span<const DrillTemplate> templates,
                                          const std::vector<Eigen::Vector2d>& bodies,
                                          const TableFrame& base_from_table,
                                          const DrillPrior& prior, const RunContext& context) {
  std::vector<std::vector<DrillState>> by_yaw(templates.size() * bodies.size());
  const auto turn = [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    by_yaw[index] = BestByYaw(likelihood, templates[index / bodies.size()],
                              bodies[index % bodies.size()], base_from_table, prior);
  };
  if (!ParallelFor(static_cast<int>(by_yaw.size()), context, turn))
    return Fail(ErrorCode::kCancelled, "fitting the drill was cancelled");
  std::vector<DrillState> modes;
  for (std::size_t kind = 0; kind < templates.size(); ++kind) {
    std::vector<DrillState> of_kind;
    for (std::size_t body = 0; body < bodies.size(); ++body)
      AppendPeaks(by_yaw[kind * bodies.size() + body], of_kind);
    KeepBestDistinct(kModesPerTemplate, &DrillState::log_likelihood, SameMode, of_kind);
    modes.insert(modes.end(), of_kind.begin(), of_kind.end());
  }
  std::stable_sort(modes.begin(), modes.end(), [](const auto& a, const auto& b) {
    return a.log_likelihood > b.log_likelihood;
  });
  return modes;
}

DrillState OfKind(const BeamLikelihood& likelihood, const DrillTemplate& kind,
                  const DrillState& state, const TableFrame& base_from_table,
                  const DrillPrior& prior) {
  // The middle of the grip stays where it is.
  const double forward_m =
      kTiltHeight_m * (state.values[kDrillRake] + state.values[kDrillTiltY] - kind.usual_rake_rad);
  const double right_m = kTiltHeight_m * state.values[kDrillTiltX];
  DrillState best;
  best.log_likelihood = -std::numeric_limits<double>::infinity();
  for (const double scale : kScales) {
    DrillState tried;
    tried.kind = &kind;
    for (const int p : {int{kDrillX}, int{kDrillY}, int{kDrillZ}, int{kDrillYaw}})
      tried.values[p] = state.values[p];
    tried.values[kDrillX] += forward_m * std::cos(state.yaw()) + right_m * std::sin(state.yaw());
    tried.values[kDrillY] += forward_m * std::sin(state.yaw()) - right_m * std::cos(state.yaw());
    tried.values[kDrillRake] = kind.usual_rake_rad;
    tried.values[kDrillScale] = std::clamp(scale, kind.min_scale, kind.max_scale);
    tried.log_likelihood = Score(likelihood, tried, base_from_table, prior);
    if (best.kind == nullptr || tried.log_likelihood > best.log_likelihood) best = tried;
  }
  return best;
}

DrillState LocalSearch(const BeamLikelihood& likelihood, const DrillState& start,
                       const TableFrame& base_from_table, const DrillPrior& prior,
                       LocalSearchEffort effort) {
  DrillState best = start;
  best.log_likelihood = Score(likelihood, start, base_from_table, prior);
  if (effort != LocalSearchEffort::kCoarse)
    best = WithBestBit(likelihood, best, base_from_table, prior);
  const auto at = [&](const Eigen::VectorXd& values) {
    DrillState state = best;
    state.values = values;
    return state;
  };
  const auto score = [&](const Eigen::VectorXd& values) {
    return Score(likelihood, at(values), base_from_table, prior);
  };
  PatternSearchOptions options = Steps(effort);
  const double yaw = best.yaw();
  // A lean about the middle of the body, whose place is known best, moves the foot.
  for (const int tilt : {int{kDrillTiltX}, int{kDrillTiltY}, int{kDrillRake}}) {
    constexpr double kLean_rad = 0.05;
    const Eigen::Vector2d along = tilt == kDrillTiltX
                                      ? Eigen::Vector2d(std::sin(yaw), -std::cos(yaw))
                                      : Eigen::Vector2d(std::cos(yaw), std::sin(yaw));
    Eigen::VectorXd step = Eigen::VectorXd::Zero(kDrillParameters);
    step[tilt] = kLean_rad;
    step.head<2>() = -kTiltHeight_m * kLean_rad * along;
    options.steps.push_back(step);
  }
  if (effort != LocalSearchEffort::kCoarse) options.steps.push_back(GripAlone(yaw));
  const PatternSearchResult found = ClimbByPatternSearch(best.values, score, options);
  const auto shape_at = [&](const Eigen::VectorXd& values) -> ScoreShape {
    const DrillState state = at(values);
    const DrillSlopes slopes = SlopesOf(likelihood.rays(), state, base_from_table, prior);
    return {slopes.scores.colwise().sum().transpose() + prior.Gradient(state), slopes.information};
  };
  const PatternSearchResult top =
      effort == LocalSearchEffort::kFine ? ClimbAlongPrincipalAxes(found, score, shape_at) : found;
  best.values = top.values;
  best.log_likelihood = top.score;
  return best;
}

}  // namespace foresight
