// Real images: FORESIGHT_TEST_DATA/calibration. The numbers are those of issue 13.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/calibration/board_images.h"

namespace foresight {
namespace {

const std::string kData = std::string(FORESIGHT_TEST_DATA) + "/calibration/";

struct RealSet {
  BoardImages images;
  IntrinsicsCalibration calibration;
  const ModelCalibration& Of(LensModel model) const {
    for (const ModelCalibration& m : calibration.models)
      if (m.model == model) return m;
    throw std::logic_error("a model that was not asked for");
  }
};

RealSet Calibrated(const std::string& folder, const std::string& board_text) {
  RealSet set;
  const CalibrationBoard board = CalibrationBoardFromText(board_text).value();
  const auto files = ListImageFiles({kData + folder});
  EXPECT_TRUE(files) << files.error().message;
  if (!files) return set;
  set.images = DetectBoards(*files, board, RunContext()).value();
  for (const RejectedImage& image : set.images.rejected)
    ADD_FAILURE() << image.name << ": " << image.reason;
  IntrinsicsOptions options;
  options.models.push_back(LensModel::kRadialTangential);
  auto result = CalibrateIntrinsics(board, set.images.images, set.images.width, set.images.height,
                                    options, RunContext());
  EXPECT_TRUE(result) << result.error().message;
  if (result) set.calibration = std::move(*result);
  return set;
}

bool Missing(const std::string& folder) {
  return std::string(FORESIGHT_TEST_DATA).empty() || !std::filesystem::exists(kData + folder);
}

TEST(RealImages, OcamFisheye1IsWithinTheBarsWithEveryImage) {
  if (Missing("ocam_fisheye1")) GTEST_SKIP() << "no data: set FORESIGHT_TEST_DATA";
  const RealSet set = Calibrated("ocam_fisheye1", "checkerboard:6x8:32.5");
  EXPECT_EQ(set.calibration.images_used.size(), 15u);
  EXPECT_LE(set.Of(LensModel::kKannalaBrandt).mean_error_px, 0.44);
  EXPECT_LE(set.Of(LensModel::kFisheyeK).mean_error_px, 0.71);
  // Lenses that bend towards 180 deg need more than k; the study's was 1.030.
  EXPECT_NE(set.calibration.models[static_cast<std::size_t>(set.calibration.best)].model,
            LensModel::kFisheyeK);
  EXPECT_NEAR(std::get<FisheyeLens>(set.Of(LensModel::kFisheyeK).camera.lens).k, 1.030, 0.01);
}

TEST(RealImages, AnOrdinaryLensIsWithinTheBarWithEveryImage) {
  if (Missing("opencv_left")) GTEST_SKIP() << "no data: set FORESIGHT_TEST_DATA";
  const RealSet set = Calibrated("opencv_left", "checkerboard:9x6:25");
  EXPECT_EQ(set.calibration.images_used.size(), 13u);
  EXPECT_LE(set.Of(LensModel::kKannalaBrandt).mean_error_px, 0.21);
  // OpenCV's own answer for these images is fx = 534.1, fy = 534.1, within some tenths.
  EXPECT_NEAR(set.Of(LensModel::kRadialTangential).camera.fx, 534.0, 2.5);
}

TEST(RealImages, FindsTheBoardOfALongLens) {
  if (Missing("lcct")) GTEST_SKIP() << "no data: set FORESIGHT_TEST_DATA";
  const RealSet set = Calibrated("lcct", "checkerboard:7x5:30");
  EXPECT_EQ(set.calibration.images_used.size(), 15u);
  EXPECT_LE(set.Of(LensModel::kRadialTangential).mean_error_px, 0.12);
}

TEST(RealImages, AWrongSizeOfTheBoardIsNamed) {
  if (Missing("opencv_left")) GTEST_SKIP() << "no data: set FORESIGHT_TEST_DATA";
  for (const char* wrong : {"checkerboard:8x6:25", "checkerboard:9x7:25"}) {
    const CalibrationBoard board = CalibrationBoardFromText(wrong).value();
    const auto files =
        ListImageFiles({kData + "opencv_left/left03.jpg", kData + "opencv_left/left07.jpg"});
    const BoardImages images = DetectBoards(*files, board, RunContext()).value();
    EXPECT_TRUE(images.images.empty());
    for (const RejectedImage& image : images.rejected)
      EXPECT_NE(image.reason.find("a board of 9x6 inner corners was found where"),
                std::string::npos)
          << wrong << ", " << image.name << ": " << image.reason;
  }
}

}  // namespace
}  // namespace foresight
