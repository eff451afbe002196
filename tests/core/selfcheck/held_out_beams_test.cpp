// Which beams stay out of a depth map, and what they say of it: a wall, and a box before it.
#include "core/selfcheck/held_out_beams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/depth/depth_method.h"

namespace foresight {
namespace {

constexpr int kWidth = 240, kHeight = 200, kAlong_px = 4, kBetween_px = 5;
constexpr float kFocal_px = 200.0f, kWall_m = 3.0f, kBox_m = 2.0f;

bool InBox(float u) {
  return u > 80.0f && u < 160.0f;
}

/// A wall that faces the camera with a box before it, without noise. Where the box is, the image is
/// dark.
AlignedSamples WallAndBox() {
  AlignedSamples samples;
  samples.width = kWidth;
  samples.height = kHeight;
  samples.lines = kHeight / kBetween_px;
  samples.beams = kWidth / kAlong_px;
  for (int line = 0; line < samples.lines; ++line)
    for (int beam = 0; beam < samples.beams; ++beam) {
      AlignedSample s;
      s.u = static_cast<float>(kAlong_px * beam) + 1.3f;
      s.v = static_cast<float>(kBetween_px * line) + 2.2f;
      s.depth_m = InBox(s.u) ? kBox_m : kWall_m;
      s.line = line;
      s.beam = beam;
      s.point = {(s.u - 120.0f) / kFocal_px * s.depth_m, (s.v - 100.0f) / kFocal_px * s.depth_m,
                 s.depth_m};
      samples.samples.push_back(s);
    }
  samples.reasons.assign(samples.samples.size(), RejectReason::kKept);
  return samples;
}

ColorImage Picture() {
  ColorImage image(kWidth, kHeight, {200, 200, 200});
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (InBox(static_cast<float>(x))) image(x, y) = {40, 40, 40};
  return image;
}

TEST(HoldOutPlan, ScatteredBeamsAreATenthAndNoneHasANeighbourAmongThem) {
  const HoldOutPlan plan;
  int out = 0;
  for (int line = 0; line < 100; ++line)
    for (int beam = 0; beam < 100; ++beam) {
      if (!plan.LeavesOut(line, beam)) continue;
      ++out;
      const bool has_neighbour = plan.LeavesOut(line, beam + 1) || plan.LeavesOut(line + 1, beam) ||
                                 plan.LeavesOut(line + 1, beam + 1) ||
                                 (beam > 0 && plan.LeavesOut(line + 1, beam - 1));
      EXPECT_FALSE(has_neighbour) << line << " " << beam;
    }
  EXPECT_EQ(out, 1000);
}

TEST(HoldOutPlan, EachBeamStaysOutInOneTurnOfTen) {
  for (const auto pattern : {HoldOutPlan::Pattern::kScattered, HoldOutPlan::Pattern::kLines}) {
    int times = 0;
    for (int turn = 0; turn < 10; ++turn)
      times += HoldOutPlan{pattern, 10, turn, false}.LeavesOut(37, 123) ? 1 : 0;
    EXPECT_EQ(times, 1);
  }
}

TEST(HoldOutPlan, RefusesATurnThatThereIsNot) {
  HoldOutPlan plan;
  plan.turn = 10;
  EXPECT_EQ(plan.Check().error().code, ErrorCode::kInvalidOptions);
}

TEST(JudgeBeams, FindsTheEdgesOfTheBoxAndNoneOnTheWall) {
  const auto judged = JudgeBeams(WallAndBox(), DefaultsOf(DepthMethod::kForesight), {});
  ASSERT_TRUE(judged) << judged.error().message;
  for (std::size_t i = 0; i < judged->at_edge.size(); ++i) {
    const AlignedSample& s = judged->samples.samples[i];
    // The grid's own border has no neighbours to compare with.
    if (s.line == 0 || s.beam == 0 || s.line == 39 || s.beam == 59) continue;
    const bool beside =
        InBox(s.u - kAlong_px) != InBox(s.u) || InBox(s.u + kAlong_px) != InBox(s.u);
    EXPECT_EQ(judged->at_edge[i] != 0, beside) << s.line << " " << s.beam;
  }
}

TEST(HoldOut, BeamsThatStayOutAgreeWithTheMapOfTheOthers) {
  const DepthOptions options = DefaultsOf(DepthMethod::kForesight);
  const auto judged = JudgeBeams(WallAndBox(), options, {});
  ASSERT_TRUE(judged);
  for (const auto pattern : {HoldOutPlan::Pattern::kScattered, HoldOutPlan::Pattern::kLines}) {
    const auto beams = HoldOut(*judged, Picture(), options, {pattern, 10, 5, false}, {});
    ASSERT_TRUE(beams) << beams.error().message;
    // A tenth of 2400; some are hidden at the box's edge.
    EXPECT_GT(beams->size(), 200u);
    EXPECT_LE(beams->size(), 240u);
    for (const HeldOutBeam& beam : *beams)
      if (beam.kept && !beam.at_edge) {
        EXPECT_NEAR(beam.Error_m(), 0.0, 0.001) << beam.line << " " << beam.beam;
      }
  }
}

TEST(HoldOut, BeamsDoNotCheckThemselves) {
  AlignedSamples samples = WallAndBox();
  // One beam that stays out measured a little less; more, and it would float before the wall.
  const HoldOutPlan plan;
  const auto liar =
      std::find_if(samples.samples.begin(), samples.samples.end(), [&](const AlignedSample& s) {
        return s.beam > 45 && s.line > 10 && plan.LeavesOut(s.line, s.beam);
      });
  liar->depth_m -= 0.045f;
  liar->point *= liar->depth_m / kWall_m;
  const DepthOptions options = DefaultsOf(DepthMethod::kForesight);
  const auto judged = JudgeBeams(samples, options, {});
  ASSERT_TRUE(judged);
  const auto beams = HoldOut(*judged, Picture(), options, plan, {});
  ASSERT_TRUE(beams);
  const auto found = std::find_if(beams->begin(), beams->end(), [&](const HeldOutBeam& beam) {
    return beam.line == liar->line && beam.beam == liar->beam;
  });
  ASSERT_NE(found, beams->end());
  EXPECT_NEAR(found->Error_m(), 0.045, 0.001);
}

TEST(JudgeBeams, ABeamThatFloatsBeforeTheWallDoesNotCount) {
  AlignedSamples samples = WallAndBox();
  const std::size_t at = 20u * 60u + 50u;
  samples.samples[at].depth_m -= 0.3f;
  const auto judged = JudgeBeams(samples, DefaultsOf(DepthMethod::kJointBilateral), {});
  ASSERT_TRUE(judged);
  EXPECT_EQ(judged->counts[at], 0);
  EXPECT_EQ(judged->counts[at + 2], 1);
}

TEST(HoldOut, AQuarterOfTheLinesIsCheckedByAllOthers) {
  const DepthOptions options = DefaultsOf(DepthMethod::kJointBilateral);
  const auto judged = JudgeBeams(WallAndBox(), options, {});
  ASSERT_TRUE(judged);
  const HoldOutPlan plan{HoldOutPlan::Pattern::kLines, 4, 0, true};
  const auto beams = HoldOut(*judged, Picture(), options, plan, {});
  ASSERT_TRUE(beams) << beams.error().message;
  EXPECT_GT(beams->size(), 1600u);
  for (const HeldOutBeam& beam : *beams) EXPECT_NE(beam.line % 4, 0);
}

}  // namespace
}  // namespace foresight
