#include "core/fitting/gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/fitting/common_gates.h"
#include "core/fitting/cylinder/cylinder_verdict.h"
#include "core/fitting/drill/drill_verdict.h"
#include "core/fitting/handle/handle_verdict.h"
#include "core/fitting/terrain/terrain_verdict.h"
#include "core/fitting/valve/valve_verdict.h"
#include "tests/support/gate_sentence.h"

namespace foresight {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr int kAnswers = 500;

TEST(Gate, SaysItsNumberItsLimitAndWhatToDo) {
  const Gate gate{.what = "{} measurements lie on the valve",
                  .number = 31.0,
                  .limit = 40.0,
                  .advice = "scan slower"};
  EXPECT_TRUE(gate.Failed());
  EXPECT_EQ(gate.Sentence(), "31 measurements lie on the valve (at least 40): scan slower");
}

TEST(Gate, ANumberOnItsLimitHasNotFailed) {
  EXPECT_FALSE((Gate{.what = "{}", .number = 40.0, .limit = 40.0}.Failed()));
  EXPECT_FALSE(
      (Gate{.what = "{}", .number = 40.0, .side = Gate::Side::kAtMost, .limit = 40.0}.Failed()));
  EXPECT_TRUE((Gate{.what = "{}", .number = std::nan(""), .limit = 40.0}.Failed()));
}

TEST(CommonGates, ANumberAtEitherEndOfItsRangeIsTold) {
  const auto told = [](double radius_m) {
    std::vector<std::string> failed;
    AddIfOutside({.what = "its radius is {}", .unit = Gate::Unit::kLength, .number = radius_m},
                 0.05, 0.30, failed);
    return failed;
  };
  EXPECT_THAT(told(0.04), ElementsAre("its radius is 40 mm (at least 50 mm)"));
  EXPECT_THAT(told(0.31), ElementsAre("its radius is 310 mm (at most 300 mm)"));
  EXPECT_THAT(told(0.05), IsEmpty());
  EXPECT_THAT(told(0.30), IsEmpty());
}

TEST(Gate, ShowsAsManyDigitsAsTellTheNumberFromTheLimit) {
  const auto sentence = [](Gate::Unit unit, double number, double limit) {
    return Gate{.what = "{}",
                .unit = unit,
                .number = number,
                .side = number < limit ? Gate::Side::kAtLeast : Gate::Side::kAtMost,
                .limit = limit}
        .Sentence();
  };
  EXPECT_EQ(sentence(Gate::Unit::kFraction, 0.1502, 0.15), "15.02 % (at most 15 %)");
  EXPECT_EQ(sentence(Gate::Unit::kCount, 39.7, 40.0), "39.7 (at least 40)");
  EXPECT_EQ(sentence(Gate::Unit::kLength, 0.1804, 0.15), "180 mm (at most 150 mm)");
  EXPECT_EQ(sentence(Gate::Unit::kAngle, 0.06, 0.04), "3.4 deg (at most 2.3 deg)");
  EXPECT_EQ(sentence(Gate::Unit::kRatio, 1.203, 1.19), "1.20 (at most 1.19)");
  EXPECT_EQ(sentence(Gate::Unit::kCount, 40.0 - 1e-9, 40.0), "just under 40 (at least 40)");
}

TEST(Gate, ToldOddsAreThoseOfTheLikelihoods) {
  const auto sentence = [](double nats, double limit) {
    return Gate{.what = "{}", .unit = Gate::Unit::kOdds, .number = nats, .limit = limit}.Sentence();
  };
  EXPECT_EQ(sentence(std::log(12.0), std::log(90.0)), "12 : 1 (at least 90 : 1)");
  EXPECT_EQ(sentence(-41.0, 1e-300), "1 : 10^18 (at least 1 : 1)");
  EXPECT_EQ(sentence(-12.0, 30.0), "1 : 160000 (at least 10^13 : 1)");
}

// "10^13.01 : 1" beside an answer that is not CONFIRMED for it needs a word of explanation.
TEST(Gate, WhyLargeOddsAreNotEnoughIsTold) {
  Gate gate{.what = "{}", .unit = Gate::Unit::kOdds, .number = 12.0, .limit = 30.0};
  EXPECT_EQ(gate.Sentence(), "160000 : 1 (at least 10^13 : 1; computed odds run high)");
  gate.number = 29.95;
  EXPECT_EQ(gate.Sentence(), "10^13.01 : 1 (at least 10^13.03 : 1; computed odds run high)");
  gate.number = 9.0, gate.limit = 10.0;
  EXPECT_EQ(gate.Sentence(), "8100 : 1 (at least 22000 : 1; computed odds run high)");
  gate.kind = Gate::Kind::kUsual;
  EXPECT_EQ(gate.Sentence(), "8100 : 1 (usually at least 22000 : 1)");
}

TEST(Gate, ItsNumberIsOnTheWrongSideOfItsLimitInEveryUnit) {
  Random random(7);
  for (const Gate::Unit unit : {Gate::Unit::kCount, Gate::Unit::kFraction, Gate::Unit::kRatio,
                                Gate::Unit::kLength, Gate::Unit::kAngle, Gate::Unit::kOdds})
    for (int i = 0; i < kAnswers; ++i) {
      Gate gate{.what = "of the 7 things {} are", .unit = unit};
      const double scale = unit == Gate::Unit::kOdds    ? 50.0
                           : unit == Gate::Unit::kCount ? 99.0
                                                        : 1.0;
      gate.limit = scale * random.Uniform();
      // From far off to a hair's breadth.
      const double off = scale * std::pow(10.0, random.Uniform(-9.0, 0.5));
      gate.side = random.Index(2) == 0 ? Gate::Side::kAtLeast : Gate::Side::kAtMost;
      gate.number = gate.limit + (gate.side == Gate::Side::kAtLeast ? -off : off);
      const auto stated = samples::StatedGates(gate.Sentence());
      ASSERT_EQ(stated.size(), 1u) << gate.Sentence();
      ASSERT_TRUE(stated.front().Fails()) << gate.Sentence();
      ASSERT_EQ(stated.front().at_least, gate.side == Gate::Side::kAtLeast);
    }
}

/// Each reason of many answers, by level: gates fail as they are stated, and an answer that is not
/// CONFIRMED has one.
void ExpectStatedGatesFail(const Verdict& verdict, int* stated_count) {
  std::vector<std::string> sentences = verdict.failed_gates;
  sentences.push_back(verdict.reason);
  for (const std::string& sentence : sentences) {
    EXPECT_THAT(sentence, Not(HasSubstr("nats")));
    EXPECT_THAT(sentence, Not(HasSubstr("{}")));
    for (const auto& gate : samples::StatedGates(sentence)) {
      EXPECT_TRUE(gate.Fails()) << sentence;
      ++*stated_count;
    }
  }
  if (verdict.level != VerdictLevel::kConfirmed && verdict.failed_gates.empty()) {
    EXPECT_FALSE(samples::StatedGates(verdict.reason).empty()) << verdict.reason;
  }
}

TEST(Reasons, NameWhatTakesMostOffTheProbability) {
  VerdictModel model;
  model.features = {{.name = "seen", .mean = 0.8, .deviation = 0.1, .weight = 1.0},
                    {.name = "agree", .mean = 0.9, .deviation = 0.1, .weight = 2.0},
                    {.name = "odd", .mean = 0.5, .deviation = 0.1, .weight = -5.0}};
  const auto gate = [](const char* what, double number, double limit) {
    return Gate{.what = what, .unit = Gate::Unit::kFraction, .number = number, .limit = limit};
  };
  const auto reasons = [&](double seen, double agree, double odd) {
    std::vector<std::string> sentences;
    for (const Gate& it : WeightiestFirst(model, std::vector<double>{seen, agree, odd},
                                          {{"seen", gate("{} seen", seen, 0.8)},
                                           {"agree", gate("{} agree", agree, 0.9)},
                                           {"odd", gate("{} odd", odd, 0.5)}}))
      sentences.push_back(it.Sentence());
    return sentences;
  };
  EXPECT_THAT(reasons(0.7, 0.8, 0.5), ::testing::ElementsAre("80 % agree (usually at least 90 %)",
                                                             "70 % seen (usually at least 80 %)"));
  EXPECT_THAT(reasons(0.6, 0.85, 0.5),
              ::testing::ElementsAre("60 % seen (usually at least 80 %)",
                                     "85 % agree (usually at least 90 %)"));
  // What the model counts in its favour is no reason, whatever the gate says.
  EXPECT_THAT(reasons(0.9, 0.95, 0.2), ::testing::IsEmpty());
}

/// A fan of rays along z onto a wall.
RaySet Fan() {
  RaySet rays;
  for (int i = -10; i <= 10; ++i)
    for (int j = -10; j <= 10; ++j) {
      RangeRay ray{Eigen::Vector3d::Zero(), Eigen::Vector3d(0.02 * i, 0.02 * j, 1.0).normalized(),
                   1.2};
      rays.rays.push_back(ray);
    }
  return rays;
}

double Around(double limit, Random& random) {
  return limit * random.Uniform(0.5, 1.5);
}

TEST(Reasons, OfValvesFailAsTheyAreStated) {
  Random random(11);
  const RaySet rays = Fan();
  int stated = 0;
  for (int i = 0; i < kAnswers; ++i) {
    ValveDetection found;
    found.best.model.rim_radius_m = random.Uniform(0.035, 0.28);
    found.best.model.spokes = random.Index(10) == 0 ? 0 : 2 + random.Index(5);
    found.best.base_from_object = {Eigen::Quaterniond::Identity(),
                                   {0.16 * random.Uniform(), 0.0, 1.0}};
    found.sigma_axis_rad = Around(0.04, random);
    found.sigma_position_m = Eigen::Vector3d::Constant(0.002);
    found.sigma_phase_rad = 0.02;
    found.evidence = {.rays = 441,
                      .hits = 20 + random.Index(400),
                      .inlier_ratio = random.Uniform(0.5, 1.0),
                      .see_through = random.Uniform(0.0, 0.3),
                      .blocked_gaps = random.Uniform(0.0, 0.5),
                      .rms_m = 0.008,
                      .arc_coverage = random.Uniform(0.3, 1.0),
                      .margin_nats = random.Uniform(-50.0, 500.0),
                      .gain_nats = random.Uniform(0.0, 2000.0),
                      .weakest_spoke = random.Uniform(0.2, 1.0),
                      .margin_line_sigmas = random.Uniform(-1.0, 8.0),
                      .weakest_spoke_nats = random.Uniform(-20.0, 100.0),
                      .weakest_spoke_middle_nats = random.Uniform(-20.0, 100.0),
                      .further_spoke_nats = random.Uniform(0.0, 40.0),
                      .rim_nats = random.Uniform(-20.0, 100.0),
                      .weakest_arc_nats = random.Uniform(-10.0, 50.0),
                      .weakest_quarter_nats = random.Uniform(-10.0, 50.0),
                      .pipe_margin_nats = random.Uniform(-10.0, 50.0)};
    if (random.Index(3) == 0) found.evidence.margin_nats = random.Uniform(-5.0, 12.0);
    found.alternatives.push_back(found.best);
    found.alternatives.front().model.spokes = 5;
    const Verdict verdict = AssessValve(rays, rays, found, {});
    ExpectStatedGatesFail(verdict, &stated);
    if (found.evidence.margin_nats >= kFarBehind_nats) {
      EXPECT_THAT(verdict.reason, Not(HasSubstr(" against "))) << found.evidence.margin_nats;
    }
  }
  EXPECT_GT(stated, kAnswers / 2);
}

TEST(Reasons, SpokesWithoutARimOrUnevenOnesAreNotConfirmed) {
  RaySet rays = Fan();
  ValveDetection found;
  found.best.model.rim_radius_m = 0.16;
  found.best.model.spokes = 4;
  found.best.base_from_object = {Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.2}};
  found.sigma_axis_rad = 0.01;
  found.sigma_position_m = Eigen::Vector3d::Constant(0.001);
  found.sigma_phase_rad = 0.005;
  found.evidence = {.rays = 441,
                    .hits = 300,
                    .inlier_ratio = 1.0,
                    .rms_m = 0.008,
                    .arc_coverage = 0.45,
                    .margin_nats = 500.0,
                    .gain_nats = 1500.0,
                    .weakest_spoke = 1.0,
                    .margin_line_sigmas = 6.0,
                    .weakest_spoke_nats = 100.0,
                    .weakest_spoke_middle_nats = 60.0,
                    .rim_nats = 600.0,
                    .weakest_quarter_nats = 80.0};
  EXPECT_EQ(AssessValve(rays, rays, found, {}).level, VerdictLevel::kConfirmed);
  found.evidence.arc_coverage = 0.35;
  const Verdict verdict = AssessValve(rays, rays, found, {});
  EXPECT_EQ(verdict.level, VerdictLevel::kLikely);
  EXPECT_EQ(verdict.reason,
            "35 % of the rim is seen (at least 40 %): spokes without a rim look like this");
  found.evidence.arc_coverage = 0.92;
  found.evidence.weakest_spoke_middle_nats = -11.5;
  EXPECT_EQ(AssessValve(rays, rays, found, {}).reason,
            "the odds that every spoke is there are 1 : 99000 (at least 22000 : 1): a wheel that "
            "lacks a spoke looks like this");
  found.evidence.weakest_spoke_middle_nats = 60.0;
  found.evidence.further_spoke_nats = 39.0;
  EXPECT_EQ(
      AssessValve(rays, rays, found, {}).reason,
      "the odds that there is one more spoke are 10^17 : 1 (at most 10^9 : 1): spokes that do "
      "not stand evenly look like this");
  found.evidence.further_spoke_nats = 0.0;
  found.evidence.weakest_arc_nats = -11.0;
  EXPECT_EQ(
      AssessValve(rays, rays, found, {}).reason,
      "the odds that every part of the rim is there are 1 : 60000 (at least 1 : 22000): a wheel "
      "whose rim is broken looks like this");
  found.evidence.weakest_arc_nats = 0.0;  // something hides it
  found.evidence.weakest_quarter_nats = 0.0;
  EXPECT_EQ(AssessValve(rays, rays, found, {}).reason,
            "the odds that every quarter of the rim is there are 1 : 1 (at least 150 : 1): a "
            "broken rim whose gap is hidden looks like this");
  found.evidence.weakest_quarter_nats = 6.0;
  found.evidence.pipe_margin_nats = -55.0;
  EXPECT_EQ(
      AssessValve(rays, rays, found, {}).reason,
      "the odds that its two spokes are no pipe behind a ring are 1 : 10^24 (at least 150 : 1): "
      "check them in the image");
  found.evidence.pipe_margin_nats = 20.0;
  found.evidence.further_spoke_nats = 12.0;  // beams beside a spoke
  EXPECT_EQ(AssessValve(rays, rays, found, {}).level, VerdictLevel::kConfirmed);
  found.best.model.spoke_radius_m = 0.04;
  const Verdict flange = AssessValve(rays, rays, found, {});
  EXPECT_EQ(flange.level, VerdictLevel::kUnsure);
  EXPECT_EQ(
      flange.reason,
      "its 4 spokes fill 58 % of the wheel (at most 50 %): any round or flat thing looks like "
      "this");
  found.best.model.spoke_radius_m = 0.008;
  found.best.model.spokes = 0;
  const Verdict lid = AssessValve(rays, rays, found, {});
  EXPECT_EQ(lid.level, VerdictLevel::kUnsure);
  EXPECT_EQ(lid.reason, "no spokes are seen: any round or flat thing looks like this");
  found.best.model.spokes = 4;
  // Beams that touch it and the wall agree with a thin one.
  found.evidence.rim_nats = -48.5;
  EXPECT_THAT(AssessValve(rays, rays, found, {}).reason,
              HasSubstr("the odds that there is a rim are "));
}

