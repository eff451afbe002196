// Whatever is fed to foresightctl: one clear line, the right exit code, nothing written half.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/io/png.h"
#include "core/sensor/sensor_rig.h"
#include "tests/nasty/png_bomb.h"
#include "tests/support/run_program.h"
#include "tests/support/sanitized.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

/// Bad data: exit 3 and a last line on standard error that names `where`. Notes may come before it.
void ExpectBadData(const ProgramResult& result, const std::string& where) {
  EXPECT_EQ(result.exit_code, 3) << result.errors;
  EXPECT_NE(result.errors.find(where), std::string::npos) << result.errors;
  // With --json standard output holds the error, and nothing else.
  EXPECT_TRUE(result.output.empty() || nlohmann::json::parse(result.output).contains("error"))
      << result.output;
}

class BadInput : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(WritePng(folder_ / "image.png", ColorImage(64, 48, {120, 120, 120})));
    std::string csv = "line,beam,u,v,depth_mm\n";
    for (int line = 0; line < 4; ++line)
      for (int beam = 0; beam < 16; ++beam)
        csv += fmt::format("{},{},{},{},{}\n", line, beam, 4 * beam, 12 * line, 1500);
    csv_ = csv;
  }
  ProgramResult Upsample(const std::string& csv, const std::vector<std::string>& more = {}) {
    EXPECT_TRUE(WriteFileAtomically(folder_ / "samples.csv", csv));
    std::vector<std::string> arguments = {"upsample", folder_ / "image.png",
                                          folder_ / "samples.csv", "--out", out_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(FORESIGHTCTL, arguments);
  }

  TemporaryFolder folder_;
  std::string out_ = folder_ / "out";
  std::string csv_;
};

TEST_F(BadInput, GoodInputPasses) {
  const ProgramResult result = Upsample(csv_);
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  for (const char* file : {"depth.pfm", "confidence.pfm", "mask.png"})
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(out_) / file)) << file;
}

TEST_F(BadInput, ACsvWithNanNamesTheLineAndWritesNothing) {
  ExpectBadData(Upsample(csv_ + "9,9,5,5,nan\n"), "samples.csv:66");
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(BadInput, ACsvWithANegativeDepthOrWithoutAColumnIsRefused) {
  ExpectBadData(Upsample(csv_ + "9,9,5,5,-3\n"), "samples.csv:66");
  ExpectBadData(Upsample("line,beam,u,v\n0,0,1,1\n"), "depth_mm");
  ExpectBadData(Upsample(""), "samples.csv");
}

TEST_F(BadInput, TwoSamplesAtOnePlaceOfTheGridAreRefused) {
  ExpectBadData(Upsample(csv_ + "0,0,9,9,1400\n"), "line 0, beam 0 is there twice");
}

TEST_F(BadInput, AnAbsurdGridIsRefusedBeforeItEatsTheMemory) {
  ExpectBadData(Upsample(csv_ + "2000000000,2000000000,9,9,1400\n"), "samples.csv");
}

TEST_F(BadInput, AnImageOfAnotherSizeThanTheCalibrationIsRefused) {
  ASSERT_TRUE(SaveSensorRig(DefaultSensorRig(), folder_ / "rig.yaml"));
  ExpectBadData(Upsample(csv_, {"--rig", folder_ / "rig.yaml"}), "1288 x 964");
}

TEST_F(BadInput, ATruncatedImageIsRefused) {
  const std::string png = ReadFile(folder_ / "image.png").value();
  ASSERT_TRUE(WriteFileAtomically(folder_ / "image.png", png.substr(0, png.size() / 2)));
  ExpectBadData(Upsample(csv_), "image.png");
}

TEST_F(BadInput, AnImageOfFarTooManyPixelsIsRefusedUnderFourGigabytes) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer needs more address space than that";
  // 20000 x 20000 of 16 bits, whole: 800 MB of zeros in less than a megabyte.
  ASSERT_TRUE(WriteFileAtomically(folder_ / "image.png",
                                  nasty::PngBomb(20000, 20000, 16, nasty::PngColor::kGray)));
  ASSERT_TRUE(WriteFileAtomically(folder_ / "samples.csv", csv_));
  RunLimits limits;
  limits.memory_bytes = std::size_t{4} << 30;
  ExpectBadData(
      RunProgram(FORESIGHTCTL,
                 {"upsample", folder_ / "image.png", folder_ / "samples.csv", "--out", out_},
                 limits),
      "image.png: 20000 x 20000 pixels are more than 200 million");
}

