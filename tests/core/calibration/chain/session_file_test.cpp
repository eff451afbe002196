// A session on disk: what is written is read again, and what is wrong is named.
#include "core/calibration/session_file.h"

#include <gmock/gmock.h>

#include "core/base/atomic_file.h"
#include "core/evaluation/calibration_images.h"
#include "core/evaluation/simulate_calibration.h"
#include "core/io/png.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using ::testing::HasSubstr;

CalibrationSession SmallSession() {
  CalibrationSimulation options;
  options.intrinsic_views = 2;
  options.poses = 2;
  options.scans_per_stop = 2;
  options.sweeps = 1;
  options.stop_step_deg = 20.0;
  options.first_stop_deg = -20.0;
  return SimulateCalibration(options)->session;
}

class SessionFile : public ::testing::Test {
 protected:
  SessionFile() {
    const Status status = WriteCalibrationSession(session_, path_);
    EXPECT_TRUE(status) << status.error().message;
  }
  std::string Text(const std::string& file) const { return *ReadFile(path_ / file); }
  void Replace(const std::string& file, const std::string& what, const std::string& with) {
    std::string text = Text(file);
    const std::size_t at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), with);
    ASSERT_TRUE(WriteFileAtomically(path_ / file, text));
  }
  std::string Message() const {
    const auto read = ReadCalibrationSession(path_, {});
    return read ? "read" : read.error().message;
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "session";
  CalibrationSession session_ = SmallSession();
};

TEST_F(SessionFile, IsReadAsItWasWritten) {
  const auto read = ReadCalibrationSession(path_, {});
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->name, session_.name);
  EXPECT_EQ(read->mount.a, session_.mount.a);
  EXPECT_EQ(read->prior.camera, session_.prior.camera);
  ASSERT_EQ(read->intrinsic_views.size(), session_.intrinsic_views.size());
  EXPECT_EQ(read->intrinsic_views[1].view.pixels, session_.intrinsic_views[1].view.pixels);
  ASSERT_EQ(read->poses.size(), session_.poses.size());
  for (std::size_t pose = 0; pose < read->poses.size(); ++pose) {
    const PatternPose &a = read->poses[pose], &b = session_.poses[pose];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.sweep.lines, b.sweep.lines);
    EXPECT_EQ(a.sweep.track, b.sweep.track);
    ASSERT_EQ(a.stops.size(), b.stops.size());
    for (std::size_t stop = 0; stop < a.stops.size(); ++stop) {
      // Degrees and back: the last digit.
      EXPECT_NEAR(a.stops[stop].motor_rad, b.stops[stop].motor_rad, 1e-12);
      EXPECT_EQ(a.stops[stop].lines, b.stops[stop].lines);
      ASSERT_EQ(a.stops[stop].view.a.has_value(), b.stops[stop].view.a.has_value());
      if (a.stops[stop].view.a) {
        EXPECT_EQ(a.stops[stop].view.a->pixels, b.stops[stop].view.a->pixels);
        EXPECT_EQ(a.stops[stop].view.a->corner_ids, b.stops[stop].view.a->corner_ids);
      }
    }
  }
}

TEST_F(SessionFile, IsNotWrittenOverAnother) {
  const Status status = WriteCalibrationSession(session_, path_);
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, HasSubstr("not empty"));
}

TEST_F(SessionFile, NamesTheLineOfAKeyThatIsNotKnown) {
  Replace("session.yaml", "poses:", "pauses:");
  EXPECT_THAT(Message(), HasSubstr("session.yaml:"));
  EXPECT_THAT(Message(), HasSubstr("pauses"));
}

TEST_F(SessionFile, NamesTheRowOfAValueThatIsNoNumber) {
  Replace("intrinsic/001.csv", "a,3,", "a,3x,");
  EXPECT_THAT(Message(), HasSubstr("intrinsic/001.csv:5: '3x' in column corner is not a number"));
}

