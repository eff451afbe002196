#include "core/fitting/drill/drill_slopes.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/fitting/drill/support_and_background.h"
#include "tests/support/drill_rays.h"

namespace foresight {
namespace {

DrillState UsualDrill(const std::vector<DrillTemplate>& templates) {
  DrillState state;
  state.kind = &templates.front();
  state.values[kDrillScale] = 1.0;
  state.values[kDrillRake] = state.kind->usual_rake_rad;
  return state;
}

TEST(DrillSlopes, ThePriorsGradientIsItsSlope) {
  const std::vector<DrillTemplate> templates = ShippedDrillTemplates();
  const DrillPrior prior;
  DrillState state = UsualDrill(templates);
  state.values[kDrillTiltX] = 0.02;
  for (int p = kDrillHeadUp; p < kDrillParameters; ++p) state.values[p] += 0.003 * (1 + p % 3);
  const DrillStep gradient = prior.Gradient(state);
  for (int p = 0; p < kDrillParameters; ++p) {
    constexpr double kStep = 1e-5;
    DrillState below = state, above = state;
    below.values[p] -= kStep;
    above.values[p] += kStep;
    if (p == kDrillBit) continue;  // it begins at 0, where the prior ends
    EXPECT_NEAR(gradient[p], (prior(above) - prior(below)) / (2.0 * kStep),
                1e-4 * (1.0 + std::abs(gradient[p])))
        << p;
  }
  EXPECT_EQ(gradient[kDrillBit], 0.0);
}

TEST(DrillSlopes, RaysPullADrillThatStandsBesideItBack) {
  const samples::DrillRays scene = samples::MakeDrillRays({});
  const std::vector<DrillTemplate> templates = ShippedDrillTemplates();
  Random random(1);
  const SupportAndBackground around = FindSupportAndBackground(scene.rays, {}, random);
  const TableFrame frame = FrameOf(around.table.value(), scene.base_from_object.translation());
  const Eigen::Vector3d x =
      (frame.Inverse() * scene.base_from_object).Rotate(Eigen::Vector3d::UnitX());
  DrillState truth = UsualDrill(templates);
  truth.values[kDrillYaw] = std::atan2(x.y(), x.x());
  const Eigen::Vector2d away = (frame.Inverse() * scene.rays.viewpoint).head<2>().normalized();
  for (const double off_m : {-0.006, 0.006}) {
    DrillState beside = truth;
    beside.values.head<2>() += off_m * away;
    const DrillSlopes slopes = SlopesOf(scene.rays, beside, frame, {});
    const DrillStep pull = slopes.scores.colwise().sum().transpose();
    EXPECT_LT(off_m * pull.head<2>().dot(away), 0.0) << off_m;
    // The step that the information makes of it is about as long as the drill is off.
    const DrillStep step = slopes.information.ldlt().solve(pull);
    EXPECT_LT((off_m * away + step.head<2>()).norm(), 0.8 * std::abs(off_m)) << off_m;
  }
}

}  // namespace
}  // namespace foresight
