// Trying fits on drawn scenes, from the command line.
#include <gtest/gtest.h>

#include <cmath>
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
  for (const FitOutcome& outcome : *outcomes) {
    EXPECT_EQ(outcome.world, FitWorld::kOther);
    EXPECT_EQ(outcome.evidence.empty(), !outcome.found) << outcome.reason;
  }

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

/// A table of drills that are right where their first feature is large.
std::string TableOfMany(const TemporaryFolder& folder) {
  std::ofstream table(folder / "many.jsonl");
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    FitOutcome outcome;
    outcome.seed = seed;
    outcome.source = "raw";
    outcome.found = true;
    outcome.pose_ok = outcome.all_ok = seed % 2 == 0;
    outcome.verdict.features.assign(17, 0.0);
    outcome.verdict.features[0] = seed % 2 == 0 ? 3.0 : -3.0;
    outcome.evidence = {{"rms_m", seed % 4 == 0 ? 0.01 : 0.02}};
    table << FitOutcomeToJson(outcome) << "\n";
  }
  return folder / "many.jsonl";
}

TEST(VerdictOddsCommand, WhatANumberSaysForAnAnswerIsCounted) {
  const TemporaryFolder folder;
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"verdict", "odds", "drill", TableOfMany(folder), "--of", "rms_m",
                                "--from", "0", "--to", "0.03", "--bins", "2", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto bins = nlohmann::json::parse(result.output);
  ASSERT_EQ(bins.size(), 2u);
  // Of 100 right answers 50 have 0.01, of 100 others none.
  EXPECT_EQ(bins[0]["right"], 50);
  EXPECT_EQ(bins[0]["wrong"], 0);
  EXPECT_NEAR(bins[0]["nats"], std::log(51.0), 1e-9);
  EXPECT_NEAR(bins[1]["nats"], std::log(51.0 / 101.0), 1e-9);
  EXPECT_EQ(
      RunProgram(FORESIGHTCTL, {"verdict", "odds", "drill", TableOfMany(folder), "--of", "rim"})
          .exit_code,
      2);
}

TEST(VerdictFitCommand, CountsWithGatesThatTheProgramDoesNotHaveAndWritesNothing) {
  const TemporaryFolder folder;
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"verdict", "fit", "drill", TableOfMany(folder), "--features",
                                "log_yaw_margin,rms_m", "--gate", "rms_m<=0.015", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.output);
  ASSERT_EQ(json["worlds"].size(), 1u);
  EXPECT_EQ(json["worlds"][0]["sure"]["right"], 100);
  EXPECT_EQ(json["worlds"][0]["confirmed"]["right"], 50);
  EXPECT_LT(json["log_loss"], 0.2);
}

TEST(VerdictFitCommand, WeightsOfATrialAreNotWritten) {
  const TemporaryFolder folder;
  const std::string table = TableOfMany(folder), out = folder / "v.yaml";
  const ProgramResult trial = RunProgram(
      FORESIGHTCTL,
      {"verdict", "fit", "drill", table, "--features", "rms_m", "--population", "x", "-o", out});
  EXPECT_EQ(trial.exit_code, 2) << trial.errors;
  EXPECT_NE(trial.errors.find("--features"), std::string::npos) << trial.errors;
  const ProgramResult unnamed =
      RunProgram(FORESIGHTCTL, {"verdict", "fit", "drill", table, "-o", out});
  EXPECT_EQ(unnamed.exit_code, 2) << unnamed.errors;
  EXPECT_NE(unnamed.errors.find("--population"), std::string::npos) << unnamed.errors;
  const ProgramResult unknown =
      RunProgram(FORESIGHTCTL, {"verdict", "fit", "drill", table, "--gate", "rim>=1"});
  EXPECT_EQ(unknown.exit_code, 2) << unknown.errors;
  EXPECT_NE(unknown.errors.find("rms_m"), std::string::npos) << unknown.errors;
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace foresight
