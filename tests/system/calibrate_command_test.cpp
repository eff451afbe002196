// foresightctl calibrate, target, rig export and import: what they print and exit with.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/sensor/rig_id.h"
#include "core/sensor/sensor_rig.h"
#include "tests/support/run_program.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

using testing::HasSubstr;

TEST(CalibrateCommand, PrintsOneObjectAModelAndWritesARig) {
  const std::string images = std::string(FORESIGHT_TEST_DATA) + "/calibration/opencv_left";
  if (!std::filesystem::exists(images)) GTEST_SKIP() << "no data: set FORESIGHT_TEST_DATA";
  const TemporaryFolder folder;
  const ProgramResult result =
      Ctl({"calibrate", "intrinsics", images, "--board", "checkerboard:9x6:25", "--model",
           "k,kb4,eucm,radtan", "--json", "--out", folder / "rig.yaml"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.output);
  ASSERT_EQ(json.size(), 4u);
  const std::vector<std::string> models = {"k", "kb4", "eucm", "radtan"};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& m = json[i];
    EXPECT_EQ(m["model"], models[i]);
    EXPECT_EQ(m["images_used"], 13);
    EXPECT_TRUE(m["images_rejected"].is_array());
    EXPECT_LT(m["mean_error_px"].get<double>(), 0.21);
    EXPECT_GT(m["rms_px"].get<double>(), m["mean_error_px"].get<double>());
    EXPECT_GT(m["parameters"]["fx"].get<double>(), 500.0);
    EXPECT_GT(m["sigma"]["fx"].get<double>(), 0.0);
    EXPECT_GT(m["cross_validation_px"].get<double>(), m["mean_error_px"].get<double>());
    EXPECT_EQ(m["board_warp_mm"].size(), 2u);
    EXPECT_GT(m["seconds"].get<double>(), 0.0);
  }
  const SensorRig rig = LoadSensorRig(folder / "rig.yaml").value();
  EXPECT_EQ(rig.parent_id, RigId(DefaultSensorRig()));
  EXPECT_EQ(rig.camera.width, 640);
}

TEST(CalibrateCommand, AWrongBoardIsANegativeResultInWords) {
  const std::string images = std::string(FORESIGHT_TEST_DATA) + "/calibration/opencv_left";
  if (!std::filesystem::exists(images)) GTEST_SKIP() << "no data: set FORESIGHT_TEST_DATA";
  const ProgramResult result =
      Ctl({"calibrate", "intrinsics", images + "/left01.jpg", images + "/left07.jpg", "--board",
           "checkerboard:8x6:25", "--json"});
  EXPECT_EQ(result.exit_code, 1);
  const auto json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json[0]["images_used"], 0);
  EXPECT_THAT(json[0]["images_rejected"][0]["reason"].get<std::string>(),
              HasSubstr("a board of 9x6 inner corners was found where 8x6 was asked for"));
  EXPECT_THAT(json[0]["failure"].get<std::string>(), HasSubstr("at least 4"));
}

TEST(CalibrateCommand, SaysWhatIsWrongWithTheCommandLine) {
  const TemporaryFolder folder;
  const std::string file = folder / "a.png";
  ASSERT_TRUE(WriteFileAtomically(file, "no image"));
  const ProgramResult board = Ctl({"calibrate", "intrinsics", file, "--board", "chess:7x6:50"});
  EXPECT_EQ(board.exit_code, 2);
  EXPECT_THAT(board.errors, HasSubstr("'chess' is no kind of board"));
  const ProgramResult model =
      Ctl({"calibrate", "intrinsics", file, "--board", "checkerboard:7x6:50", "--model", "kb5"});
  EXPECT_EQ(model.exit_code, 2);
  EXPECT_THAT(model.errors, HasSubstr("camera model 'kb5'"));
  EXPECT_EQ(Ctl({"calibrate", "intrinsics", file}).exit_code, 2);
  const ProgramResult damaged =
      Ctl({"calibrate", "intrinsics", file, "--board", "checkerboard:7x6:50"});
  EXPECT_EQ(damaged.exit_code, 3);
  EXPECT_THAT(damaged.errors, HasSubstr("is no PNG, JPEG"));
  EXPECT_EQ(
      Ctl({"calibrate", "intrinsics", folder / "none", "--board", "checkerboard:7x6:50"}).exit_code,
      3);
}

TEST(TargetCommand, WritesAPdfOrSaysWhatDoesNotFit) {
  const TemporaryFolder folder;
  const std::string file = folder / "board.pdf";
  EXPECT_EQ(Ctl({"target", "--board", "charuco:7x6:25", "--out", file}).exit_code, 0);
  EXPECT_EQ(ReadFile(file).value().substr(0, 5), "%PDF-");
  const ProgramResult large = Ctl({"target", "--board", "checkerboard:7x6:60", "--out", file});
  EXPECT_EQ(large.exit_code, 2);
  EXPECT_THAT(large.errors, HasSubstr("do not fit on A4"));
  EXPECT_EQ(Ctl({"target", "--mount", "--out", file}).exit_code, 0);
}

TEST(RigCommandFormats, ExportsAndImportsTheCamera) {
  const TemporaryFolder folder;
  const std::string rig = folder / "rig.yaml", other = folder / "cameras.txt";
  ASSERT_TRUE(SaveSensorRig(DefaultSensorRig(), rig));
  ASSERT_EQ(Ctl({"rig", "export", rig, "--format", "colmap", "--out", other}).exit_code, 0);
  EXPECT_THAT(ReadFile(other).value(), HasSubstr("1 FOV 1288 964"));
  ASSERT_EQ(
      Ctl({"rig", "import", other, "--format", "colmap", "--out", folder / "new.yaml"}).exit_code,
      0);
  const CameraModel camera = LoadSensorRig(folder / "new.yaml")->camera;
  EXPECT_NEAR(camera.fx, DefaultSensorRig().camera.fx, 1e-9);
  const ProgramResult ros = Ctl({"rig", "export", rig, "--format", "ros", "--out", other});
  EXPECT_THAT(ros.output, HasSubstr("a refit was written, off by 0.00"));
  EXPECT_EQ(Ctl({"rig", "export", rig, "--format", "xml", "--out", other}).exit_code, 2);
  EXPECT_EQ(Ctl({"rig", "import", rig, "--format", "colmap", "--out", other}).exit_code, 3);
}

}  // namespace
}  // namespace foresight
