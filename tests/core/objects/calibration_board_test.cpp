#include "core/objects/calibration_board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace foresight {
namespace {

using testing::HasSubstr;

TEST(CalibrationBoard, CornersRunAlongRowsFromTheOrigin) {
  const CalibrationBoard board{.columns = 7, .rows = 6, .square_m = 0.05};
  EXPECT_EQ(board.CornerCount(), 42);
  EXPECT_EQ(board.Corner(0), Eigen::Vector3d(0.0, 0.0, 0.0));
  EXPECT_EQ(board.Corner(6), Eigen::Vector3d(6 * 0.05, 0.0, 0.0));
  EXPECT_EQ(board.Corner(7), Eigen::Vector3d(0.0, 0.05, 0.0));
  EXPECT_EQ(board.Corner(41), Eigen::Vector3d(6 * 0.05, 5 * 0.05, 0.0));
}

TEST(CalibrationBoard, OutlineIsOneSquareBeyondTheCornersAndClockwiseForWhoLooksAtIt) {
  const CalibrationBoard board{.columns = 7, .rows = 6, .square_m = 0.05};
  const auto outline = board.Outline();
  EXPECT_EQ(outline[0], Eigen::Vector3d(-0.05, -0.05, 0.0));
  EXPECT_NEAR((outline[2] - outline[0]).x(), board.Width(), 1e-15);
  EXPECT_NEAR((outline[2] - outline[0]).y(), board.Height(), 1e-15);
  // z points away from who looks: clockwise for him is positive about z.
  EXPECT_GT((outline[1] - outline[0]).cross(outline[2] - outline[1]).z(), 0.0);
}

TEST(CalibrationBoard, WarpDeepensTheMiddleAndLeavesTheGridsCornersAlone) {
  const CalibrationBoard board{.columns = 7, .rows = 5, .square_m = 0.05};
  const BoardWarp warp{.x_m = 0.001, .y_m = 0.0005};
  EXPECT_EQ(board.Corner(0, warp), board.Corner(0));
  EXPECT_EQ(board.Corner(34, warp), board.Corner(34));
  EXPECT_NEAR(board.Corner(17, warp).z(), 0.0015, 1e-15);
  EXPECT_NEAR(board.Corner(3, warp).z(), 0.001, 1e-15);
}

TEST(CalibrationBoard, MarkersNumberTheWhiteSquaresRowByRow) {
  for (const auto& [columns, rows] : {std::pair(7, 6), std::pair(6, 5), std::pair(6, 6)}) {
    const CalibrationBoard board{
        .kind = CalibrationBoard::Kind::kCharuco, .columns = columns, .rows = rows};
    int next = 0;
    for (int row = 0; row <= rows; ++row)
      for (int column = 0; column <= columns; ++column)
        EXPECT_EQ(board.MarkerAt(column, row),
                  CalibrationBoard::IsBlack(column, row) ? -1 : next++);
    EXPECT_EQ(board.MarkerCount(), next);
  }
}

TEST(CalibrationBoard, LooksTheSameUpsideDownWhereBothCountsAreEvenOrBothOdd) {
  EXPECT_TRUE((CalibrationBoard{.columns = 8, .rows = 6}).LooksSameUpsideDown());
  EXPECT_TRUE((CalibrationBoard{.columns = 7, .rows = 5}).LooksSameUpsideDown());
  EXPECT_FALSE((CalibrationBoard{.columns = 7, .rows = 6}).LooksSameUpsideDown());
  EXPECT_FALSE((CalibrationBoard{.kind = CalibrationBoard::Kind::kCharuco, .columns = 8, .rows = 6})
                   .LooksSameUpsideDown());
}

TEST(CalibrationBoard, SurvivesItsText) {
  for (const double square_m : {0.05, 0.0325, 1.0 / 30.0, 0.1 + 0.2}) {
    const CalibrationBoard checkerboard{.columns = 7, .rows = 6, .square_m = square_m};
    EXPECT_EQ(CalibrationBoardFromText(ToText(checkerboard)).value(), checkerboard);
    const CalibrationBoard charuco{.kind = CalibrationBoard::Kind::kCharuco,
                                   .columns = 7,
                                   .rows = 6,
                                   .square_m = square_m,
                                   .marker_per_square = 0.75,
                                   .dictionary = CalibrationBoard::Dictionary::k4x4_50};
    CalibrationBoard again = CalibrationBoardFromText(ToText(charuco)).value();
    EXPECT_NEAR(again.marker_per_square, 0.75, 1e-9);
    again.marker_per_square = charuco.marker_per_square;
    EXPECT_EQ(again, charuco);
  }
  EXPECT_EQ(ToText({.columns = 7, .rows = 6, .square_m = 0.05}), "checkerboard:7x6:50");
  EXPECT_EQ(ToText(CalibrationBoardFromText("charuco:7x6:50").value()),
            "charuco:7x6:50:37.5:5x5_250");
}

TEST(CalibrationBoard, SaysWhatIsWrongWithAText) {
  const std::vector<std::pair<std::string, std::string>> texts = {
      {"", "no kind of board"},
      {"chess:7x6:50", "'chess' is no kind of board"},
      {"checkerboard", "1 parts between colons"},
      {"checkerboard:7x6", "2 parts"},
      {"checkerboard:7x6:50:30", "4 parts"},
      {"checkerboard:76:50", "'76' is not COLUMNSxROWS"},
      {"checkerboard:7x6x5:50", "'7x6x5' is not"},
      {"checkerboard:7x6.5:50", "'7x6.5' is not"},
      {"checkerboard:7x6:50mm", "'50mm' is not a number"},
      {"checkerboard:7x6:nan", "not between"},
      {"checkerboard:7x6:-50", "not between"},
      {"checkerboard:2x6:50", "2 columns"},
      {"checkerboard:7x600:50", "600 rows"},
      {"charuco:7x6:50:60", "side of a marker 60 mm"},
      {"charuco:7x6:50:x", "'x' is not a number"},
      {"charuco:7x6:50:40:7x7", "dictionary '7x7' is not known"},
      {"charuco:20x20:50:40:4x4_50", "220 markers are needed, but dictionary 4x4_50 has 50"}};
  for (const auto& [text, fault] : texts) {
    const auto board = CalibrationBoardFromText(text);
    ASSERT_FALSE(board) << text;
    EXPECT_THAT(board.error().message, HasSubstr(fault)) << text;
    EXPECT_THAT(board.error().message, HasSubstr("'" + text + "'"));
  }
}

TEST(BoardView, NamesTheCornerAtFault) {
  const CalibrationBoard board{.columns = 7, .rows = 6};
  const auto fault = [&board](const BoardView& view) {
    const Status status = view.Check(board);
    return status ? std::string() : status.error().message;
  };
  const Eigen::Vector2d pixel(3.0, 4.0);
  EXPECT_EQ(fault({{0, 41}, {pixel, pixel}}), "");
  EXPECT_THAT(fault({{0, 41}, {pixel}}), HasSubstr("2 corners have 1 pixels"));
  EXPECT_THAT(fault({{42}, {pixel}}), HasSubstr("corner 42 is not one of 42"));
  EXPECT_THAT(fault({{5, 5}, {pixel, pixel}}), HasSubstr("corner 5 occurs twice"));
  EXPECT_THAT(fault({{5}, {pixel / 0.0}}), HasSubstr("corner 5 has no finite pixel"));
}

}  // namespace
}  // namespace foresight
