#include "core/fitting/valve/ring_before_pipe.h"

#include <gtest/gtest.h>

#include "core/fitting/valve/fit_valve.h"
#include "core/fitting/valve/valve_coverage.h"
#include "core/fitting/wall.h"
#include "tests/support/valve_rays.h"

namespace foresight {
namespace {

using samples::MakeValveScene;
using samples::RandomValveView;
using samples::ValveScene;
using samples::ValveView;

/// Two spokes that lie behind the rim, or a pipe there.
ValveScene TwoSpokes(ValveView::Object object, double spoke_radius_m) {
  ValveView view = RandomValveView(3);
  view.object = object;
  view.distance_m = 1.2;
  view.wall_m = 0.16;
  view.model.spokes = 2;
  view.model.dish_m = 0.06;
  view.model.spoke_radius_m = spoke_radius_m;
  return MakeValveScene(view);
}

BeamLikelihood LikelihoodOf(const RaySet& rays) {
  Random random(1);
  return ValveLikelihood(rays, SplitWall(rays, random).wall);
}

TEST(RingBeforePipe, SpokesEndAtTheRim) {
  const ValveScene scene = TwoSpokes(ValveView::Object::kWheel, 0.008);
  const auto margin = MarginOverPipe(LikelihoodOf(scene.rays), scene.truth);
  ASSERT_TRUE(margin);
  EXPECT_GT(*margin, 20.0);
}

TEST(RingBeforePipe, APipeGoesOnBeyondTheRim) {
  const ValveScene scene = TwoSpokes(ValveView::Object::kRing, 0.02);
  const auto margin = MarginOverPipe(LikelihoodOf(scene.rays), scene.truth);
  ASSERT_TRUE(margin);
  EXPECT_LT(*margin, -20.0);
}

TEST(RingBeforePipe, NoPipeLooksLikeOtherSpokes) {
  ValveScene scene = TwoSpokes(ValveView::Object::kWheel, 0.008);
  const BeamLikelihood likelihood = LikelihoodOf(scene.rays);
  scene.truth.model.spokes = 3;
  EXPECT_FALSE(MarginOverPipe(likelihood, scene.truth));
  scene.truth.model.spokes = 0;
  EXPECT_FALSE(MarginOverPipe(likelihood, scene.truth));
  scene.truth.model.kind = ValveModel::Kind::kLever;
  EXPECT_FALSE(MarginOverPipe(likelihood, scene.truth));
}

TEST(RingBeforePipe, IsNotConfirmed) {
  const ValveScene scene = TwoSpokes(ValveView::Object::kRing, 0.02);
  const auto found = FitValve(scene.rays, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NE(found->verdict.level, VerdictLevel::kConfirmed) << found->verdict.reason;
}

}  // namespace
}  // namespace foresight
