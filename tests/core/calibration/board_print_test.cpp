#include "core/calibration/board_print.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/base/atomic_file.h"
#include "core/calibration/board_detector.h"
#include "core/calibration/mount_detector.h"
#include "core/io/image_file.h"
#include "core/sensor/sensor_rig.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// The PDF's page as poppler's pdftoppm draws it; nullopt where that program is missing.
std::optional<GrayImage> Rasterised(const std::string& pdf, int dots_per_inch) {
  if (std::system("command -v pdftoppm > /dev/null 2>&1") != 0) return std::nullopt;
  const TemporaryFolder folder;
  const std::string stem = folder / "board";
  EXPECT_TRUE(WriteFileAtomically(stem + ".pdf", pdf));
  const std::string command = "pdftoppm -r " + std::to_string(dots_per_inch) +
                              " -gray -singlefile '" + stem + ".pdf' '" + stem + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  auto image = ReadImageGray(stem + ".pgm");
  EXPECT_TRUE(image) << image.error().message;
  return image ? std::optional(std::move(*image)) : std::nullopt;
}

TEST(BoardPrint, PrintsWhatTheDetectorFindsInItsTrueSize) {
  for (const char* text : {"checkerboard:7x6:25", "charuco:7x6:25", "charuco:8x5:25:18:4x4_50"}) {
    SCOPED_TRACE(text);
    const CalibrationBoard board = CalibrationBoardFromText(text).value();
    const auto pdf = BoardPdf(board, PaperFromText("A4", board).value());
    ASSERT_TRUE(pdf) << pdf.error().message;
    constexpr int kDotsPerInch = 200;
    const auto image = Rasterised(*pdf, kDotsPerInch);
    if (!image) GTEST_SKIP() << "needs pdftoppm (poppler-utils)";
    const BoardDetection found = DetectBoard(*image, board);
    ASSERT_EQ(found.rejection, "");
    ASSERT_EQ(found.view.pixels.size(), static_cast<std::size_t>(board.CornerCount()));
    // Every corner lies where its size says, in dots, against corner 0.
    const double dots_per_m = kDotsPerInch / 0.0254;
    for (std::size_t i = 0; i < found.view.pixels.size(); ++i) {
      const Eigen::Vector2d expected =
          found.view.pixels[0] +
          dots_per_m * (board.Corner(found.view.corner_ids[i]) - board.Corner(0)).head<2>();
      // pdftoppm rounds where each square begins to dots, of 0.13 mm.
      EXPECT_LT((found.view.pixels[i] - expected).norm(), 1.2);
    }
  }
}

TEST(BoardPrint, ACharucoBoardThatIsOverexposedIsNotTaken) {
  const CalibrationBoard board = CalibrationBoardFromText("charuco:7x6:25").value();
  auto image = Rasterised(*BoardPdf(board, PaperFromText("A4", board).value()), 100);
  if (!image) GTEST_SKIP() << "needs pdftoppm (poppler-utils)";
  const BoardDetection good = DetectBoard(*image, board);
  EXPECT_EQ(good.rejection, "");
  EXPECT_LT(good.rating.dark_level, 10.0);
  EXPECT_GT(good.rating.light_level, 245.0);
  for (int y = 0; y < image->height(); ++y)
    for (int x = 0; x < image->width(); ++x)
      (*image)(x, y) = static_cast<std::uint8_t>(std::min(255, 150 + (*image)(x, y)));
  const BoardDetection bright = DetectBoard(*image, board);
  EXPECT_THAT(bright.rejection, HasSubstr("overexposed: 100 % of the white squares"));
  EXPECT_TRUE(bright.view.pixels.empty());
  BoardMount mount;
  mount.a = board;
  CameraModel camera = DefaultSensorRig().camera;
  EXPECT_THAT(DetectMount(*image, mount, camera).fault, HasSubstr("of the white squares"));
}

TEST(BoardPrint, TwoPrintsOfOneBoardAreEqual) {
  const CalibrationBoard board = CalibrationBoardFromText("charuco:7x6:25").value();
  const Paper paper = PaperFromText("A4", board).value();
  EXPECT_EQ(BoardPdf(board, paper).value(), BoardPdf(board, paper).value());
}

TEST(BoardPrint, SaysThatABoardDoesNotFit) {
  const CalibrationBoard board = CalibrationBoardFromText("checkerboard:7x6:50").value();
  const auto pdf = BoardPdf(board, PaperFromText("A4", board).value());
  ASSERT_FALSE(pdf);
  EXPECT_THAT(pdf.error().message, HasSubstr("400 x 350 mm and 14 mm all round do not fit on A4"));
  EXPECT_TRUE(BoardPdf(board, PaperFromText("fit", board).value()));
  EXPECT_TRUE(BoardPdf(board, PaperFromText("500x400", board).value()));
  EXPECT_THAT(PaperFromText("A7", board).error().message, HasSubstr("paper 'A7' is not A4"));
}

TEST(BoardPrint, DrawsTheMount) {
  const CalibrationBoard board = CalibrationBoardFromText("checkerboard:7x6:50").value();
  const auto pdf = TwoBoardMountPdf(board);
  ASSERT_TRUE(pdf);
  EXPECT_EQ(pdf->substr(0, 5), "%PDF-");
  const auto image = Rasterised(*pdf, 50);
  if (!image) GTEST_SKIP() << "needs pdftoppm (poppler-utils)";
  int black = 0;
  for (const std::uint8_t grey : image->values()) black += grey < 64 ? 1 : 0;
  EXPECT_GT(black, 2000);
}

}  // namespace
}  // namespace foresight
