// Two checkerboards of one stand in an image: which is which, and what is only a part of one.
#include "core/calibration/mount_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/evaluation/calibration_images.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using CameraFromBoard = Rigid<frame::Camera, frame::Pattern>;

const CalibrationBoard kA{.columns = 9, .rows = 6, .square_m = 0.05};
const CalibrationBoard kB{.columns = 7, .rows = 6, .square_m = 0.05};

CameraModel Fisheye() {
  return {.width = 966,
          .height = 723,
          .fx = 451.0,
          .fy = 451.0,
          .cx = 482.0,
          .cy = 361.0,
          .lens = FisheyeLens{0.9413}};
}

/// A stand whose hinge's middle is at a place, `turn` about the hinge and `roll` about the way to
/// the camera.
struct Stand {
  CalibrationBoard a;
  BoardMount mount = HingedMount(a, kB, kHinge_m);
  CameraFromBoard camera_from_a;

  Stand(const Eigen::Vector3d& hinge, double turn_rad, double roll_rad,
        const CalibrationBoard& board_a = kA)
      : a(board_a) {
    const Eigen::Quaterniond rotation =
        Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()) *
        Eigen::Quaterniond(Eigen::AngleAxisd(-turn_rad, Eigen::Vector3d::UnitY()));
    const Eigen::Vector3d hinge_in_a((a.columns - 1) * a.square_m + kHinge_m, 0.125, 0.0);
    camera_from_a = {rotation, hinge - rotation * hinge_in_a};
  }
  CameraFromBoard CameraFromB() const { return camera_from_a * mount.a_from_b; }
  GrayImage Image(std::vector<BoardPainter::PlacedBoard> more = {}) const {
    more.push_back({a, camera_from_a});
    more.push_back({kB, CameraFromB()});
    return BoardPainter(Fisheye()).Paint(more, 1.0, 1);
  }
};

/// Farthest corner from where it is; -1 = not found.
double WorstOf(const std::optional<BoardView>& view, const CalibrationBoard& board,
               const CameraFromBoard& pose) {
  if (!view) return -1.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < view->corner_ids.size(); ++i)
    worst = std::max(
        worst,
        (*Fisheye().Project(pose * board.Corner(view->corner_ids[i])) - view->pixels[i]).norm());
  return worst;
}

void Cover(GrayImage* image, int left, int right, std::uint8_t grey) {
  for (int v = 0; v < image->height(); ++v)
    for (int u = std::max(0, left); u < std::min(right, image->width()); ++u) (*image)(u, v) = grey;
}

int ColumnOf(const Stand& stand, double column) {
  const auto pixel =
      Fisheye().Project(stand.camera_from_a * Eigen::Vector3d(column * kA.square_m, 0.125, 0.0));
  return static_cast<int>(std::lround(pixel->x()));
}

// Squares are 8 px and wider; a grid that is one square off would be farther off than this.
constexpr double kRight_px = 1.0;

TEST(MountDetector, FindsBothBoardsWhereverTheyMeet) {
  for (const double roll : {0.0, 0.8, 1.57, 3.1})
    for (const double turn : {0.5, 0.8, 1.05}) {  // the larger, how far A is turned away
      SCOPED_TRACE(testing::Message() << "roll " << roll << ", turn " << turn);
      const Stand stand({0.05, 0.0, 1.1}, turn, roll);
      const MountView view = DetectMount(stand.Image(), stand.mount, Fisheye());
      EXPECT_GE(WorstOf(view.a, kA, stand.camera_from_a), 0.0) << "A was not found";
      EXPECT_GE(WorstOf(view.b, kB, stand.CameraFromB()), 0.0) << "B was not found";
      EXPECT_LT(WorstOf(view.a, kA, stand.camera_from_a), kRight_px);
      EXPECT_LT(WorstOf(view.b, kB, stand.CameraFromB()), kRight_px);
    }
}

TEST(MountDetector, TakesNoPartOfTheLargerBoardForTheSmallerOne) {
  const Stand stand({0.05, 0.0, 1.1}, 0.5, 0.0);
  const BoardMount mount = stand.mount;
  const auto only_a = [&] {
    return BoardPainter(Fisheye()).Paint({{kA, stand.camera_from_a}}, 1.0, 1);
  };
  // Of nine columns of corners two are hidden, and parts of the squares beside them.
  for (const double column : {1.2, 1.5, 1.8})
    for (const int grey : {10, 110, 220}) {
      SCOPED_TRACE(testing::Message() << "column " << column << ", grey " << grey);
      GrayImage image = only_a();
      Cover(&image, 0, ColumnOf(stand, column), static_cast<std::uint8_t>(grey));
      const MountView view = DetectMount(image, mount, Fisheye());
      EXPECT_FALSE(view.a);
      EXPECT_FALSE(view.b);
    }
}

