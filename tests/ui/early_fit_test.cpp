#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mission/provenance.h"
#include "core/mission/recompute.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/fake_head.h"
#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/advice.h"
#include "ui/viewmodels/fit_view_model.h"
#include "ui/viewmodels/recording_view_model.h"
#include "ui/viewmodels/scan_flow.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// Dense enough for a fit to the part of it that holds the valve; made once.
const Scan& DenseScan() {
  static const Scan scan =
      WallAndValveScan({.from_rad = -0.26, .to_rad = 0.26, .speed_rad_s = 0.10});
  return scan;
}

/// A head that sweeps over a valve, the window's models on it, and a mission file.
struct EarlyFit : testing::Test {
  EarlyFit() {
    head_model.SetRecorderSource([this] { return recording.Recorder(); });
    QObject::connect(&head_model, &HeadViewModel::scanEnded, &recording,
                     &RecordingViewModel::keepScan);
    recording.Begin(Path());
  }
  QString Path() const { return QString::fromStdString((folder / "m.foresight").string()); }

  /// The sweep has come as far as `ratio` of its lines, with its image.
  bool Sweep(double ratio) {
    lines = static_cast<std::size_t>(ratio * static_cast<double>(DenseScan().lines.size()));
    head_model.scan();
    head->Deliver(DenseScan(), lines);
    head->DeliverFrame(DenseScan().frames.front());
    return WaitFor([&] {
      head_model.Poll();
      return session.Part().lines == static_cast<int>(lines) && session.CurrentImage() != nullptr;
    });
  }
  void EndSweep() {
    for (std::size_t i = lines; i < DenseScan().lines.size(); ++i)
      head->DeliverLine(DenseScan().lines[i]);
    Scan without_frames = DenseScan();
    without_frames.frames.clear();
    head->Finish(without_frames, ScanState::kComplete);
    head_model.Poll();
  }
  bool FitValve() {
    const SensorRig& rig = session.ShownScan()->rig;
    const auto center =
        rig.camera.Project(rig.CameraFromBase(session.CurrentImage()->motor_angle_rad) *
                           SyntheticValvePose().translation());
    const Eigen::Vector2d half(50, 50);
    fit.SetTool(ObjectKind::kValve, true);
    fit.DrawRegion({*center - half, *center + half});
    return WaitFor([&] { return !fit.Runner()->Busy(); }) && session.Objects().size() == 1u;
  }

  TemporaryFolder folder;
  std::shared_ptr<FakeHead> head = std::make_shared<FakeHead>(DenseScan().rig);
  SessionModel session{SessionMode::kSimulation};
  RecordingViewModel recording{&session};
  HeadViewModel head_model{head};
  ScanFlow flow{&head_model, &session};
  FitViewModel fit{&session};
  std::size_t lines = 0;
};

TEST_F(EarlyFit, AFitBeforeTheEndSaysOfHowManyLinesItIs) {
  ASSERT_TRUE(Sweep(0.8));
  ASSERT_TRUE(FitValve());
  const FoundObject object = session.Objects()[0];
  ASSERT_TRUE(object.part.has_value());
  EXPECT_EQ(object.part->lines, static_cast<int>(lines));
  EXPECT_EQ(object.part->of_lines, static_cast<int>(DenseScan().lines.size()));
  EXPECT_TRUE(session.IsCurrent(object));
  EXPECT_THAT(AdviceFor(object, 0, true, SessionMode::kSimulation).text.toStdString(),
              HasSubstr("part of the scan"));
}

TEST_F(EarlyFit, TheRegionAndTheObjectOutliveTheScansEnd) {
  ASSERT_TRUE(Sweep(0.8));
  ASSERT_TRUE(FitValve());
  EndSweep();
  ASSERT_TRUE(WaitFor([&] { return session.CurrentScan() != nullptr; }));
  EXPECT_TRUE(session.Region().has_value());
  EXPECT_TRUE(session.IsCurrent(session.Objects()[0]));
  EXPECT_EQ(session.Part().lines, 0) << "the whole scan has no part";
}

TEST_F(EarlyFit, AnotherScanTakesTheRegionAway) {
  ASSERT_TRUE(Sweep(0.8));
  ASSERT_TRUE(FitValve());
  Scan other = DenseScan();
  other.uuid = NewUuid();
  session.SetScan(std::make_shared<const Scan>(other));
  EXPECT_FALSE(session.Region().has_value());
  EXPECT_FALSE(session.IsCurrent(session.Objects()[0]));
}

TEST_F(EarlyFit, ItIsKeptAndCanBeMadeAgainFromTheWholeScan) {
  ASSERT_TRUE(Sweep(0.8));
  ASSERT_TRUE(FitValve());
  EndSweep();
  ASSERT_TRUE(WaitFor([&] { return session.CurrentScan() && session.Objects()[0].kept; }));
  ASSERT_TRUE(recording.WriteAll());
  const auto file = MissionFile::OpenReadOnly((folder / "m.foresight").string()).value();
  const auto records = file->ListDetections().value();
  ASSERT_EQ(records.size(), 1u);
  Recomputer recomputer(*file);
  const auto again = recomputer.RemakeDetection(records[0], RunContext());
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->outcome, Recomputed::Outcome::kSame) << again->differences.size();
}

}  // namespace
}  // namespace foresight