DrillState UsualDrill(const std::vector<DrillTemplate>& kinds) {
  DrillState state;
  state.kind = &kinds.front();
  state.values[kDrillScale] = 1.0;
  return state;
}

DrillDetection FoundOnATable(const DrillState& state) {
  DrillDetection found;
  found.best = CandidateOf(state, {Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.0}});
  found.table = Plane();
  return found;
}

TEST(Reasons, OfDrillsFailAsTheyAreStated) {
  Random random(12);
  const RaySet rays = Fan();
  const std::vector<DrillTemplate> kinds = ShippedDrillTemplates();
  int stated = 0;
  for (int i = 0; i < kAnswers; ++i) {
    DrillState state;
    state.kind = &kinds[static_cast<std::size_t>(random.Index(static_cast<int>(kinds.size())))];
    state.values[kDrillScale] = random.Uniform(state.kind->min_scale, state.kind->max_scale);
    if (random.Index(4) == 0) state.values[kDrillScale] = state.kind->max_scale;
    state.values[kDrillTiltX] = random.Uniform(0.0, 0.27);
    DrillDetection found = FoundOnATable(state);
    found.sigma_yaw_rad = random.Uniform(0.01, 0.2);
    found.evidence = {.rays = 441,
                      .hits = 20 + random.Index(400),
                      .inlier_ratio = random.Uniform(0.4, 1.0),
                      .see_through = random.Uniform(0.0, 0.2),
                      .rms_m = 0.008,
                      .yaw_margin_nats = random.Uniform(-20.0, 100.0),
                      .flip_margin_nats = random.Uniform(-20.0, 100.0),
                      .head_nats = random.Uniform(0.0, 100.0),
                      .gain_nats = 500.0,
                      .alternative_margin_nats = random.Uniform(-50.0, 400.0),
                      .best_alternative = "box and cylinder",
                      .no_foot_margin_nats = random.Uniform(-20.0, 100.0),
                      .nozzle_margin_nats = random.Uniform(-5.0, 30.0),
                      .no_chuck_margin_nats = random.Uniform(-20.0, 50.0),
                      .unusual_nats = random.Uniform(-5.0, 60.0)};
    const DrillSupport support = {.beam_sigma_yaw_rad = found.sigma_yaw_rad,
                                  .any_flip_margin_nats = random.Uniform(-20.0, 100.0),
                                  .flip_line_sigmas = random.Uniform(-1.0, 4.0),
                                  .blunt_margin_nats = random.Uniform(-20.0, 100.0),
                                  .chuck_nats = random.Uniform(-20.0, 100.0),
                                  .foot_nats = random.Uniform(-20.0, 100.0)};
    ExpectStatedGatesFail(AssessDrill(rays, rays, found, state, {}, support), &stated);
  }
  EXPECT_GT(stated, kAnswers / 2);
}

