#include "core/calibration/camera_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/atomic_file.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

struct CameraSessionFolder : testing::Test {
  fs::path folder =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  CameraSessionFolder() { fs::remove_all(folder); }
  ~CameraSessionFolder() override { fs::remove_all(folder); }
};

CameraSession Session() {
  return {.board = {.columns = 7, .rows = 6, .square_m = 0.0295},
          .models = {LensModel::kFisheyeK, LensModel::kRadialTangential},
          .images = {{.file = "001-a.png", .name = "/home/x/\"a\".png", .excluded = true},
                     {.file = "002-b.jpg", .name = "b: c.jpg"}}};
}

TEST_F(CameraSessionFolder, ASessionComesBackAsItWas) {
  ASSERT_TRUE(SaveCameraSession(Session(), folder));
  EXPECT_TRUE(IsCameraSession(folder));
  const auto loaded = LoadCameraSession(folder);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(*loaded, Session());
}

TEST_F(CameraSessionFolder, AnImageThatWasCopiedAndNotListedIsNotLost) {
  ASSERT_TRUE(SaveCameraSession(Session(), folder));
  ASSERT_TRUE(WriteFileAtomically(CameraSessionImages(folder) / "003-c.png", "x"));
  const auto loaded = LoadCameraSession(folder);
  ASSERT_TRUE(loaded);
  ASSERT_EQ(loaded->images.size(), 3u);
  EXPECT_EQ(loaded->images[2].file, "003-c.png");
}

TEST_F(CameraSessionFolder, AFileThatPointsOutOfTheFolderIsRefused) {
  CameraSession session = Session();
  session.images[0].file = "../../secret.png";
  ASSERT_TRUE(SaveCameraSession(session, folder));
  const auto loaded = LoadCameraSession(folder);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().code, ErrorCode::kBadData);
  EXPECT_THAT(loaded.error().message, testing::HasSubstr("secret.png"));
}

TEST_F(CameraSessionFolder, ABrokenFileNamesItsLine) {
  fs::create_directories(folder);
  std::ofstream(folder / "camera_session.yaml")
      << "foresight_camera_session: 1\nboard: \"checkerboard:2x6:30\"\nmodels: \"k\"\n";
  const auto loaded = LoadCameraSession(folder);
  ASSERT_FALSE(loaded);
  EXPECT_THAT(loaded.error().message, testing::HasSubstr("camera_session.yaml:"));
}

}  // namespace
}  // namespace foresight
