#include "ui/viewmodels/replay_scan.h"

#include <gtest/gtest.h>

#include "tests/ui/synthetic_scan.h"

namespace foresight {
namespace {

/// Two seconds of lines and an image in their middle, in real time.
ReplayScan TwoSecondScan() {
  static const std::shared_ptr<const Scan> kScan = [] {
    Scan scan = WallAndValveScan({.from_rad = -0.1, .to_rad = 0.1, .speed_rad_s = 0.1});
    scan.frames.Edit(0).time_s = scan.lines.front().time_s + 1.0;
    return std::make_shared<const Scan>(std::move(scan));
  }();
  ReplayScan replay;
  replay.reviewed.scan = kScan;
  replay.cloud = std::make_shared<const RegisteredScan>(RegisterScan(*kScan, {}).value());
  replay.begin_utc_ns = BeginUtc_ns(*kScan);
  replay.end_utc_ns =
      replay.begin_utc_ns + static_cast<std::int64_t>(1e9 * kScan->rig.lidar.period_s *
                                                      static_cast<double>(kScan->lines.size()));
  return replay;
}

std::int64_t After(const ReplayScan& replay, double seconds) {
  return replay.begin_utc_ns + static_cast<std::int64_t>(1e9 * seconds);
}

TEST(ReplayScan, ALineIsThereOnceItsLastBeamHadBeenMeasured) {
  const ReplayScan replay = TwoSecondScan();
  const LidarModel& lidar = replay.Whole()->rig.lidar;
  const double one_line_s = lidar.BeamTime(lidar.beams - 1);
  EXPECT_EQ(replay.LinesAt(After(replay, 0.0)), 0);
  EXPECT_EQ(replay.LinesAt(After(replay, one_line_s - 1e-4)), 0);
  EXPECT_EQ(replay.LinesAt(After(replay, one_line_s + 1e-4)), 1);
  EXPECT_EQ(replay.LinesAt(After(replay, one_line_s + 39 * lidar.period_s + 1e-4)), 40);
  EXPECT_EQ(replay.LinesAt(replay.end_utc_ns), 80);
}

TEST(ReplayScan, AnImageIsThereOnceItWasTaken) {
  const ReplayScan replay = TwoSecondScan();
  EXPECT_EQ(replay.ImagesAt(After(replay, 0.999)), 0);
  EXPECT_EQ(replay.ImagesAt(After(replay, 1.001)), 1);
}

TEST(ReplayScan, ThePointsOfTheFirstLinesAreThoseOfAScanThatHasNoOthers) {
  const ReplayScan replay = TwoSecondScan();
  Scan part = *replay.Whole();
  part.lines.Truncate(33);
  const RegisteredScan expected = RegisterScan(part, {}).value();
  const auto cloud = replay.CloudOf(33);
  ASSERT_EQ(cloud->lines, 33);
  const auto bytes = [](const auto& array) {
    return std::string(reinterpret_cast<const char*>(array.data()),
                       array.size() * sizeof(*array.data()));
  };
  EXPECT_TRUE(bytes(cloud->points) == bytes(expected.points));
  EXPECT_TRUE(bytes(cloud->range_m) == bytes(expected.range_m));
  EXPECT_TRUE(bytes(cloud->intensity) == bytes(expected.intensity));
  EXPECT_TRUE(bytes(cloud->origins) == bytes(expected.origins));
}

TEST(ReplayScan, APartSharesItsLinesAndPixelsWithTheWhole) {
  const ReplayScan replay = TwoSecondScan();
  const auto part = replay.Part(50, 1);
  ASSERT_EQ(part->lines.size(), 50u);
  EXPECT_EQ(part->state, ScanState::kRunning);
  EXPECT_EQ(&part->lines[49], &replay.Whole()->lines[49]);
  EXPECT_EQ(&part->frames[0], &replay.Whole()->frames[0]);
  EXPECT_EQ(replay.CloudOf(50)->points.data(), replay.cloud->points.data());
}

TEST(ReplayScan, AScanThatWasSimulatedTenTimesAsFastIsPlayedThatFast) {
  ReplayScan replay = TwoSecondScan();
  replay.end_utc_ns = After(replay, 0.2);
  EXPECT_NEAR(replay.LinesAt(After(replay, 0.1)), 40, 1);
  EXPECT_EQ(replay.ImagesAt(After(replay, 0.11)), 1);
  EXPECT_EQ(replay.LinesAt(After(replay, 0.2)), 80);
}

TEST(ReplayScan, AnObjectIsThereFromWhenItWasFoundAndStandsAsItStoodThen) {
  ReplayScan replay = TwoSecondScan();
  using Action = DetectionEvent::Action;
  ReviewedObject valve;
  valve.object.uuid = "valve";
  valve.object.name = QStringLiteral("gas");
  valve.object.decision = Decision::kAccepted;
  valve.found_utc_ns = After(replay, 5.0);
  valve.actions = {{After(replay, 6.0), "anna", Action::kRejected, ""},
                   {After(replay, 7.0), "anna", Action::kDeleted, ""},
                   {After(replay, 8.0), "anna", Action::kRestored, ""},
                   {After(replay, 9.0), "anna", Action::kRenamed, "gas"},
                   {After(replay, 10.0), "anna", Action::kAccepted, ""}};
  replay.reviewed.objects = {valve};
  EXPECT_TRUE(replay.ObjectsAt(After(replay, 4.9)).empty());
  ASSERT_EQ(replay.ObjectsAt(After(replay, 5.1)).size(), 1u);
  EXPECT_EQ(replay.ObjectsAt(After(replay, 5.1))[0].decision, Decision::kOpen);
  EXPECT_EQ(replay.ObjectsAt(After(replay, 6.1))[0].decision, Decision::kRejected);
  EXPECT_TRUE(replay.ObjectsAt(After(replay, 7.1)).empty());
  EXPECT_TRUE(replay.ObjectsAt(After(replay, 8.1))[0].name.isEmpty());
  EXPECT_EQ(replay.ObjectsAt(After(replay, 9.1))[0].name, QStringLiteral("gas"));
  EXPECT_EQ(replay.ObjectsAt(After(replay, 10.1))[0].decision, Decision::kAccepted);
  EXPECT_NE(replay.ObjectStatesAt(After(replay, 9.1)), replay.ObjectStatesAt(After(replay, 10.1)));
}

TEST(ReplayScan, ADecisionIsAboutTheAnswerThatItNamedThen) {
  ReplayScan replay = TwoSecondScan();
  using Action = DetectionEvent::Action;
  ReviewedObject valve;
  ValveDetection detection;
  detection.alternatives = {detection.best};
  valve.object.detection = detection;
  valve.object.decision = Decision::kAccepted;
  valve.object.decided_candidate = 1;
  valve.found_utc_ns = After(replay, 5.0);
  valve.actions = {{After(replay, 6.0), "anna", Action::kRejected, "answer 2"},
                   {After(replay, 7.0), "anna", Action::kReopened, ""},
                   {After(replay, 8.0), "anna", Action::kAccepted, "answer 9"},
                   {After(replay, 9.0), "anna", Action::kAccepted, ""},
                   {After(replay, 10.0), "anna", Action::kAccepted, "answer 2"}};
  replay.reviewed.objects = {valve};
  const auto candidate_after = [&](double seconds) {
    return replay.ObjectsAt(After(replay, seconds)).at(0).decided_candidate;
  };
  EXPECT_EQ(candidate_after(5.1), 0) << "nothing was decided yet";
  EXPECT_EQ(candidate_after(6.1), 1);
  EXPECT_EQ(candidate_after(7.1), 0);
  EXPECT_EQ(candidate_after(8.1), 1) << "there is no ninth";
  EXPECT_EQ(candidate_after(9.1), 0);
  EXPECT_EQ(candidate_after(10.1), 1);
}

TEST(ReplayScan, DepthIsThereFromWhenItWasComputedOrElseFromTheScansEnd) {
  ReplayScan replay = TwoSecondScan();
  EXPECT_FALSE(replay.HasDepthAt(0, replay.end_utc_ns - 1));
  EXPECT_TRUE(replay.HasDepthAt(0, replay.end_utc_ns));
  replay.depth_utc_ns[0] = replay.end_utc_ns + 100;
  EXPECT_FALSE(replay.HasDepthAt(0, replay.end_utc_ns + 99));
  EXPECT_TRUE(replay.HasDepthAt(0, replay.end_utc_ns + 100));
  EXPECT_FALSE(replay.HasDepthAt(-1, replay.end_utc_ns + 100)) << "there is no image";
}

}  // namespace
}  // namespace foresight
