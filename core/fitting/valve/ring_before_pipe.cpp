#include "core/fitting/valve/ring_before_pipe.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/fitting/sampled_coverage.h"
#include "core/fitting/solids/pattern_search.h"
#include "core/fitting/solids/solid_coverage.h"
#include "core/fitting/solids/solid_tracer.h"
#include "core/fitting/valve/valve_coverage.h"

namespace foresight {
namespace {

constexpr double kPipeLength_m = 2.0;
constexpr double kThinnest_m = 0.006, kThickest_m = 0.10;  // radii of pipes
constexpr double kStemLength_m = 0.10;

/// A pipe in the wheel's frame.
enum PipeParameter {
  kAcross,  ///< from the axis, along y
  kDepth,   ///< of its middle behind the rim's plane
  kTurn,    ///< about z, from x
  kLean,    ///< about y
  kRadius,
  kPipeParameters
};

SolidPart PipeOf(const Eigen::VectorXd& pipe) {
  SolidPart part;
  part.shape = SolidPart::Shape::kCylinder;
  part.size_m = {2.0 * pipe[kRadius], 2.0 * pipe[kRadius], kPipeLength_m};
  const Eigen::Vector3d along(std::cos(pipe[kTurn]) * std::cos(pipe[kLean]),
                              std::sin(pipe[kTurn]) * std::cos(pipe[kLean]), std::sin(pipe[kLean]));
  part.object_from_part = {Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), along),
                           {0.0, pipe[kAcross], -pipe[kDepth]}};
  return part;
}

/// Hub and stem, which a pipe does not explain.
SolidPart StemOf(const ValveModel& model) {
  SolidPart part;
  part.shape = SolidPart::Shape::kCylinder;
  part.size_m = {2.0 * model.hub_radius_m, 2.0 * model.hub_radius_m, kStemLength_m};
  part.object_from_part = {Eigen::Quaterniond::Identity(),
                           {0.0, 0.0, -model.dish_m + model.hub_radius_m - 0.5 * kStemLength_m}};
  return part;
}

/// How far behind the rim's plane a pipe's middle is where the pipe touches the rim.
double LeastDepth(const ValveModel& model, const Eigen::VectorXd& pipe) {
  return model.rim_depth_ratio * model.tube_radius_m + pipe[kRadius] +
         std::abs(std::tan(pipe[kLean])) * model.rim_radius_m;
}

/// The larger part of a footprint is the rim's or the pipe's.
CoverBeam CoverByBoth(CoverBeam rim, CoverBeam pipe) {
  return [rim = std::move(rim), pipe = std::move(pipe)](
             const BeamFootprints& footprints, std::size_t ray) -> std::optional<BeamCoverage> {
    const std::optional<BeamCoverage> on_rim = rim(footprints, ray),
                                      on_pipe = pipe(footprints, ray);
    if (!on_rim || !on_pipe) return on_rim ? on_rim : on_pipe;
    return on_rim->fraction >= on_pipe->fraction ? on_rim : on_pipe;
  };
}

PatternSearchOptions PipeSteps() {
  PatternSearchOptions options;
  const double sizes[kPipeParameters] = {0.010, 0.015, 0.08, 0.08, 0.008};
  for (int i = 0; i < kPipeParameters; ++i)
    options.steps.push_back(sizes[i] * Eigen::VectorXd::Unit(kPipeParameters, i));
  return options;
}

}  // namespace

std::optional<double> MarginOverPipe(const BeamLikelihood& likelihood,
                                     const ValveCandidate& valve) {
  const ValveModel& model = valve.model;
  if (model.IsLever() || model.spokes != 2) return std::nullopt;
  const CoverBeam rim = CoverBy(valve, ValveParts::kRim);
  const SolidPart stem = StemOf(model);
  const auto score = [&](const Eigen::VectorXd& pipe) {
    if (pipe[kRadius] < kThinnest_m || pipe[kRadius] > kThickest_m ||
        pipe[kDepth] < LeastDepth(model, pipe))
      return -std::numeric_limits<double>::infinity();
    const SolidPart parts[] = {PipeOf(pipe), stem};
    return likelihood(CoverByBoth(rim, CoverBy(SolidTracer(parts, valve.base_from_object))));
  };
  double best = -std::numeric_limits<double>::infinity();
  for (const double depth : {0.5 * model.dish_m, model.dish_m + model.spoke_radius_m}) {
    Eigen::VectorXd start = Eigen::VectorXd::Zero(kPipeParameters);
    start[kRadius] = std::clamp(model.spoke_radius_m, kThinnest_m, kThickest_m);
    start[kDepth] = std::max(depth, LeastDepth(model, start));
    best = std::max(best, ClimbByPatternSearch(start, score, PipeSteps()).score);
  }
  return likelihood(CoverBy(valve)) - best;
}

}  // namespace foresight