TEST_F(SessionFile, RefusesACornerThatTheBoardDoesNotHave) {
  Replace("intrinsic/001.csv", "a,47,", "a,48,");
  EXPECT_THAT(Message(), HasSubstr("intrinsic/001.csv"));
}

TEST_F(SessionFile, RefusesALineOfAnotherLidar) {
  const std::string file = "pose_02/sweep_lines.csv";
  std::string text = Text(file);
  text.erase(text.rfind(','), std::string::npos);
  ASSERT_TRUE(WriteFileAtomically(path_ / file, text));
  EXPECT_THAT(Message(), HasSubstr("1080 ranges, the rig's lidar has 1081 beams"));
}

TEST_F(SessionFile, RefusesFilesOutsideOfItsFolder) {
  Replace("session.yaml", "rig: rig.yaml", "rig: ../rig.yaml");
  EXPECT_THAT(Message(), HasSubstr("not a file in the session's folder"));
}

TEST_F(SessionFile, NamesAFileThatIsMissing) {
  std::filesystem::remove(path_ / "pose_02/sweep_motor.csv");
  EXPECT_THAT(Message(), HasSubstr("pose_02/sweep_motor.csv"));
}

TEST_F(SessionFile, RefusesAnImageOfAnotherCamera) {
  ASSERT_TRUE(WritePng(path_ / "small.png", GrayImage(64, 48, 128)));
  Replace("session.yaml", "corners: intrinsic/001.csv", "image: small.png");
  EXPECT_THAT(Message(), HasSubstr("64 x 48 pixels, the rig's camera has 1288 x 964"));
}

TEST_F(SessionFile, RefusesAnotherVersion) {
  Replace("session.yaml", "foresight_calibration_session: 1", "foresight_calibration_session: 2");
  EXPECT_THAT(Message(), HasSubstr("version 2"));
}

TEST(SessionFileImages, ABoardThatIsNotUsedIsNotTheWholeImage) {
  CalibrationSimulation options;
  options.intrinsic_views = 2;
  options.poses = 2;
  options.stop_step_deg = 20.0;
  options.distinct_boards = true;
  const CalibrationSession session = SimulateCalibration(options)->session;
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "session";
  ASSERT_TRUE(WriteCalibrationSession(session, path));
  const BoardMount& mount = session.mount;
  const Eigen::Vector3d hinge(0.05, 0.0, 1.1);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(-0.8, Eigen::Vector3d::UnitY()));
  const Eigen::Vector3d hinge_in_a((mount.a.columns - 1) * mount.a.square_m + kHinge_m, 0.125, 0.0);
  const Rigid<frame::Camera, frame::Pattern> camera_from_a(turn, hinge - turn * hinge_in_a);
  const CameraModel& camera = session.prior.camera;
  GrayImage image = BoardPainter(camera).Paint(
      {{mount.a, camera_from_a}, {*mount.b, camera_from_a * mount.a_from_b}}, 1.0, 1);
  for (int y = 0; y < image.height(); ++y)
    for (int x = static_cast<int>(camera.Project(hinge)->x()); x < image.width(); ++x)
      image(x, y) = static_cast<std::uint8_t>(std::min(255, 130 + image(x, y)));
  ASSERT_TRUE(WritePng(path / "bright_b.png", image));
  std::string index = *ReadFile(path / "session.yaml");
  const std::size_t poses = index.find("poses:"), at = index.find("corners: ", poses);
  ASSERT_NE(at, std::string::npos);
  index.replace(at, index.find_first_of(",}\n", at) - at, "image: bright_b.png");
  ASSERT_TRUE(WriteFileAtomically(path / "session.yaml", index));
  const auto read = ReadCalibrationSession(path, {});
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_THAT(read->unusable_images,
              testing::ElementsAre(testing::StartsWith("board B of bright_b.png: overexposed")));
}

}  // namespace
}  // namespace foresight