TEST(Reasons, ADrillWhoseChuckNobodySawOrAFarLikelierBoxIsNotConfirmed) {
  const RaySet rays = Fan();
  const std::vector<DrillTemplate> kinds = ShippedDrillTemplates();
  const DrillState state = UsualDrill(kinds);
  DrillDetection found = FoundOnATable(state);
  found.evidence = {.rays = 441,
                    .hits = 300,
                    .inlier_ratio = 1.0,
                    .rms_m = 0.008,
                    .yaw_margin_nats = 100.0,
                    .flip_margin_nats = 100.0,
                    .head_nats = 200.0,
                    .gain_nats = 1500.0,
                    .alternative_margin_nats = 300.0,
                    .best_alternative = "box and cylinder"};
  DrillSupport support = {.beam_sigma_yaw_rad = 0.02,
                          .any_flip_margin_nats = 90.0,
                          .any_way_margin_nats = 80.0,
                          .flip_line_sigmas = 5.0,
                          .blunt_margin_nats = 50.0,
                          .chuck_nats = 50.0,
                          .proportions_nats = -1.0};
  const auto chuck = ::testing::Contains(HasSubstr("whether it has a chuck"));
  EXPECT_THAT(AssessDrill(rays, rays, found, state, {}, support).failed_gates, Not(chuck));
  const auto foot = ::testing::Contains(HasSubstr("a tool that stands on the end of its grip"));
  // A kind without feet has no such alternative.
  EXPECT_THAT(AssessDrill(rays, rays, found, state, {}, support).failed_gates, Not(foot));
  found.evidence.no_foot_margin_nats = 60.0;
  EXPECT_THAT(AssessDrill(rays, rays, found, state, {}, support).failed_gates, Not(foot));
  found.evidence.no_foot_margin_nats = 20.0;  // a heat gun that stands on the end of its grip
  EXPECT_THAT(AssessDrill(rays, rays, found, state, {}, support).failed_gates, foot);
  found.evidence.no_foot_margin_nats = 60.0;
  const auto nozzle = ::testing::Contains(HasSubstr("a nozzle in place of its chuck"));
  found.evidence.nozzle_margin_nats = 30.0;
  EXPECT_THAT(AssessDrill(rays, rays, found, state, {}, support).failed_gates, Not(nozzle));
  found.evidence.nozzle_margin_nats = 2.0;  // a heat gun on a battery
  EXPECT_THAT(AssessDrill(rays, rays, found, state, {}, support).failed_gates, nozzle);
  found.evidence.nozzle_margin_nats = 30.0;
  const auto no_chuck = ::testing::Contains(HasSubstr("a tool without a chuck"));
  found.evidence.no_chuck_margin_nats = 20.0;
  EXPECT_THAT(AssessDrill(rays, rays, found, state, {}, support).failed_gates, Not(no_chuck));
  found.evidence.no_chuck_margin_nats = -15.0;  // one that is as wide as its barrel to the end
  EXPECT_THAT(AssessDrill(rays, rays, found, state, {}, support).failed_gates, no_chuck);
  found.evidence.no_chuck_margin_nats = 20.0;
  const auto unusual = ::testing::Contains(HasSubstr("proportions that drills do not have"));
  EXPECT_THAT(AssessDrill(rays, rays, found, state, {}, support).failed_gates, Not(unusual));
  found.evidence.unusual_nats = 48.0;  // a hot air tool on a battery
  EXPECT_THAT(AssessDrill(rays, rays, found, state, {}, support).failed_gates, unusual);
  found.evidence.unusual_nats = 0.0;
  const auto turned = ::testing::Contains(HasSubstr("turned by 180 deg are 4900 : 1"));
  EXPECT_THAT(AssessDrill(rays, rays, found, state, {}, support).failed_gates, Not(turned));
  found.evidence.flip_margin_nats = found.evidence.yaw_margin_nats = 8.5;
  EXPECT_THAT(AssessDrill(rays, rays, found, state, {}, support).failed_gates, turned);
  found.evidence.flip_margin_nats = found.evidence.yaw_margin_nats = 100.0;
  support.chuck_nats = 0.0;
  const Verdict unseen = AssessDrill(rays, rays, found, state, {}, support);
  EXPECT_NE(unseen.level, VerdictLevel::kConfirmed);
  EXPECT_THAT(unseen.failed_gates, chuck);
  support.chuck_nats = 50.0;
  // A nozzle.
  for (SolidPart& part : found.best.model.parts)
    if (part.name == DrillTemplate::kChuck) part.size_m.z() = 0.069;
  EXPECT_THAT(
      AssessDrill(rays, rays, found, state, {}, support).failed_gates,
      ::testing::Contains("its chuck is 69 mm long (at most 65 mm): it may be another tool"));
  found.evidence.alternative_margin_nats = -6.0;
  EXPECT_EQ(AssessDrill(rays, rays, found, state, {}, support).level, VerdictLevel::kUnsure);
}

