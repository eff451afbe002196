#include "core/evaluation/stereo_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/atomic_file.h"
#include "core/io/pfm.h"
#include "core/io/png.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

constexpr int kWidth = 12;
constexpr int kHeight = 8;
constexpr float kInf = std::numeric_limits<float>::infinity();

/// As the full-size folders have it, with the keys that are not read.
constexpr const char* kCalibration =
    "cam0=[500 0 6; 0 500 4; 0 0 1]\ncam1=[500 0 8; 0 500 4; 0 0 1]\ndoffs=2\nbaseline=100\n"
    "width=12\nheight=8\nndisp=64\nisint=0\nvmin=2\nvmax=60\ndyavg=0\ndymax=0\n";

/// A folder with calibration and images, without any disparity.
class StereoFolder : public testing::Test {
 protected:
  void SetUp() override {
    Write("calib.txt", kCalibration);
    ASSERT_TRUE(WritePng(folder_ / "im0.png", ColorImage(kWidth, kHeight)));
    ASSERT_TRUE(WritePng(folder_ / "im1.png", ColorImage(kWidth, kHeight, {1, 2, 3})));
  }
  void Write(const std::string& name, const std::string& text) {
    ASSERT_TRUE(WriteFileAtomically(folder_ / name, text));
  }
  void WriteDisparity(const std::string& name, float disparity, int width = kWidth) {
    FloatImage image(width, kHeight, disparity);
    image(0, 0) = kInf;
    ASSERT_TRUE(WritePfm(folder_ / name, image));
  }
  std::string ErrorOfLoading() {
    const auto scene = LoadStereoScene(folder_.path());
    return scene ? "" : scene.error().message;
  }
  void ExpectError(const std::string& part) {
    EXPECT_NE(ErrorOfLoading().find(part), std::string::npos) << ErrorOfLoading();
  }

  TemporaryFolder folder_;
};

TEST_F(StereoFolder, OfTheReducedSetsIsRead) {
  WriteDisparity("disp0GT.pfm", 8.0f);
  MaskImage seen(kWidth, kHeight, 255);
  seen(3, 2) = 128;
  ASSERT_TRUE(WritePng(folder_ / "mask0nocc.png", seen));
  const auto scene = LoadStereoScene(folder_.path());
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_NEAR(scene->DepthOf(scene->left_disparity(1, 1)), 0.1 * 500.0 / (8.0 + 2.0), 1e-12);
  EXPECT_TRUE(std::isnan(scene->left_disparity(0, 0)));
  EXPECT_EQ(scene->left_in_both(3, 2), 128);
  EXPECT_TRUE(scene->right_disparity.empty());
  EXPECT_EQ(scene->right(5, 5), (Rgb8{1, 2, 3}));
}

TEST_F(StereoFolder, OfFullSizeIsReadWithTheRightViewsOwnTruth) {
  WriteDisparity("disp0.pfm", 8.0f);
  WriteDisparity("disp1.pfm", 6.0f);
  const auto scene = LoadStereoScene(folder_.path());
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->left_disparity(1, 1), 8.0f);
  EXPECT_EQ(scene->right_disparity(1, 1), 6.0f);
  EXPECT_TRUE(std::isnan(scene->right_disparity(0, 0)));
  EXPECT_EQ(scene->left_in_both(3, 2), 255);
}

TEST_F(StereoFolder, OfTheReducedSetsMayHaveTheRightViewsTruthToo) {
  WriteDisparity("disp0GT.pfm", 8.0f);
  WriteDisparity("disp1GT.pfm", 7.0f);
  const auto scene = LoadStereoScene(folder_.path());
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->right_disparity(1, 1), 7.0f);
}

TEST_F(StereoFolder, WithoutDisparityIsRefusedByBothItsNames) {
  ExpectError("neither disp0GT.pfm nor disp0.pfm");
  EXPECT_EQ(LoadStereoScene(folder_.path()).error().code, ErrorCode::kIo);
}

TEST_F(StereoFolder, WithAnImageOfAnotherSizeIsRefusedByItsName) {
  WriteDisparity("disp0.pfm", 8.0f);
  WriteDisparity("disp1.pfm", 8.0f, kWidth - 1);
  ExpectError("disp1.pfm: 11 x 8 pixels, but im1.png has 12 x 8");
}

TEST_F(StereoFolder, WithACalibrationForAnotherSizeIsRefused) {
  // A folder put together from two sizes of the data set: its depths would be wrong by that factor.
  std::string other = kCalibration;
  other.replace(other.find("width=12"), 8, "width=48");
  Write("calib.txt", other);
  WriteDisparity("disp0.pfm", 8.0f);
  ExpectError("is for 48 x 8 pixels, but im1.png has 12 x 8");
}

TEST_F(StereoFolder, NeedNotSayItsSize) {
  Write("calib.txt",
        "cam0=[500 0 6; 0 500 4; 0 0 1]\ncam1=[500 0 8; 0 500 4; 0 0 1]\ndoffs=2\nbaseline=100\n");
  WriteDisparity("disp0.pfm", 8.0f);
  EXPECT_EQ(ErrorOfLoading(), "");
}

TEST_F(StereoFolder, WithABadCalibrationIsRefusedByKeyAndValue) {
  const std::string good = kCalibration;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  Write("calib.txt", with("cam1=", "cam2="));
  ExpectError("'cam1' is missing");
  Write("calib.txt", with("doffs=2", "doffs=two"));
  ExpectError("'doffs' is 'two', not 1 numbers");
  Write("calib.txt", with("baseline=100", "baseline=0"));
  ExpectError("baseline 0 mm must be positive");
  Write("calib.txt", with("cam1=[500", "cam1=[505"));
  ExpectError("500 and 505 px");
  Write("calib.txt", with("width=12", "width=-3"));
  ExpectError("'width' is -3");
}

}  // namespace
}  // namespace foresight
