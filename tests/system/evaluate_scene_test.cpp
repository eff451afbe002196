// Scoring depth methods on a simulated scan, from the command line.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace foresight {
namespace {

TEST(EvaluateScene, PrintsTheScoresOfEachMethodAndTheCalibrationsError) {
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"evaluate", FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml",
                                "--method", "paper,foresight", "--rotation-error-deg", "0.05",
                                "--translation-error-mm", "2", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto rows = nlohmann::json::parse(result.output);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["method"], "foresight");
  EXPECT_EQ(rows[1]["method"], "paper");
  // Both at one coverage: Foresight's own row says the same twice.
  for (const char* key : {"a80_mm", "a95_mm", "coverage"})
    EXPECT_EQ(rows[0]["in_foresight_mask"][key], rows[0][key]) << key;
  EXPECT_GT(rows[1]["in_foresight_mask"]["coverage"].get<double>(),
            rows[1]["coverage"].get<double>());
  EXPECT_LE(rows[1]["in_foresight_mask"]["coverage"].get<double>(),
            rows[0]["coverage"].get<double>());
  EXPECT_GT(rows[1]["in_foresight_mask"]["a95_mm"].get<double>(), rows[1]["a95_mm"].get<double>());
  for (const auto& row : rows) {
    EXPECT_EQ(row["scene"], "valve");
    for (const char* key : {"seconds", "samples", "rejected", "rejection_recall"})
      EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_NEAR(row["calibration_error"]["rotation_deg"].get<double>(), 0.05, 1e-12);
    EXPECT_NEAR(row["calibration_error"]["translation_mm"].get<double>(), 2.0, 1e-12);
    // The lidar's noise is 5 mm at this range, the calibration's error 2 to 4 mm.
    EXPECT_LT(row["a80_mm"].get<double>(), 10.0);
    EXPECT_GE(row["without_mask"]["coverage"].get<double>(), row["coverage"].get<double>());
    EXPECT_GT(row["coverage"].get<double>(), 0.8);
    EXPECT_LT(row["unscored_kept"].get<double>(), 0.1);
  }
}

TEST(EvaluateScene, WithoutForesightThereIsNoMaskToShare) {
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"evaluate", FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml",
                                "--method", "paper", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_FALSE(nlohmann::json::parse(result.output)[0].contains("in_foresight_mask"));
}

TEST(EvaluateScene, RefusesAnErrorBeyondReason) {
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"evaluate", FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml",
                                "--rotation-error-deg", "-1"});
  EXPECT_EQ(result.exit_code, 2);
}

}  // namespace
}  // namespace foresight
