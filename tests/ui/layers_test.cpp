#include <gtest/gtest.h>

#include "ui/viewmodels/layers_view_model.h"

namespace foresight {
namespace {

DenseDepth WithPasses(int passes) {
  DenseDepth dense;
  dense.depth_m = DepthImage(2, 2, 99.0f);
  for (int i = 0; i < passes; ++i) dense.iterations.emplace_back(2, 2, static_cast<float>(i));
  return dense;
}

TEST(Layers, ShowTheFinalDepthWhileThePassesAreClosed) {
  LayersViewModel layers;
  layers.SetIteration(1);
  EXPECT_EQ(layers.DepthOf(WithPasses(3))(0, 0), 99.0f);
}

TEST(Layers, ShowTheChosenPass) {
  LayersViewModel layers;
  layers.openIterations(true);
  layers.SetIteration(1);
  EXPECT_EQ(layers.DepthOf(WithPasses(3))(0, 0), 1.0f);
}

TEST(Layers, AResultWithFewerPassesShowsItsLast) {
  LayersViewModel layers;
  layers.openIterations(true);
  layers.SetIteration(5);
  EXPECT_EQ(layers.DepthOf(WithPasses(3))(0, 0), 2.0f);
  EXPECT_EQ(layers.DepthOf(WithPasses(0))(0, 0), 99.0f);
}

TEST(Layers, OneKeyShowsAllRejectedSamplesAndHidesThemAgain) {
  LayersViewModel layers;
  layers.ShowSamples(RejectReason::kIsolated, true);
  layers.toggleRejected();
  for (const RejectReason kind : kSampleKinds)
    EXPECT_EQ(layers.Samples().Shows(kind), kind != RejectReason::kKept) << ToString(kind);
  layers.toggleRejected();
  EXPECT_FALSE(layers.Samples().ShowsAny());
}

}  // namespace
}  // namespace foresight
