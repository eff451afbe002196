// Calibration boards in a scene: where their corners are, what camera and lidar see of them, and
// the stand that is moved.
#include "core/simulation/board_stand.h"

#include <gmock/gmock.h>

#include "core/calibration/board_detector.h"
#include "core/depth/upsample.h"
#include "core/geometry/angles.h"
#include "tests/core/simulation/small_world.h"
#include "tests/support/small_camera.h"

namespace foresight {
namespace {

using test::Noiseless;
using test::SceneOf;
using test::Still;
using ::testing::HasSubstr;

constexpr const char* kPaper =
    "ambient: 0.8\n"
    "materials: {paper: {color: [0.9, 0.9, 0.9], color2: [0.03, 0.03, 0.03]},"
    " mirror: {specular: 1}, wall: {color: [0.4, 0.4, 0.4]}}\n";

const CalibrationBoard kBoard{.columns = 7, .rows = 6, .square_m = 0.05};

/// The distances, in pixels, of detected corners from where the scene's first board has them.
std::vector<double> CornerErrors(const std::string& object,
                                 const SensorRig& head = SmallCameraRig()) {
  const auto scene = SceneOf(kPaper + object);
  WorldOptions options = Noiseless();
  // A pixel half black and half white is 186 with a gamma of 2.2, and the detector, which takes
  // grey for a fraction, is off by 0.06 px rms more.
  options.camera.gamma = 1.0;
  const World world(scene, head, options);
  const CameraFrame frame = world.CaptureImage(0, 1.0, 0.004, 0.0, Still, {});
  const BoardTruth& truth = scene->boards.at(0);
  const BoardDetection found = DetectBoard(ToGray(frame.image), truth.board);
  EXPECT_EQ(found.rejection, "");
  const SensorRig& rig = world.true_rig();
  const auto camera_from_pattern =
      rig.CameraFromBase(0.0) * rig.robot_from_base.Inverse() * truth.robot_from_pattern;
  std::vector<double> errors;
  for (std::size_t i = 0; i < found.view.corner_ids.size(); ++i) {
    const Eigen::Vector3d corner =
        truth.corners[static_cast<std::size_t>(found.view.corner_ids[i])];
    const auto pixel = rig.camera.Project(camera_from_pattern * corner);
    errors.push_back((found.view.pixels[i] - *pixel).norm());
  }
  return errors;
}

double Rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// 18 px a square. The detector is good to 0.04 px rms in an image without blur and noise; a corner
// that were half a sub-pixel off would be 0.06 px off.
TEST(BoardInAScene, CornersAreFoundWhereTheyAre) {
  const auto errors = CornerErrors(
      "objects: [{kind: stand, a: 'checkerboard:7x6:50', material: paper,"
      " position_m: [0.55, 0.03, 1.42], rpy_deg: [11, 7, 13]}]");
  EXPECT_EQ(errors.size(), 42u);
  EXPECT_LT(Rms(errors), 0.05);
  EXPECT_LT(*std::max_element(errors.begin(), errors.end()), 0.10);
}

constexpr const char* kNearCharuco =
    "objects: [{kind: stand, a: 'charuco:4x3:90:60:4x4_50', material: paper,"
    " position_m: [0.45, 0.0, 1.40], rpy_deg: [5, -8, 10]}]";

// Markers leave a window of 6 px.
TEST(BoardInAScene, AChArUcoBoardIsFoundWhereItIs) {
  const auto errors = CornerErrors(kNearCharuco);
  EXPECT_EQ(errors.size(), 12u);
  EXPECT_LT(Rms(errors), 0.10);
}

// 160 px a square: in a window that wide the edges bend, and corners were up to 0.75 px off.
TEST(BoardInAScene, ANearChArUcoBoardIsFoundWhereItIs) {
  const auto errors = CornerErrors(kNearCharuco, DefaultSensorRig());
  EXPECT_EQ(errors.size(), 12u);
  EXPECT_LT(Rms(errors), 0.08);
}

TEST(BoardInAScene, PrintErrorsAndWarpMoveTheCorners) {
  const std::string object =
      "objects: [{kind: stand, a: 'checkerboard:7x6:50', material: paper, position_m: [0.5, 0, "
      "1.4], rpy_deg: [4, 20, 25], a_print: {scale: [1.02, 0.99], corner_jitter_mm: 0.2, seed: 3, "
      "warp_mm: [6, -4]}}]";
  EXPECT_LT(Rms(CornerErrors(object)), 0.08);  // edges bend at corners that jitter
  const auto scene = SceneOf(kPaper + object);
  const BoardTruth& truth = scene->boards.at(0);
  const Eigen::Vector3d drawn = kBoard.Corner(24, {0.006, -0.004});
  // 150 mm from corner 0: 3 mm by the scale, and its own jitter.
  EXPECT_NEAR(truth.corners[24].x(), 1.02 * drawn.x(), 0.002);
  EXPECT_NEAR(truth.corners[24].z(), drawn.z(), 1e-4);  // the jitter along the bend
  EXPECT_NE(truth.corners[24].x(), 1.02 * drawn.x());
}

TEST(BoardInAScene, ShowsNothingFromBehind) {
  const auto scene = SceneOf(
      std::string(kPaper) +
      "objects: [{kind: stand, a: 'checkerboard:7x6:50', material: paper, position_m: [0.5, 0, "
      "1.4], rpy_deg: [0, 0, 180]}]");
  const World world(scene, SmallCameraRig(), Noiseless());
  const GrayImage image = ToGray(world.CaptureImage(0, 1.0, 0.004, 0.0, Still, {}).image);
  EXPECT_NE(DetectBoard(image, kBoard, SearchEffort::kQuick).rejection, "");
  EXPECT_EQ(image(150, 115), image(165, 125)) << "plain paper";
}

TEST(BoardInAScene, TheHingedMountFacesTheRobotWithBothBoards) {
  const auto scene = SceneOf(
      std::string(kPaper) +
      "objects: [{kind: stand, a: 'checkerboard:9x6:50', b: 'checkerboard:7x6:50', material: "
      "paper, position_m: [1.2, 0.1, 1.3]}]");
  ASSERT_EQ(scene->boards.size(), 2u);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const BoardTruth& board : scene->boards) {
    const Eigen::Vector3d into = board.robot_from_pattern.Rotate(Eigen::Vector3d::UnitZ());
    EXPECT_NEAR(into.x(), std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(into.z(), 0.0, 1e-6);
    EXPECT_NEAR(board.robot_from_pattern.Rotate(Eigen::Vector3d::UnitY()).z(), -1.0, 1e-6);
    const Eigen::Vector3d last = board.corners.back();
    middle +=
        0.25 * (board.robot_from_pattern * board.corners.front() + board.robot_from_pattern * last);
  }
  EXPECT_LT((middle - Eigen::Vector3d(1.2, 0.1, 1.3)).norm(), 1e-6);
}

constexpr const char* kStands =
    "solids: [{shape: box, size_m: [0.1, 8, 8], position_m: [3.05, 0, 1.4], material: wall}]\n"
    "stands: [{name: board, a: 'checkerboard:7x6:100', material: paper}]\n"
    "places: [{stand: board, position_m: [1.1, 0, 1.4]}, {stand: board, position_m: [2.1, 0, "
    "1.4]}]\n";

TEST(Stand, GoesWhereItIsMovedForLidarAndCamera) {
  const World world(SceneOf(std::string(kPaper) + kStands), SmallCameraRig(), Noiseless());
  const auto ahead_m = [&] { return world.MeasureLine(0, 0.0, Still).RawRange(540); };
  const double lidar_x = test::BeamOf(world.true_rig(), 540, 0.0).origin.x();
  EXPECT_EQ(world.StandAt(), 1);
  EXPECT_NEAR(ahead_m(), 1.1 - lidar_x, 0.002);  // whole millimetres
  const World copy = world;
  ASSERT_TRUE(world.MoveStand(2));
  EXPECT_NEAR(ahead_m(), 2.1 - lidar_x, 0.002);
  EXPECT_EQ(copy.StandAt(), 2);
  ASSERT_TRUE(world.MoveStand(0));
  EXPECT_NEAR(ahead_m(), 3.0 - lidar_x, 0.002);
  EXPECT_NEAR(world.TrueDepth(0.0, {})(161, 120), ahead_m(), 0.05);  // camera before the lidar
  const Status nowhere = world.MoveStand(3);
  ASSERT_FALSE(nowhere);
  EXPECT_THAT(nowhere.error().message, HasSubstr("no place 3; it has 2"));
}

TEST(Stand, AMirrorBoardSendsTheLidarBackOnlySquareOn) {
  const auto returned = [](const char* rpy) {
    WorldOptions options = Noiseless();
    options.lidar.enabled = true;
    options.lidar.spurious_fraction = 0.0;
    const World world(SceneOf(std::string(kPaper) +
                              "objects: [{kind: stand, a: "
                              "'checkerboard:7x6:50', material: mirror, "
                              "position_m: [1.1, 0, 1.4], rpy_deg: " +
                              rpy + "}]"),
                      SmallCameraRig(), options);
    return std::isfinite(world.MeasureLine(0, 0.0, Still).RawRange(540));
  };
  EXPECT_TRUE(returned("[0, 0, 0]"));
  EXPECT_FALSE(returned("[0, 0, 30]"));
}

TEST(Stand, NamesWhatIsWrongInASceneFile) {
  const auto fault = [](const std::string& body) {
    const auto scene =
        SceneFromYaml("foresight_scene: 1\nname: x\n" + (kPaper + body), "test.yaml");
    return scene ? "read" : scene.error().message;
  };
  EXPECT_THAT(fault("stands: [{a: 'checkerboard:2x6:50', material: paper}]"),
              HasSubstr("test.yaml:5: board"));
  EXPECT_THAT(fault("places: [{stand: nobody, position_m: [1, 0, 1]}]"),
              HasSubstr("'nobody' is not among the stands"));
  EXPECT_THAT(fault("stands: [{a: 'checkerboard:7x6:50', material: paper, a_print: {scale: [2, "
                    "1]}}]"),
              HasSubstr("scale: (2, 1) is not within"));
  EXPECT_THAT(fault("stands: [{a: 'checkerboard:7x6:50', material: paper, a_print: {size: 2}}]"),
              HasSubstr("size"));
}

}  // namespace
}  // namespace foresight