TEST(Reasons, ABetterAlternativeIsNotCalledAsGood) {
  const RaySet rays = Fan();
  const std::vector<DrillTemplate> kinds = ShippedDrillTemplates();
  const DrillState state = UsualDrill(kinds);
  DrillDetection found = FoundOnATable(state);
  found.evidence = {.hits = 300,
                    .inlier_ratio = 0.9,
                    .alternative_margin_nats = -41.0,
                    .best_alternative = "box and cylinder"};
  const Verdict verdict = AssessDrill(rays, rays, found, state, {}, {});
  ASSERT_FALSE(verdict.failed_gates.empty());
  EXPECT_EQ(verdict.reason,
            "the odds against a box and cylinder in its place are 1 : 10^18 (at least 1 : 1)");
}

TEST(Reasons, OfBlocksFailAsTheyAreStated) {
  Random random(13);
  const RaySet rays = Fan();
  int stated = 0;
  for (int i = 0; i < kAnswers; ++i) {
    TerrainSurface block;
    block.base_from_object = {Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.5}};
    block.covariance = PoseCovariance::Identity() * 1e-5;
    block.toehold.sigma_tilt_rad = 0.003;
    block.evidence = {.points = 20 + random.Index(500),
                      .cover = random.Uniform(0.4, 1.0),
                      .see_through = random.Uniform(0.0, 0.1),
                      .outside = random.Uniform(0.0, 0.2),
                      .confirmed_edges = random.Index(5),
                      .rms_m = 0.006,
                      .size_margin = random.Uniform(-0.15, 0.1),
                      .size_nats = random.Uniform(-3.0, 5.0)};
    RectangleEvidence evidence;
    evidence.block = block.evidence;
    evidence.size_error_m = random.Uniform(0.0, 0.08);
    ExpectStatedGatesFail(AssessBlock(rays, block, evidence), &stated);
  }
  EXPECT_GT(stated, kAnswers / 2);
}

