// A session that is recorded step by step: what was captured is on the disk, whatever comes next.
#include "core/calibration/session_folder.h"

#include <gmock/gmock.h>

#include "core/base/atomic_file.h"
#include "core/calibration/session_file.h"
#include "core/geometry/angles.h"
#include "core/io/png.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/small_camera.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using ::testing::HasSubstr;
using Kind = SessionCapture::Kind;

class SessionFolderTest : public ::testing::Test {
 protected:
  SessionFolderTest() {
    setup_.name = "a \"stand\"";
    setup_.mount = UsualBoardMount();
    setup_.intrinsic_board = {.columns = 7, .rows = 6, .square_m = 0.03};
    setup_.prior = SmallCameraRig();
    setup_.prior.lidar.beams = 11;
  }

  SessionFolder Made() const {
    auto made = SessionFolder::Create(path_, setup_);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
  }
  ColorImage Image() const {
    return {setup_.prior.camera.width, setup_.prior.camera.height, Rgb8{90, 90, 90}};
  }
  static std::vector<LidarLine> Lines(int count) {
    std::vector<LidarLine> lines;
    for (int i = 0; i < count; ++i)
      lines.push_back({i, 0.025 * i, std::vector<std::uint16_t>(11, 1000), {}});
    return lines;
  }
  RecordedStop Stop(double deg) const {
    return {RadiansFromDegrees(deg), RadiansFromDegrees(deg + 0.01), Image(), Lines(3)};
  }
  static MountSweep Sweep(int lines) {
    return {Lines(lines), *MotorTrack::FromSamples({{0.0, 0.1}, {0.1, 0.2}})};
  }
  /// What a calibration would be given.
  CalibrationSession Read() const {
    const auto read = ReadCalibrationSession(path_, {});
    EXPECT_TRUE(read) << read.error().message;
    return read ? *read : CalibrationSession();
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "session";
  SessionSetup setup_;
};

TEST_F(SessionFolderTest, WhatWasRecordedIsWhatACalibrationReads) {
  SessionFolder folder = Made();
  ASSERT_TRUE(folder.AddPose("left"));
  ASSERT_TRUE(folder.AddStop(0, Stop(-10.0)));
  ASSERT_TRUE(folder.AddStop(0, Stop(0.0)));
  ASSERT_TRUE(folder.AddSweep(0, Sweep(5)));
  const CalibrationSession session = Read();
  EXPECT_EQ(session.name, setup_.name);
  EXPECT_EQ(session.prior.camera, setup_.prior.camera);
  ASSERT_EQ(session.poses.size(), 1u);
  EXPECT_EQ(session.poses[0].name, "left");
  ASSERT_EQ(session.poses[0].stops.size(), 2u);
  EXPECT_NEAR(session.poses[0].stops[0].motor_rad, RadiansFromDegrees(-10.0), 1e-12);
  EXPECT_EQ(session.poses[0].stops[1].lines, Lines(3));
  EXPECT_EQ(session.poses[0].sweep.lines, Lines(5));
  EXPECT_EQ(session.poses[0].sweep.track, Sweep(5).track);
}

TEST_F(SessionFolderTest, GoesOnAfterItWasClosed) {
  {
    SessionFolder folder = Made();
    ASSERT_TRUE(folder.AddIntrinsicImage(Image(), "head: \"x\"\n\xff.png"));
    ASSERT_TRUE(folder.AddPose());
    ASSERT_TRUE(folder.AddStop(0, Stop(20.0)));
  }
  auto folder = SessionFolder::Open(path_);
  ASSERT_TRUE(folder) << folder.error().message;
  ASSERT_EQ(folder->Index().intrinsic_views.size(), 1u);
  EXPECT_THAT(folder->Index().intrinsic_views[0].origin, HasSubstr("head: \"x\""));
  ASSERT_TRUE(folder->Index().poses[0].stops[0].measured_rad);
  EXPECT_NEAR(*folder->Index().poses[0].stops[0].measured_rad, RadiansFromDegrees(20.01), 1e-12);
  const auto next = folder->AddStop(0, Stop(30.0));
  ASSERT_TRUE(next) << next.error().message;
  EXPECT_EQ(*next, (SessionCapture{Kind::kStop, 0, 1}));
  EXPECT_EQ(Read().poses[0].stops.size(), 2u);
}

TEST_F(SessionFolderTest, FilesThatASessionDoesNotNameYetAreNotWrittenOver) {
  SessionFolder folder = Made();
  ASSERT_TRUE(folder.AddIntrinsicImage(Image(), "a"));
  ASSERT_TRUE(WriteFileAtomically(path_ / "intrinsic/002.png", "cut off here"));
  const auto added = folder.AddIntrinsicImage(Image(), "b");
  ASSERT_TRUE(added);
  EXPECT_EQ(folder.Index().intrinsic_views[1].image, "intrinsic/003.png");
  EXPECT_EQ(*ReadFile(path_ / "intrinsic/002.png"), "cut off here");
}

TEST_F(SessionFolderTest, IsMadeWhereAProgramWasEndedBeforeItWasMade) {
  std::filesystem::create_directories(path_);
  ASSERT_TRUE(WriteFileAtomically(path_ / "rig.yaml", "x"));
  EXPECT_TRUE(SessionFolder::Create(path_, setup_));
  const auto again = SessionFolder::Create(path_, setup_);
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().message, HasSubstr("not empty"));
}

