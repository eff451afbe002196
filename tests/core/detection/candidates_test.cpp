#include "core/detection/candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/detection/facts.h"
#include "core/detection/outline.h"

namespace foresight {
namespace {

ValveDetection ValveWithAnAlternative() {
  ValveDetection valve;
  valve.best.model.spokes = 4;
  valve.best.model.rim_radius_m = 0.120;
  valve.best.base_from_object = {Eigen::Quaterniond::Identity(), {0.1, 0.2, 1.5}};
  valve.best.log_likelihood = 100.0;
  valve.alternatives = {valve.best};
  valve.alternatives[0].model.spokes = 3;
  valve.alternatives[0].log_likelihood = 62.0;
  valve.verdict = {VerdictLevel::kConfirmed, 0.97, "a valve", {}};
  return valve;
}

TerrainDetection TwoSurfaces() {
  TerrainDetection terrain;
  terrain.surfaces.resize(2);
  terrain.surfaces[0].kind = TerrainSurface::Kind::kBlock;
  terrain.surfaces[0].size_m = {0.4, 0.3};
  terrain.surfaces[0].toehold.size_m = {0.36, 0.26};
  terrain.surfaces[0].verdict.level = VerdictLevel::kConfirmed;
  terrain.surfaces[1].kind = TerrainSurface::Kind::kGround;
  terrain.surfaces[1].size_m = {1.0, 1.0};
  return terrain;
}

TEST(Candidates, AnAlternativeSaysByHowMuchItIsWorse) {
  const Detection valve = ValveWithAnAlternative();
  EXPECT_EQ(CandidateCount(valve), 2);
  EXPECT_EQ(CandidateText(valve, 0), "4 spokes, rim 240 mm across");
  EXPECT_EQ(CandidateText(valve, 1),
            "alternative 1 of 1: 3 spokes, rim 240 mm across, clearly less likely");
}

TEST(Candidates, AnAlternativeIsNeverConfirmed) {
  const Detection valve = ValveWithAnAlternative();
  EXPECT_EQ(CandidateLevel(valve, 0), VerdictLevel::kConfirmed);
  EXPECT_LT(CandidateLevel(valve, 1), VerdictLevel::kConfirmed);
}

TEST(Candidates, ThoseOfTerrainAreItsSurfaces) {
  const Detection terrain = TwoSurfaces();
  EXPECT_EQ(CandidateCount(terrain), 2);
  EXPECT_EQ(CandidateLevel(terrain, 1), VerdictLevel::kUnsure);
  EXPECT_EQ(CandidateText(terrain, 0), "surface 1 of 2: block, 400 x 300 mm, slope 0 deg");
}

TEST(Candidates, TerrainWithoutASurfaceHasNoneAndDrawsNothing) {
  const Detection nothing = TerrainDetection();
  EXPECT_EQ(CandidateCount(nothing), 0);
  EXPECT_TRUE(OutlinesOf(nothing, 0).empty());
  EXPECT_EQ(CandidateText(nothing, 0), "no surface");
  EXPECT_EQ(FactsOf(nothing, 0, {}).size(), 1U);
}

TEST(Outlines, ATemplateLiesWhereItsPoseIs) {
  const auto outlines = OutlinesOf(ValveWithAnAlternative(), 0);
  ASSERT_EQ(outlines.size(), 1U);
  double farthest = 0.0;
  for (const auto& line : outlines[0].lines)
    for (const auto& point : line)
      farthest = std::max(farthest, (point - Eigen::Vector3d(0.1, 0.2, 1.5)).norm());
  // Rim and tube.
  EXPECT_NEAR(farthest, 0.120 + 0.012, 0.005);
}

TEST(Outlines, EverySurfaceIsDrawnAndTheToeholdInsideIt) {
  const auto outlines = OutlinesOf(TwoSurfaces(), 1);
  ASSERT_EQ(outlines.size(), 2U);
  EXPECT_FALSE(outlines[0].chosen);
  EXPECT_TRUE(outlines[1].chosen);
  EXPECT_EQ(outlines[0].lines.size(), 2U);
  EXPECT_EQ(outlines[1].lines.size(), 1U) << "no toehold, no rectangle";
  EXPECT_EQ(outlines[0].level, VerdictLevel::kConfirmed);
}

TEST(Outlines, DashesCoverTheirFractionOfTheLine) {
  const Wireframe line = {{{0, 0, 0}, {0.5, 0, 0}, {1.0, 0, 0}}};
  const Wireframe dashes = Dashed(line, 0.06, 0.04);
  EXPECT_EQ(dashes.size(), 10U);
  double length = 0.0;
  for (const auto& dash : dashes)
    for (std::size_t i = 1; i < dash.size(); ++i) length += (dash[i] - dash[i - 1]).norm();
  EXPECT_NEAR(length, 0.6, 1e-9);
}

TEST(Facts, APositionIsToldInTheRobotsFrameInMillimetres) {
  const Rigid<frame::Robot, frame::Base> mounted(Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.0});
  const auto facts = FactsOf(ValveWithAnAlternative(), 0, mounted);
  ASSERT_GT(facts.size(), 3U);
  EXPECT_EQ(facts[1].name, "Centre");
  EXPECT_EQ(facts[1].value.rfind("x 100, y 200, z 2500 mm", 0), 0U) << facts[1].value;
}

TEST(Facts, ADirectionThatIsNotObservableIsNotTold) {
  ValveDetection valve = ValveWithAnAlternative();
  valve.phase_observable = false;
  const auto facts = FactsOf(valve, 0, {});
  EXPECT_EQ(facts[3].value, "angle not observable");
}

TEST(Facts, AnAlternativeIsToldWithoutTheDeviationsOfTheBestAnswer) {
  const Detection valve = ValveWithAnAlternative();
  EXPECT_NE(FactsOf(valve, 0, {})[1].value.find("sigma"), std::string::npos);
  for (const Fact& fact : FactsOf(valve, 1, {})) {
    EXPECT_EQ(fact.value.find("sigma"), std::string::npos) << fact.name;
    EXPECT_NE(fact.name, "Support");
  }
}

TEST(Facts, ADrillsBodyIsToldWithItsLean) {
  constexpr double kLean_rad = 0.2;
  DrillDetection drill;
  drill.best.model.body_tilt_rad = {0.0, kLean_rad};
  drill.best.model.object_from_grasp = {BodyTurn(drill.best.model.body_tilt_rad),
                                        Eigen::Vector3d::Zero()};
  const std::string lean = "leans by 11.5 deg to 0 deg left of forward (sigma";
  const auto facts = FactsOf(drill, 0, {});
  EXPECT_TRUE(std::any_of(facts.begin(), facts.end(), [&](const Fact& fact) {
    return fact.name == "Body" && fact.value.starts_with(lean);
  }));
}

TEST(Facts, ABodyThatLeansByLessThanIsKnownStandsUpright) {
  DrillDetection drill;
  drill.best.model.body_tilt_rad = {0.0, 0.005};
  drill.best.model.object_from_grasp = {BodyTurn(drill.best.model.body_tilt_rad),
                                        Eigen::Vector3d::Zero()};
  drill.sigma_axis_rad = 0.036;
  const auto facts = FactsOf(drill, 0, {});
  EXPECT_TRUE(std::any_of(facts.begin(), facts.end(), [&](const Fact& fact) {
    return fact.name == "Body" && fact.value.starts_with("upright (sigma 2.1 deg");
  }));
}

TEST(Facts, OfADoorHandleTheDoorsEdgeIsTold) {
  HandleDetection handle;
  const auto edge = [&](double edges_nats) {
    handle.evidence.edges_nats = edges_nats;
    for (const Fact& fact : FactsOf(handle, 0, {}))
      if (fact.name == "Door's edge") return fact.value;
    return std::string();
  };
  EXPECT_EQ(edge(4.0), "behind the pivot");
  EXPECT_EQ(edge(-4.0), "beyond the tip");
  EXPECT_EQ(edge(0.0), "not seen");
}

TEST(Facts, OfADoorHandleTheOddsAgainstTheOtherWayAreTold) {
  HandleDetection handle;
  handle.evidence.mirror_margin_nats = 6.0;
  const auto facts = FactsOf(handle, 0, {});
  EXPECT_TRUE(std::any_of(facts.begin(), facts.end(), [](const Fact& fact) {
    return fact.name == "Turned round" && fact.value == "400 : 1 against";
  }));
}

TEST(Candidates, AnAlternativeThatIsClearlyBehindIsUnsureHoweverSureTheBestAnswerIs) {
  ValveDetection valve = ValveWithAnAlternative();
  valve.verdict.level = VerdictLevel::kConfirmed;
  valve.alternatives[0].log_likelihood = valve.best.log_likelihood - 275.0;
  EXPECT_EQ(CandidateLevel(valve, 0), VerdictLevel::kConfirmed);
  EXPECT_EQ(CandidateLevel(valve, 1), VerdictLevel::kUnsure);
  valve.alternatives[0].log_likelihood = valve.best.log_likelihood - 1.0;
  EXPECT_EQ(CandidateLevel(valve, 1), VerdictLevel::kLikely);
}

}  // namespace
}  // namespace foresight