TEST(Reasons, OfDoorHandlesFailAsTheyAreStated) {
  Random random(15);
  const RaySet rays = Fan();
  int stated = 0;
  for (int i = 0; i < kAnswers; ++i) {
    HandleDetection found;
    found.best.base_from_object = {Eigen::Quaterniond::Identity(),
                                   {0.2 * random.Uniform(), 0.0, 1.0}};
    found.best.model.length_m = random.Index(6) == 0 ? 0.180 : random.Uniform(0.081, 0.178);
    found.beam_sigma_turn_rad = random.Uniform(0.01, 0.2);
    found.evidence = {.rays = 441,
                      .hits = 5 + random.Index(100),
                      .inlier_ratio = random.Uniform(0.4, 1.0),
                      .see_through = random.Uniform(0.0, 0.2),
                      .rms_m = 0.008,
                      .covered = random.Uniform(0.3, 1.0),
                      .beside = random.Uniform(0.0, 0.4),
                      .mirror_margin_nats = random.Uniform(0.0, 12.0),
                      .length_margin_nats = random.Uniform(-5.0, 60.0),
                      .gain_nats = random.Uniform(10.0, 500.0),
                      .alternative_margin_nats = random.Uniform(-20.0, 100.0),
                      .best_alternative = "knob"};
    ExpectStatedGatesFail(AssessHandle(rays, found, {}, 0.0), &stated);
  }
  EXPECT_GT(stated, kAnswers / 2);
}

