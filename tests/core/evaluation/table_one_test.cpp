// The testbed of Section V-A on the real scenes against what an independent study measured with the
// same reading of the equations. Heavy tails (w/o C at quarter size) are compared over all scenes
// only.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/evaluation/evaluate_methods.h"

namespace foresight {
namespace {

struct Row {
  const char* scene;
  double a80_mm, a95_mm, coverage;
};

std::filesystem::path SceneFolder(const std::string& name) {
  return std::filesystem::path(FORESIGHT_TEST_DATA) / "middlebury" / name;
}

/// The mean over seeds: single runs scatter.
void ExpectMaskedResults(const Row& row, int enlarge, int seeds) {
  if (!std::filesystem::exists(SceneFolder(row.scene)))
    GTEST_SKIP() << "no " << SceneFolder(row.scene)
                 << ": set FORESIGHT_TEST_DATA to the folder with the data sets";
  const auto scene = LoadStereoScene(SceneFolder(row.scene));
  ASSERT_TRUE(scene) << scene.error().message;
  StereoEvaluationOptions options;
  options.depth = TestbedOptionsOf(DepthMethod::kPaper);
  options.enlarge = enlarge;
  double a80 = 0.0, a95 = 0.0, coverage = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    options.testbed.seed = static_cast<std::uint64_t>(seed);
    const auto evaluation = EvaluateOnScene(*scene, options, {});
    ASSERT_TRUE(evaluation) << evaluation.error().message;
    a80 += evaluation->with_mask.a80_mm / seeds;
    a95 += evaluation->with_mask.a95_mm / seeds;
    coverage += evaluation->with_mask.coverage / seeds;
  }
  EXPECT_NEAR(a80, row.a80_mm, 0.08 * row.a80_mm) << row.scene;
  EXPECT_NEAR(a95, row.a95_mm, 0.08 * row.a95_mm) << row.scene;
  EXPECT_NEAR(coverage, row.coverage, 0.04) << row.scene;
}

class QuarterSize : public testing::TestWithParam<Row> {};
TEST_P(QuarterSize, MaskedResultsAreThoseOfTheStudy) {
  ExpectMaskedResults(GetParam(), 1, 5);
}
// ArtL is left out: at its few pixels a 95th percentile of 92 to 240 mm hangs on single samples.
INSTANTIATE_TEST_SUITE_P(
    TableQ, QuarterSize,
    testing::Values(Row{"Motorcycle", 15.6, 32.8, .57}, Row{"Piano", 16.7, 33.3, .61},
                    Row{"Pipes", 16.1, 30.0, .12}, Row{"Playroom", 14.5, 29.0, .55},
                    Row{"Recycle", 8.7, 22.5, .78}, Row{"Teddy", 6.3, 16.9, .89}));

class FullSize : public testing::TestWithParam<Row> {};
TEST_P(FullSize, MaskedResultsAreThoseOfTheStudy) {
  ExpectMaskedResults(GetParam(), 4, 1);
}
INSTANTIATE_TEST_SUITE_P(TableF, FullSize,
                         testing::Values(Row{"ArtL", 4.6, 11.6, .90}, Row{"Recycle", 3.5, 6.5, .96},
                                         Row{"Teddy", 3.9, 7.2, .96}));

/// What Foresight's own method must reach over all seven scenes.
void ExpectForesightReaches(int enlarge, double a80_mm, double a95_mm, double coverage) {
  double a80 = 0.0, a95 = 0.0, kept = 0.0, invented = 0.0;
  constexpr const char* kScenes[] = {"ArtL",     "Motorcycle", "Piano", "Pipes",
                                     "Playroom", "Recycle",    "Teddy"};
  for (const char* name : kScenes) {
    if (!std::filesystem::exists(SceneFolder(name)))
      GTEST_SKIP() << "no " << SceneFolder(name)
                   << ": set FORESIGHT_TEST_DATA to the folder with the data sets";
    const auto scene = LoadStereoScene(SceneFolder(name));
    ASSERT_TRUE(scene) << scene.error().message;
    StereoEvaluationOptions options;
    options.depth = TestbedOptionsOf(DepthMethod::kForesight);
    options.enlarge = enlarge;
    const auto evaluation = EvaluateOnScene(*scene, options, {});
    ASSERT_TRUE(evaluation) << evaluation.error().message;
    a80 += evaluation->with_mask.a80_mm / std::size(kScenes);
    a95 += evaluation->with_mask.a95_mm / std::size(kScenes);
    kept += evaluation->with_mask.coverage / std::size(kScenes);
    invented += evaluation->with_mask.unscored_kept / std::size(kScenes);
  }
  EXPECT_LE(a80, a80_mm);
  EXPECT_LE(a95, a95_mm);
  EXPECT_GE(kept, coverage);
  EXPECT_LE(invented, 0.15);
}

TEST(Foresight, ReachesItsBarsAtQuarterSize) {
  ExpectForesightReaches(1, 9.5, 28.0, 0.90);
}
TEST(Foresight, ReachesItsBarsAtFullSize) {
  ExpectForesightReaches(4, 4.1, 8.3, 0.95);
}

}  // namespace
}  // namespace foresight
