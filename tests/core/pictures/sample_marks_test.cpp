#include "core/pictures/sample_marks.h"

#include <gtest/gtest.h>

#include "core/pictures/sample_picture.h"

namespace foresight {
namespace {

AlignedSamples OneOfEachKind() {
  AlignedSamples samples;
  samples.width = samples.height = 10;
  for (const RejectReason kind : kSampleKinds) {
    AlignedSample sample;
    sample.u = sample.v = static_cast<float>(kind);
    sample.depth_m = 2.0f;
    samples.samples.push_back(sample);
    samples.reasons.push_back(kind);
  }
  return samples;
}

TEST(SampleMarks, NothingIsDrawnUntilALayerIsShown) {
  EXPECT_TRUE(MarksOf(OneOfEachKind(), {}, {1.0, 3.0}, ColorMap::kTurbo).empty());
}

TEST(SampleMarks, ALayerShowsItsOwnSamplesOnly) {
  SampleLayers layers;
  layers.Show(RejectReason::kFlipping, true);
  const auto marks = MarksOf(OneOfEachKind(), layers, {1.0, 3.0}, ColorMap::kTurbo);
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_EQ(marks[0].color, ColorOf(RejectReason::kFlipping));
  EXPECT_EQ(marks[0].pixel, Eigen::Vector2d(3.0, 3.0));
}

TEST(SampleMarks, AKeptSampleHasTheColourOfItsDepth) {
  SampleLayers layers;
  layers.Show(RejectReason::kKept, true);
  const auto marks = MarksOf(OneOfEachKind(), layers, {2.0, 3.0}, ColorMap::kViridis);
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_EQ(marks[0].color, ColorOf(ColorMap::kViridis, 0.0));
}

TEST(SampleMarks, NoTwoReasonsShareASymbol) {
  // So that a reason can be told without seeing its hue.
  for (const RejectReason a : kSampleKinds)
    for (const RejectReason b : kSampleKinds)
      EXPECT_EQ(StrokesOf(a) == StrokesOf(b), a == b) << ToString(a) << " and " << ToString(b);
}

}  // namespace
}  // namespace foresight