TEST(Reasons, OfCylindersFailAsTheyAreStated) {
  Random random(14);
  const RaySet rays = Fan();
  int stated = 0;
  for (int i = 0; i < kAnswers; ++i) {
    CylinderDetection found;
    found.model = {.radius_m = random.Uniform(0.01, 0.61), .length_m = random.Uniform(0.05, 1.0)};
    found.sigma_radius_m = random.Index(20) == 0 ? std::nan("") : random.Uniform(0.001, 0.05);
    found.evidence = {.rays = 441,
                      .hits = 20 + random.Index(100),
                      .inlier_ratio = random.Uniform(0.5, 1.0),
                      .see_through = random.Uniform(0.0, 0.15),
                      .seen_arc_rad = random.Uniform(0.8, 3.0),
                      .box_margin_nats = random.Uniform(-10.0, 60.0)};
    Assess(rays, {}, found);
    for (const auto& gate : samples::StatedGates(found.verdict.reason)) {
      EXPECT_TRUE(gate.Fails()) << found.verdict.reason;
      ++stated;
    }
    EXPECT_EQ(found.verdict.level == VerdictLevel::kLikely,
              samples::StatedGates(found.verdict.reason).empty())
        << found.verdict.reason;
  }
  EXPECT_GT(stated, kAnswers / 2);
}

}  // namespace
}  // namespace foresight
