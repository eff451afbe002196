// Trying fits on drawn scenes, from the command line.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace foresight {
namespace {

TEST(EvaluateFits, TriesOnlyTheScenesThatHoldNoDrill) {
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"evaluate-fits", "drill", "--only", "negatives", "--count", "2",
                                "--source", "raw", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto rows = nlohmann::json::parse(result.output);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0]["source"], "raw");
  EXPECT_EQ(rows[0]["negatives"], 2);
  EXPECT_EQ(rows[0]["positives"], 0);
  EXPECT_EQ(rows[0]["negatives_confirmed"], 0);
}

TEST(EvaluateFits, NeitherPositivesNorNegativesIsAMistake) {
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"evaluate-fits", "drill", "--only", "drills"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.errors.find("negatives"), std::string::npos) << result.errors;
}

}  // namespace
}  // namespace foresight
