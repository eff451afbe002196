#include "core/fitting/cylinder/box_alternative.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/fitting/solids/pattern_search.h"

namespace foresight {
namespace {

constexpr double kLeastSide_m = 0.01;
constexpr int kTurns = 3;  // to start from, within a quarter turn

/// Of the box: place (along its own sides), two tilts, turn about the axis, sides.
SolidPart BoxOf(const CylinderState& cylinder, const Eigen::VectorXd& v) {
  const SolidPart round = cylinder.Part();
  SolidPart box;
  box.shape = SolidPart::Shape::kBox;
  box.size_m = v.tail<3>();
  const Eigen::Quaterniond turn = Eigen::AngleAxisd(v[3], Eigen::Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(v[4], Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(v[5], Eigen::Vector3d::UnitZ());
  box.object_from_part =
      round.object_from_part * Rigid<frame::Object, frame::Object>(turn, v.head<3>());
  return box;
}

PatternSearchOptions StepsFor(const CylinderState& cylinder, double turn_rad) {
  PatternSearchOptions options;
  options.rounds = 5;
  const auto add = [&](int at, double length) {
    options.steps.push_back(length * Eigen::VectorXd::Unit(kBoxAlternativeParameters, at));
  };
  const double step_m = std::max(0.1 * cylinder.radius_m, 0.004);
  const Eigen::Vector3d sides[2] = {{std::cos(turn_rad), std::sin(turn_rad), 0.0},
                                    {-std::sin(turn_rad), std::cos(turn_rad), 0.0}};
  // Each face by itself, so that the one that is seen can stay.
  for (int side = 0; side < 2; ++side)
    for (const double way : {1.0, -1.0}) {
      Eigen::VectorXd step =
          2.0 * step_m * Eigen::VectorXd::Unit(kBoxAlternativeParameters, 6 + side);
      step.head<3>() = way * step_m * sides[side];
      options.steps.push_back(step);
    }
  for (const int at : {0, 1, 2}) add(at, step_m);
  add(3, 0.05);
  add(4, 0.05);
  add(5, 0.15);
  add(8, 2.0 * step_m);
  return options;
}

}  // namespace

double BestBoxScore(const CylinderState& cylinder, const BeamLikelihood& likelihood) {
  double best = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTurns; ++i) {
    const double turn_rad = 0.5 * std::numbers::pi * i / kTurns;
    Eigen::VectorXd start = Eigen::VectorXd::Zero(kBoxAlternativeParameters);
    start[5] = turn_rad;
    // The square of the circle's area.
    start[6] = start[7] = std::sqrt(std::numbers::pi) * cylinder.radius_m;
    start[8] = cylinder.length_m;
    const auto found = ClimbByPatternSearch(
        start,
        [&](const Eigen::VectorXd& v) {
          return v.tail<3>().minCoeff() < kLeastSide_m
                     ? -std::numeric_limits<double>::infinity()
                     : LogLikelihoodOf(BoxOf(cylinder, v), likelihood);
        },
        StepsFor(cylinder, turn_rad));
    best = std::max(best, found.score);
  }
  return best;
}

}  // namespace foresight
