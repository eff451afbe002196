// Every stage of the depth pipeline can be chosen on the command line.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/io/pfm.h"
#include "core/io/png.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

/// A plate at 1 m before a wall at 2 m; a column of the wall's samples has slipped onto the plate,
/// and the plate's own samples there are missing.
std::string PlateAndHiddenWall() {
  std::string csv = "line,beam,u,v,depth_mm\n";
  for (int line = 0; line < 10; ++line)
    for (int beam = 0; beam < 40; ++beam)
      csv += fmt::format("{},{},{},{},{}\n", line, beam, beam == 30 ? 50 : 4 * beam, 12 * line,
                         beam < 20 ? 1000 + 10 * (beam % 2) : 2000);
  return csv;
}

class DepthOptionsOnTheCommandLine : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(WritePng(folder_ / "image.png", ColorImage(160, 120, {120, 120, 120})));
    ASSERT_TRUE(WriteFileAtomically(folder_ / "samples.csv", PlateAndHiddenWall()));
  }
  ProgramResult Run(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "upsample", folder_ / "image.png", folder_ / "samples.csv", "--json",
        "--out",    folder_ / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(FORESIGHTCTL, arguments);
  }
  int Rejected(const std::vector<std::string>& more) {
    const ProgramResult result = Run(more);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return nlohmann::json::parse(result.output).at("rejected").get<int>();
  }

  TemporaryFolder folder_;
};

TEST_F(DepthOptionsOnTheCommandLine, ChooseTheRejection) {
  const std::vector<std::string> none = {"--method",   "paper", "--flying",   "off",
                                         "--isolated", "off",   "--flipping", "off"};
  EXPECT_EQ(Rejected(none), 0);
  const auto rejected_by = [&](const char* flying, const char* flipping,
                               std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--method", "paper", "--isolated", "off", "--flying", flying,
                             "--flipping", flipping});
    return Rejected(more);
  };
  // The step at beam 20: as printed both of its sides go; no sample is far from both neighbours.
  EXPECT_EQ(rejected_by("max", "off"), 20);
  EXPECT_EQ(rejected_by("min", "off"), 0);
  EXPECT_EQ(rejected_by("max", "off", {"--flying-threshold-mm", "5"}), 200 + 10);
  EXPECT_EQ(rejected_by("adaptive", "off"), 20);
  EXPECT_EQ(rejected_by("off", "cells"), 10);
  EXPECT_EQ(rejected_by("off", "mesh"), 10);
  EXPECT_EQ(rejected_by("off", "mesh", {"--flip-margin-mm", "50"}), 10);
  EXPECT_EQ(rejected_by("off", "mesh", {"--flip-margin-mm", "50", "--flip-step-mm", "5"}), 0);
  EXPECT_EQ(rejected_by("max", "cells", {"--flying-threshold-mm", "5", "--cells-from", "kept"}),
            210);
  EXPECT_EQ(rejected_by("max", "cells", {"--flying-threshold-mm", "5", "--cells-from", "all"}),
            220);
}

TEST_F(DepthOptionsOnTheCommandLine, ChooseTheConfidenceAndItsMask) {
  const auto largest = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--method", "paper"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = Run(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    const auto confidence = ReadPfm(folder_.path() / "out" / "confidence.pfm");
    return *std::max_element(confidence->values().begin(), confidence->values().end());
  };
  const float all = largest({});
  EXPECT_LT(largest({"--confidence", "guided"}), 0.9f * all);
  EXPECT_NEAR(largest({"--confidence", "every-depth"}), all, 0.05f * all);
  EXPECT_GT(largest({"--confidence-terms", "literal"}), 1.5f * all);
  EXPECT_GT(largest({"--weights", "literal"}), 1.5f * all);
  EXPECT_GT(largest({"--radius", "2"}), 1.2f * all);
  EXPECT_EQ(Run({"--method", "paper", "--mask-reference", "nominal"}).exit_code, 0);
}

TEST_F(DepthOptionsOnTheCommandLine, ReachTheMethodThatRuns) {
  const auto depth_with = [&](const std::vector<std::string>& more) {
    EXPECT_EQ(Run(more).exit_code, 0);
    return *ReadPfm(folder_.path() / "out" / "depth.pfm");
  };
  for (const std::string method : {"foresight", "tgv", "nonlocal", "jbu"})
    EXPECT_NE(depth_with({"--method", method, "--iterations", "1"}),
              depth_with({"--method", method, "--iterations", "2"}))
        << method;
  EXPECT_NE(depth_with({"--sigma-spatial", "6"}), depth_with({"--sigma-spatial", "12"}));
}

TEST_F(DepthOptionsOnTheCommandLine, RefuseWhatTheMethodDoesNotHave) {
  const ProgramResult result = Run({"--method", "tgv", "--weights", "literal"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.errors.find("--weights: method 'tgv'"), std::string::npos) << result.errors;
  EXPECT_EQ(Run({"--flying", "often"}).exit_code, 2);
  EXPECT_EQ(Run({"--method", "jbu", "--confidence", "guided"}).exit_code, 2);
}

TEST_F(DepthOptionsOnTheCommandLine, WarnBelowTwoPercent) {
  std::string csv = "line,beam,u,v,depth_mm\n";
  for (int i = 0; i < 16; ++i)
    csv += fmt::format("{},{},{},{},1500\n", i / 4, i % 4, 30 * (i % 4), 30 * (i / 4));
  ASSERT_TRUE(WriteFileAtomically(folder_ / "samples.csv", csv));
  const ProgramResult result = Run({});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.errors.find("below 2 %"), std::string::npos) << result.errors;
  EXPECT_TRUE(nlohmann::json::parse(result.output).at("below_density_floor").get<bool>());
}

}  // namespace
}  // namespace foresight