TEST(MountDetector, FindsTheSmallerBoardBesideAPartOfTheLargerOne) {
  const Stand stand({0.05, 0.0, 1.1}, 0.5, 0.0);
  GrayImage image = stand.Image();
  Cover(&image, 0, ColumnOf(stand, 1.5), 110);
  const MountView view = DetectMount(image, stand.mount, Fisheye());
  EXPECT_FALSE(view.a);
  EXPECT_GE(WorstOf(view.b, kB, stand.CameraFromB()), 0.0);
  EXPECT_LT(WorstOf(view.b, kB, stand.CameraFromB()), kRight_px);
}

TEST(MountDetector, FindsTheSmallerBoardAloneByItsMargin) {
  const Stand stand({0.05, 0.0, 1.1}, 0.8, 0.0);
  const GrayImage image = BoardPainter(Fisheye()).Paint({{kB, stand.CameraFromB()}}, 1.0, 1);
  const MountView view = DetectMount(image, stand.mount, Fisheye());
  EXPECT_FALSE(view.a);
  EXPECT_GE(WorstOf(view.b, kB, stand.CameraFromB()), 0.0);
  EXPECT_LT(WorstOf(view.b, kB, stand.CameraFromB()), kRight_px);
}

TEST(MountDetector, PrefersTheBoardThatStandsAsDrawn) {
  const Stand stand({0.25, 0.0, 1.2}, 0.8, 0.0);
  const CameraFromBoard elsewhere(
      Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX())),
      Eigen::Vector3d(-0.80, -0.2, 1.0));
  const MountView view = DetectMount(stand.Image({{kA, elsewhere}}), stand.mount, Fisheye());
  EXPECT_GE(WorstOf(view.a, kA, stand.camera_from_a), 0.0);
  EXPECT_LT(WorstOf(view.a, kA, stand.camera_from_a), kRight_px);
  EXPECT_GE(WorstOf(view.b, kB, stand.CameraFromB()), 0.0);
  EXPECT_LT(WorstOf(view.b, kB, stand.CameraFromB()), kRight_px);
}

// What is beside the board that is alone must be of the other one, or the board is taken for
// another.
TEST(MountDetector, TakesNoBoardAloneWhereAGridLiesBesideTheOtherOne) {
  const CalibrationBoard small{.columns = 5, .rows = 4, .square_m = 0.05};
  const Stand stand({0.05, 0.0, 1.1}, 0.8, 0.0);
  const CameraFromBoard below(Eigen::Quaterniond::Identity(), Eigen::Vector3d(-0.6, 0.35, 1.1));
  const GrayImage image =
      BoardPainter(Fisheye()).Paint({{kB, stand.CameraFromB()}, {small, below}}, 1.0, 1);
  EXPECT_TRUE(DetectMount(image, stand.mount, Fisheye()).empty());
}

// Turned upside down, such a stand looks as before.
TEST(MountDetector, DoesNotGuessBetweenTwoEqualBoards) {
  const CalibrationBoard equal{.columns = 8, .rows = 6, .square_m = 0.05};
  const Stand stand({0.05, 0.0, 1.1}, 0.8, 0.0);
  const GrayImage image = BoardPainter(Fisheye()).Paint(
      {{equal, stand.camera_from_a}, {equal, stand.CameraFromB()}}, 1.0, 1);
  EXPECT_TRUE(DetectMount(image, HingedMount(equal, equal, kHinge_m), Fisheye()).empty());
}

// Turned round its own middle the board of the paper looks as before; the other one tells.
TEST(MountDetector, FindsTheUpperSideOfASymmetricBoardByTheOtherOne) {
  const CalibrationBoard symmetric{.columns = 8, .rows = 6, .square_m = 0.05};
  for (const double roll : {0.0, 0.8, 1.57, 2.4, 3.1, -0.8, -1.57}) {
    SCOPED_TRACE(testing::Message() << "roll " << roll);
    const Stand stand({0.05, 0.0, 1.1}, 0.8, roll, symmetric);
    const MountView view = DetectMount(stand.Image(), stand.mount, Fisheye());
    EXPECT_GE(WorstOf(view.a, symmetric, stand.camera_from_a), 0.0) << "A was not found";
    EXPECT_LT(WorstOf(view.a, symmetric, stand.camera_from_a), kRight_px);
    EXPECT_GE(WorstOf(view.b, kB, stand.CameraFromB()), 0.0) << "B was not found";
    EXPECT_LT(WorstOf(view.b, kB, stand.CameraFromB()), kRight_px);
  }
}

