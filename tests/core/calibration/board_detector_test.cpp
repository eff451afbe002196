#include "core/calibration/board_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

#include "core/calibration/board_images.h"
#include "core/io/png.h"
#include "tests/core/calibration/synthetic_views.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

CameraModel SmallFisheye() {
  return {.width = 640,
          .height = 480,
          .fx = 300.0,
          .fy = 300.0,
          .cx = 321.0,
          .cy = 238.0,
          .lens = FisheyeLens{0.9413}};
}

CameraFromPattern PoseOf(const CalibrationBoard& board, double distance_m, double tilt_rad,
                         double aside_rad = 0.0, double roll_rad = 0.0) {
  const Eigen::Vector3d middle = 0.5 * (board.Corner(0) + board.Corner(board.CornerCount() - 1));
  const Eigen::Quaterniond look(Eigen::AngleAxisd(aside_rad, Eigen::Vector3d::UnitY()));
  const Eigen::Quaterniond rotation = look *
                                      Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d(0.6, 0.8, 0.0)) *
                                      Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ());
  return {rotation, look * Eigen::Vector3d(0.0, 0.0, distance_m) - rotation * middle};
}

double RmsAgainstTruth(const CalibrationBoard& board, const CameraModel& camera,
                       const CameraFromPattern& pose, const BoardView& view) {
  double sum = 0.0;
  for (std::size_t i = 0; i < view.pixels.size(); ++i)
    sum +=
        (*camera.Project(pose * board.Corner(view.corner_ids[i])) - view.pixels[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(view.pixels.size()));
}

constexpr double kLargestRms_px = 0.15;
const CalibrationBoard kBoard{.columns = 7, .rows = 6, .square_m = 0.05};

TEST(BoardDetector, FindsCornersToAFractionOfAPixelInAFisheyeImage) {
  for (const double tilt : {0.0, 0.4, 0.8})
    for (const double aside : {0.0, 0.6}) {
      SCOPED_TRACE(testing::Message() << "tilt " << tilt << ", aside " << aside);
      const auto pose = PoseOf(kBoard, 0.55, tilt, aside, 0.1);
      const auto found = DetectBoard(RenderBoard(kBoard, SmallFisheye(), pose), kBoard);
      ASSERT_EQ(found.rejection, "");
      ASSERT_EQ(found.view.pixels.size(), 42u);
      // Squares of 14 to 25 px, edges to a quarter of a pixel: measured 0.05 to 0.12 px.
      EXPECT_LT(RmsAgainstTruth(kBoard, SmallFisheye(), pose, found.view), kLargestRms_px);
    }
}

TEST(BoardDetector, NamesTheSameCornersHoweverTheBoardIsTurned) {
  for (const double roll : {0.0, 0.8, 1.57, 2.4, 3.14, 4.7}) {
    SCOPED_TRACE(roll);
    const auto pose = PoseOf(kBoard, 0.6, 0.3, 0.1, roll);
    const auto found = DetectBoard(RenderBoard(kBoard, SmallFisheye(), pose), kBoard);
    ASSERT_EQ(found.rejection, "");
    EXPECT_LT(RmsAgainstTruth(kBoard, SmallFisheye(), pose, found.view), kLargestRms_px);
  }
}

TEST(BoardDetector, SaysWhichBoardIsThereInstead) {
  const GrayImage image = RenderBoard(kBoard, SmallFisheye(), PoseOf(kBoard, 0.6, 0.3));
  for (const auto& [columns, rows] : {std::pair(8, 6), std::pair(6, 6), std::pair(7, 5)}) {
    const CalibrationBoard asked{.columns = columns, .rows = rows, .square_m = 0.05};
    const auto found = DetectBoard(image, asked);
    EXPECT_TRUE(found.view.pixels.empty());
    EXPECT_THAT(found.rejection,
                testing::AnyOf(HasSubstr("a board of 7x6 inner corners was found where"),
                               HasSubstr("a board of 6x7 inner corners was found where")));
  }
}

GrayImage Mapped(const GrayImage& image, const std::function<double(int, int)>& grey) {
  GrayImage result = image;
  for (int v = 0; v < image.height(); ++v)
    for (int u = 0; u < image.width(); ++u)
      result(u, v) = static_cast<std::uint8_t>(std::clamp(grey(u, v), 0.0, 255.0));
  return result;
}

GrayImage Blurred(const GrayImage& image, int radius) {
  // Box filter twice: close to a defocused lens.
  GrayImage result = image;
  for (int pass = 0; pass < 2; ++pass) {
    const GrayImage from = result;
    result = Mapped(from, [&](int u, int v) {
      double sum = 0.0;
      int count = 0;
      for (int y = std::max(0, v - radius); y <= std::min(from.height() - 1, v + radius); ++y)
        for (int x = std::max(0, u - radius); x <= std::min(from.width() - 1, u + radius); ++x) {
          sum += from(x, y);
          ++count;
        }
      return sum / count;
    });
  }
  return result;
}

TEST(BoardDetector, SaysThatAnImageIsBlurredOrBadlyExposedOrEmpty) {
  const GrayImage image = RenderBoard(kBoard, SmallFisheye(), PoseOf(kBoard, 0.6, 0.3));
  EXPECT_THAT(DetectBoard(Blurred(image, 9), kBoard).rejection, HasSubstr("blurred"));
  const GrayImage bright = Mapped(image, [&](int u, int v) { return 6.0 * image(u, v) + 80.0; });
  EXPECT_THAT(DetectBoard(bright, kBoard).rejection, HasSubstr("overexposed"));
  const GrayImage dark = Mapped(image, [&](int u, int v) { return 0.02 * image(u, v); });
  EXPECT_THAT(DetectBoard(dark, kBoard).rejection, HasSubstr("underexposed"));
  const GrayImage wall(640, 480, 128);
  EXPECT_THAT(DetectBoard(wall, kBoard).rejection, HasSubstr("no board of 7x6 inner corners"));
}

// Grids are asked one by one; the whole image is looked at once, by who asks.
TEST(BoardDetector, OfGridsOnlyTheGridsAreJudged) {
  const GrayImage dark(640, 480);
  EXPECT_THAT(DetectBoard(dark, kBoard).rejection, HasSubstr("underexposed"));
  EXPECT_EQ(DetectBoard(dark, {}, kBoard, SearchEffort::kQuick).rejection,
            "no board of 7x6 inner corners was found");
}

TEST(BoardDetector, RatesSharpnessAndCoverage) {
  const auto pose = PoseOf(kBoard, 0.6, 0.0);
  const GrayImage image = RenderBoard(kBoard, SmallFisheye(), pose);
  const ImageRating sharp = DetectBoard(image, kBoard).rating;
  EXPECT_LT(sharp.edge_width_px, 2.0);
  EXPECT_NEAR(sharp.dark_level, 30.0, 3.0);
  EXPECT_NEAR(sharp.light_level, 220.0, 3.0);
  // 6 x 5 squares of about 25 px in 640 x 480.
  EXPECT_NEAR(sharp.coverage, 30.0 * sharp.spacing_px * sharp.spacing_px / (640.0 * 480.0), 0.01);
  EXPECT_GT(DetectBoard(Blurred(image, 2), kBoard).rating.edge_width_px, sharp.edge_width_px + 1.0);
}

class ImageFolder {
 public:
  std::string Path(const std::string& name) const { return folder_ / name; }
  void Add(const std::string& name, const GrayImage& image) const {
    ASSERT_TRUE(WritePng(Path(name), image));
  }

 private:
  TemporaryFolder folder_;
};

TEST(BoardImages, NamesEachFileThatCannotBeUsedAndWhy) {
  const ImageFolder folder;
  for (int i = 1; i <= 3; ++i)
    folder.Add("good" + std::to_string(i) + ".png",
               RenderBoard(kBoard, SmallFisheye(), PoseOf(kBoard, 0.6, 0.2 * i)));
  std::filesystem::copy(folder.Path("good2.png"), folder.Path("good10.png"));
  CameraModel other_size = SmallFisheye();
  other_size.width = 600;
  folder.Add("size.png", RenderBoard(kBoard, other_size, PoseOf(kBoard, 0.6, 0.2)));
  folder.Add("wall.png", GrayImage(640, 480, 128));
  std::ofstream(folder.Path("damaged.jpg")) << "\xff\xd8 no image";
  std::ofstream(folder.Path("text.png")) << "hello";

  const auto files = ListImageFiles({folder.Path("")});
  ASSERT_TRUE(files);
  ASSERT_EQ(files->size(), 8u);
  const BoardImages images = DetectBoards(*files, kBoard, RunContext()).value();
  EXPECT_EQ(images.images.size(), 3u);
  std::map<std::string, std::string> reasons;
  for (const RejectedImage& image : images.rejected)
    reasons[std::filesystem::path(image.name).filename().string()] = image.reason;
  EXPECT_EQ(reasons.size(), 5u);
  EXPECT_THAT(reasons["good10.png"], HasSubstr("the same image as"));
  EXPECT_THAT(reasons["good10.png"], HasSubstr("good2.png"));
  EXPECT_EQ(reasons["size.png"], "its size is 600x480 where the other images have 640x480");
  EXPECT_THAT(reasons["wall.png"], HasSubstr("no board of 7x6"));
  EXPECT_THAT(reasons["damaged.jpg"], HasSubstr("damaged JPEG"));
  EXPECT_THAT(reasons["text.png"], HasSubstr("is no PNG, JPEG or binary PGM file"));
}

TEST(BoardImages, SaysWhatIsNotThere) {
  const ImageFolder folder;
  EXPECT_THAT(ListImageFiles({folder.Path("")}).error().message, HasSubstr("holds no .png"));
  EXPECT_THAT(ListImageFiles({folder.Path("nothing.png")}).error().message,
              HasSubstr("no such file or folder"));
}

}  // namespace
}  // namespace foresight
