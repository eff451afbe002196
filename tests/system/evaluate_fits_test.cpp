// Trying fits on drawn scenes, from the command line.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/evaluation/fit_outcome_json.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

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

/// A table that holds seeds 1 and 2, so that nothing is simulated.
std::string TableOfTwo(const TemporaryFolder& folder) {
  std::ofstream table(folder / "table.jsonl");
  FitOutcome outcome;
  outcome.source = "foresight-alone";
  outcome.found = outcome.pose_ok = outcome.all_ok = true;
  outcome.seed = 1;
  outcome.what = "wheel of 4 spokes";
  table << FitOutcomeToJson(outcome) << "\n";
  outcome.seed = 2;
  outcome.what = "lever, beyond 2 m";
  table << FitOutcomeToJson(outcome) << "\n";
  return folder / "table.jsonl";
}

TEST(EvaluateFits, CountsTheScenesOfOneDescription) {
  const TemporaryFolder folder;
  const ProgramResult result = RunProgram(
      FORESIGHTCTL, {"evaluate-fits", "valve", "--count", "2", "--source", "foresight-alone",
                     "--table", TableOfTwo(folder), "--what", "^wheel[^,]*$", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto rows = nlohmann::json::parse(result.output);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0]["source"], "foresight-alone");
  EXPECT_EQ(rows[0]["positives"], 1);
}

TEST(EvaluateFits, APatternThatIsNoneIsAMistake) {
  const TemporaryFolder folder;
  const ProgramResult result = RunProgram(
      FORESIGHTCTL, {"evaluate-fits", "valve", "--count", "2", "--source", "foresight-alone",
                     "--table", TableOfTwo(folder), "--what", "(wheel"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.errors.find("(wheel"), std::string::npos) << result.errors;
}

TEST(EvaluateFits, TheOtherWorldIsJudgedLikeOursAndNeverFittedTo) {
  const TemporaryFolder folder;
  const std::string table = folder / "other.jsonl";
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"evaluate-fits", "drill", "--world", "other", "--count", "2",
                                "--source", "raw", "--table", table, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto rows = nlohmann::json::parse(result.output);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_TRUE(rows[0].contains("right_not_confirmed"));
  const auto outcomes = LoadFitOutcomes(table);
  ASSERT_TRUE(outcomes);
  for (const FitOutcome& outcome : *outcomes) EXPECT_EQ(outcome.world, FitWorld::kOther);

  const ProgramResult fitted =
      RunProgram(FORESIGHTCTL,
                 {"verdict", "fit", "drill", table, "--population", "x", "-o", folder / "v.yaml"});
  EXPECT_NE(fitted.exit_code, 0);
  EXPECT_NE(fitted.errors.find("judges only"), std::string::npos) << fitted.errors;
  const ProgramResult mixed = RunProgram(FORESIGHTCTL, {"evaluate-fits", "drill", "--count", "2",
                                                        "--source", "raw", "--table", table});
  EXPECT_NE(mixed.exit_code, 0);
  EXPECT_NE(mixed.errors.find("other world"), std::string::npos) << mixed.errors;
}

}  // namespace
}  // namespace foresight