TEST(MountDetector, TakesNoSymmetricBoardAlone) {
  const CalibrationBoard symmetric{.columns = 8, .rows = 6, .square_m = 0.05};
  const Stand stand({0.05, 0.0, 1.1}, 0.8, 0.0, symmetric);
  const GrayImage image = BoardPainter(Fisheye()).Paint({{symmetric, stand.camera_from_a}}, 1.0, 1);
  EXPECT_TRUE(DetectMount(image, stand.mount, Fisheye()).empty());
}

TEST(MountDetector, SaysWhichMountsImagesCannotTell) {
  CalibrationBoard a{.columns = 8, .rows = 6, .square_m = 0.05};
  CalibrationBoard b = a;
  const auto told = [&] { return CheckInImages(HingedMount(a, b, kHinge_m)); };
  ASSERT_FALSE(told());
  EXPECT_THAT(told().error().message, HasSubstr("checkerboards of 8 x 6 inner corners"));
  b.columns = 7;
  EXPECT_TRUE(told()) << "the 7 x 6 board tells which way up the 8 x 6 board is";
  BoardMount alone;
  alone.a = a;
  ASSERT_FALSE(CheckInImages(alone)) << "nothing tells which way up the 8 x 6 board is";
  EXPECT_THAT(CheckInImages(alone).error().message, HasSubstr("one count odd and one even"));
  alone.a = b;
  EXPECT_TRUE(CheckInImages(alone));
  CalibrationBoard charuco = b;
  charuco.kind = CalibrationBoard::Kind::kCharuco;
  EXPECT_FALSE(CheckInImages(HingedMount(a, charuco, kHinge_m)));
  EXPECT_TRUE(CheckInImages(HingedMount(b, charuco, kHinge_m)));
  a = b;
  EXPECT_TRUE(told()) << "7 x 6 has an upper side";
  a.kind = b.kind = CalibrationBoard::Kind::kCharuco;
  ASSERT_FALSE(told());
  EXPECT_THAT(told().error().message, HasSubstr("dictionary 5x5_250"));
  b.dictionary = CalibrationBoard::Dictionary::k4x4_50;
  EXPECT_TRUE(told());
}

TEST(MountDetector, SaysWhyTheBoardBesideAGoodOneIsNotTaken) {
  const Stand stand({0.05, 0.0, 1.1}, 0.8, 0.0);
  GrayImage image = stand.Image();
  const int hinge = static_cast<int>(Fisheye().Project({0.05, 0.0, 1.1})->x());
  for (int y = 0; y < image.height(); ++y)
    for (int x = hinge; x < image.width(); ++x)
      image(x, y) = static_cast<std::uint8_t>(std::min(255, 130 + image(x, y)));
  const MountView view = DetectMount(image, stand.mount, Fisheye());
  EXPECT_TRUE(view.a);
  EXPECT_FALSE(view.b);
  EXPECT_THAT(view.fault, HasSubstr("overexposed"));
}

TEST(MountDetector, SaysThatAnImageIsOverexposedOrDark) {
  const Stand stand({0.05, 0.0, 1.1}, 0.8, 0.0);
  GrayImage image = stand.Image();
  EXPECT_EQ(DetectMount(image, stand.mount, Fisheye()).fault, "");
  GrayImage bright = image, dark = image;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      bright(x, y) = static_cast<std::uint8_t>(std::min(255, 150 + 3 * image(x, y)));
      dark(x, y) = static_cast<std::uint8_t>(image(x, y) / 16);
    }
  const MountView too_bright = DetectMount(bright, stand.mount, Fisheye());
  EXPECT_TRUE(too_bright.empty());
  EXPECT_THAT(too_bright.fault, HasSubstr("overexposed"));
  const MountView too_dark = DetectMount(dark, stand.mount, Fisheye());
  EXPECT_TRUE(too_dark.empty());
  EXPECT_NE(too_dark.fault, "");
}

}  // namespace
}  // namespace foresight