TEST_F(BadInput, ASceneWithATypoNamesTheLine) {
  std::string scene = ReadFile(kValveScene).value();
  const auto at = scene.find("lights:");
  ASSERT_NE(at, std::string::npos);
  scene.replace(at, 7, "lihgts:");
  ASSERT_TRUE(WriteFileAtomically(folder_ / "scene.yaml", scene));
  const auto line =
      1 + std::count(scene.begin(), scene.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  ExpectBadData(RunProgram(FORESIGHTCTL, {"render", folder_ / "scene.yaml", "--out", out_}),
                fmt::format("scene.yaml:{}", line));
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(BadInput, APfmWithAWrongHeaderIsRefused) {
  const std::filesystem::path scene = folder_ / "stereo";
  std::filesystem::create_directory(scene);
  ASSERT_TRUE(WriteFileAtomically(scene / "calib.txt",
                                  "cam0=[500 0 32; 0 500 24; 0 0 1]\ncam1=[500 0 32; 0 500 24; 0 0 "
                                  "1]\ndoffs=0\nbaseline=100\n"));
  std::filesystem::copy(folder_ / "image.png", scene / "im0.png");
  std::filesystem::copy(folder_ / "image.png", scene / "im1.png");
  for (const char* header : {"P5\n64 48\n-1\n", "Pf\n64\n", "Pf\n-64 48\n-1\n", "Pf\n64 48\n-1\n",
                             "PF\n64 48\n-1\n", ""}) {
    ASSERT_TRUE(WriteFileAtomically(scene / "disp0GT.pfm", header));
    ExpectBadData(RunProgram(FORESIGHTCTL, {"evaluate", scene.string(), "--json"}), "disp0GT.pfm");
  }
}

TEST_F(BadInput, AMissionFileCutAnywhereIsRefusedOrWhole) {
  const std::string mission = folder_ / "mission.foresight";
  ASSERT_EQ(RunProgram(FORESIGHTCTL, {"scan", "--scene", kValveScene, "--from", "-1", "--to", "1",
                                      "--speed", "40", "--out", mission})
                .exit_code,
            0);
  const std::string bytes = ReadFile(mission).value();
  Random random(1);
  const std::string cut = folder_ / "cut.foresight";
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(WriteFileAtomically(
        cut, bytes.substr(0, static_cast<std::size_t>(random.Uniform() *
                                                      static_cast<double>(bytes.size())))));
    const ProgramResult result = RunProgram(FORESIGHTCTL, {"depth", cut, "--out", out_});
    ExpectBadData(result, "cut.foresight");
    EXPECT_EQ(result.ErrorLines(), 1) << result.errors;
    EXPECT_FALSE(std::filesystem::exists(out_));
  }
}

TEST_F(BadInput, AMissingFileIsBadDataAndAMissingArgumentIsWrongUsage) {
  ExpectBadData(RunProgram(FORESIGHTCTL, {"depth", folder_ / "none.foresight"}), "none.foresight");
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {"depth"}).exit_code, 2);
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {}).exit_code, 2);
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {"upsample", "a", "b", "--threshold", "7"}).exit_code, 2);
  EXPECT_EQ(RunProgram(FORESIGHTCTL,
                       {"scan", "--scene", kValveScene, "--out", folder_ / "m", "--speed", "-4"})
                .exit_code,
            2);
}

}  // namespace
}  // namespace foresight
