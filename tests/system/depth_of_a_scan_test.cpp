// A simulated scan's masked depth against the true depth of the scene.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/evaluation/depth_accuracy.h"
#include "core/io/pfm.h"
#include "core/io/png.h"
#include "tests/support/run_program.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

class DepthOfAScan : public testing::Test {
 protected:
  void Scan(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"scan", "--scene", kValveScene, "--out", mission_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = RunProgram(FORESIGHTCTL, arguments);
    ASSERT_EQ(result.exit_code, 0) << result.errors;
  }

  TemporaryFolder folder_;
  std::string mission_ = folder_ / "mission.foresight";
};

TEST_F(DepthOfAScan, IsWithinCentimetresOfTheTruthWhereTheMaskKeepsIt) {
  Scan({"--from", "-20", "--to", "20"});
  ASSERT_EQ(RunProgram(FORESIGHTCTL, {"depth", mission_, "--out", folder_ / "depth"}).exit_code, 0);
  ASSERT_EQ(RunProgram(FORESIGHTCTL, {"render", kValveScene, "--out", folder_ / "truth"}).exit_code,
            0);
  const auto depth_mm = ReadPfm(folder_.path() / "depth" / "depth.pfm");
  const auto truth_mm = ReadPfm(folder_.path() / "truth" / "depth.pfm");
  const auto mask = ReadPngGray(folder_.path() / "depth" / "mask.png");
  ASSERT_TRUE(depth_mm && truth_mm && mask);
  DepthImage depth_m = *depth_mm, truth_m = *truth_mm;
  for (float& value : depth_m.values()) value *= 1e-3f;
  for (float& value : truth_m.values()) value *= 1e-3f;
  const auto accuracy = ScoreDepth(depth_m, *mask, truth_m, 1);
  ASSERT_TRUE(accuracy);
  // The lidar's noise is 5 mm at this range; 95 % may include the blurred edges of thin things.
  EXPECT_LT(accuracy->a80_mm, 10.0);
  EXPECT_LT(accuracy->a95_mm, 30.0);
  // The sweep covers 40 of the image's 90 degrees.
  EXPECT_GT(accuracy->coverage, 0.35);
}

TEST_F(DepthOfAScan, GoesThroughUpsampleWithTheSameNumbers) {
  Scan({"--from", "-5", "--to", "5"});
  const std::string depth = folder_ / "depth";
  const std::string again = folder_ / "again";
  ASSERT_EQ(RunProgram(FORESIGHTCTL, {"depth", mission_, "--out", depth}).exit_code, 0);
  const ProgramResult upsample =
      RunProgram(FORESIGHTCTL, {"upsample", depth + "/image.png", depth + "/samples.csv", "--rig",
                                depth + "/rig.yaml", "--out", again});
  ASSERT_EQ(upsample.exit_code, 0) << upsample.errors;
  const auto a = ReadPfm(depth + "/depth.pfm");
  const auto b = ReadPfm(again + "/depth.pfm");
  const auto mask = ReadPngGray(depth + "/mask.png");
  ASSERT_TRUE(a && b && mask);
  std::vector<double> differences_mm;
  for (std::size_t i = 0; i < a->size(); ++i)
    if (mask->values()[i] != 0) differences_mm.push_back(std::abs(a->values()[i] - b->values()[i]));
  // The CSV keeps fewer digits; a rare pixel between two surfaces may fall to the other one.
  EXPECT_LT(Percentile(differences_mm, 99.9), 0.1);
}

}  // namespace
}  // namespace foresight