TEST_F(SessionFolderTest, AStopThatIsCapturedAgainReplacesTheFirstUntilThatIsUndone) {
  SessionFolder folder = Made();
  ASSERT_TRUE(folder.AddPose());
  const auto first = folder.AddStop(0, Stop(10.0));
  RecordedStop again = Stop(10.0);
  again.lines = Lines(7);
  const auto second = folder.AddStop(0, again);
  ASSERT_TRUE(first && second);
  ASSERT_EQ(Read().poses[0].stops.size(), 1u);
  EXPECT_EQ(Read().poses[0].stops[0].lines.size(), 7u);
  ASSERT_TRUE(folder.SetExcluded(*first, false));
  EXPECT_FALSE(folder.Used(*second));
  ASSERT_EQ(Read().poses[0].stops.size(), 1u);
  EXPECT_EQ(Read().poses[0].stops[0].lines.size(), 3u);
}

TEST_F(SessionFolderTest, AFurtherSweepReplacesTheFirstUntilThatIsUndone) {
  SessionFolder folder = Made();
  ASSERT_TRUE(folder.AddPose());
  const auto first = folder.AddSweep(0, Sweep(4));
  ASSERT_TRUE(first && folder.AddSweep(0, Sweep(6)));
  EXPECT_EQ(Read().poses[0].sweep.lines.size(), 6u);
  ASSERT_TRUE(folder.SetExcluded(*first, false));
  EXPECT_EQ(Read().poses[0].sweep.lines.size(), 4u);
}

TEST_F(SessionFolderTest, WhatIsExcludedTakesNoPartAndComesBack) {
  SessionFolder folder = Made();
  ASSERT_TRUE(folder.AddPose());
  ASSERT_TRUE(folder.AddStop(0, Stop(0.0)));
  const SessionCapture lines{Kind::kStopLines, 0, 0}, pose{Kind::kPose, 0, -1};
  ASSERT_TRUE(folder.SetExcluded(lines, true));
  EXPECT_FALSE(folder.Used(lines));
  EXPECT_TRUE(folder.Used({Kind::kStopImage, 0, 0}));
  EXPECT_TRUE(Read().poses[0].stops[0].lines.empty());
  ASSERT_TRUE(folder.SetExcluded(lines, false));
  EXPECT_EQ(Read().poses[0].stops[0].lines.size(), 3u);
  ASSERT_TRUE(folder.SetExcluded(pose, true));
  EXPECT_FALSE(folder.Used(lines));
  EXPECT_TRUE(Read().poses.empty());
  ASSERT_TRUE(folder.SetExcluded(pose, false));
  EXPECT_EQ(*ReadSessionIndex(path_), folder.Index());
}

TEST_F(SessionFolderTest, AFullDiskChangesNothing) {
  SessionFolder folder = Made();
  ASSERT_TRUE(folder.AddPose());
  ASSERT_TRUE(folder.AddStop(0, Stop(0.0)));
  const SessionIndex before = folder.Index();
  {
    const FileSizeLimit limit(300);  // less than the lines of a stop, and than session.yaml
    EXPECT_FALSE(folder.AddStop(0, Stop(10.0)));
    EXPECT_FALSE(folder.SetExcluded({Kind::kStop, 0, 0}, true));
  }
  EXPECT_EQ(folder.Index(), before);
  EXPECT_EQ(*ReadSessionIndex(path_), before);
  EXPECT_TRUE(folder.AddStop(0, Stop(10.0)));
}

TEST_F(SessionFolderTest, RefusesWhatACalibrationCouldNotRead) {
  SessionFolder folder = Made();
  ASSERT_TRUE(folder.AddPose());
  const auto small = folder.AddIntrinsicImage(ColorImage(64, 48, Rgb8{}), "small");
  ASSERT_FALSE(small);
  EXPECT_THAT(small.error().message, HasSubstr("small: 64 x 48 pixels"));
  const auto damaged = folder.AddIntrinsicFile("not an image", "odd.png");
  ASSERT_FALSE(damaged);
  EXPECT_THAT(damaged.error().message, HasSubstr("odd.png"));
  RecordedStop stop = Stop(0.0);
  stop.lines[1].range_mm.pop_back();
  const auto short_line = folder.AddStop(0, stop);
  ASSERT_FALSE(short_line);
  EXPECT_THAT(short_line.error().message, HasSubstr("line 1 has 10 ranges"));
  EXPECT_FALSE(folder.AddStop(0, Stop(500.0)));
  EXPECT_FALSE(folder.AddSweep(0, {Lines(3), {}}));
  EXPECT_TRUE(Read().poses[0].stops.empty());
}

TEST_F(SessionFolderTest, ImagesThatWereLookedAtAreNotLookedAtAgain) {
  SessionFolder folder = Made();
  ASSERT_TRUE(folder.AddPose());
  ASSERT_TRUE(folder.AddStop(0, Stop(0.0)));
  FoundViews found;
  ASSERT_TRUE(ReadCalibrationSession(path_, {}, &found));
  ASSERT_EQ(found.stops.size(), 1u);
  BoardView& seen = found.stops.begin()->second.a.emplace();
  seen.corner_ids = {0};
  seen.pixels = {{1.0, 2.0}};
  const auto read = ReadCalibrationSession(path_, {}, &found);
  ASSERT_TRUE(read);
  ASSERT_TRUE(read->poses[0].stops[0].view.a);
  EXPECT_EQ(read->poses[0].stops[0].view.a->pixels, seen.pixels);
}

}  // namespace
}  // namespace foresight
