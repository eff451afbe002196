#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QTemporaryDir>

#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/measure_view_model.h"
#include "ui/viewmodels/mission_objects.h"
#include "ui/viewmodels/recording_view_model.h"
#include "ui/viewmodels/review_view_model.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// A session with a wall 2 m ahead of the head, and its depth map.
struct MeasureTest : testing::Test {
  std::shared_ptr<const Scan> scan = std::make_shared<const Scan>(
      WallAndValveScan({.from_rad = -0.3, .to_rad = 0.3, .speed_rad_s = 0.4}));
  TaskQueue tasks;
  SessionModel session{SessionMode::kReplay, &tasks};
  MapViewModel map{&session};
  MeasureViewModel measure{&session, &map};
  std::vector<Notice> notices;
  std::vector<NoteRecord> kept;
  std::shared_ptr<const RegisteredScan> cloud;

  MeasureTest() {
    QObject::connect(&session, &SessionModel::noticed,
                     [this](const Notice& notice) { notices.push_back(notice); });
    QObject::connect(session.Notes(), &NotesModel::touched,
                     [this](const NoteRecord& note) { kept.push_back(note); });
    cloud = std::make_shared<const RegisteredScan>(RegisterScan(*scan, {}).value());
    session.SetScan(scan);
    session.SetCloud(cloud, scan->rig);
  }

  Eigen::Vector3d InRobot(int line, int beam) const {
    return scan->rig.robot_from_base * cloud->points[cloud->Index(line, beam)].cast<double>();
  }
  /// A viewer at the head that looks along the robot's x.
  CloudClick ClickOn(const Eigen::Vector3d& place) const {
    const Eigen::Vector3d eye = scan->rig.robot_from_base.translation();
    CloudClick click;
    click.clip_from_robot.setZero();
    click.clip_from_robot.row(0) << 0, -1, 0, eye.y();
    click.clip_from_robot.row(1) << 0, 0, 1, -eye.z();
    click.clip_from_robot.row(3) << 1, 0, 0, -eye.x();
    const Eigen::Vector4d clip = click.clip_from_robot * place.homogeneous();
    click.at = clip.head<2>() / clip.w();
    click.reach = {0.01, 0.01};
    return click;
  }
  void Click(int line, int beam) { measure.ClickInCloud(ClickOn(InRobot(line, beam))); }
  const std::vector<ShownNote>& Notes() { return session.Notes()->All(); }
};

TEST_F(MeasureTest, TwoClicksAreADistanceThatIsKept) {
  measure.toggle();
  EXPECT_TRUE(measure.On());
  EXPECT_EQ(measure.Hint(), "Click the first point");
  Click(20, 480);
  EXPECT_EQ(measure.Points().size(), 1u);
  EXPECT_EQ(measure.Hint(), "Click the second point");
  Click(20, 600);
  EXPECT_TRUE(measure.Points().empty()) << "the next one begins";
  ASSERT_EQ(Notes().size(), 1u);
  const Measurement& measured = Notes()[0].measurement.value();
  EXPECT_NEAR(measured.value, (InRobot(20, 480) - InRobot(20, 600)).norm(), 1e-5);
  EXPECT_EQ(measured.points[0].line, 20);
  EXPECT_EQ(measured.points[0].beam, 480);
  EXPECT_EQ(measured.points[0].scan_uuid, scan->uuid);
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0].kind, kMeasurementKind);
  EXPECT_EQ(kept[0].scan_uuid, scan->uuid);
  EXPECT_NE(kept[0].author, "");
}

TEST_F(MeasureTest, AClickWhereNothingWasMeasuredTakesNothingAndSaysSo) {
  measure.SetKind(MeasureKind::kPoint);
  measure.ClickInCloud(ClickOn({2.0, 0.0, 9.0}));
  EXPECT_TRUE(Notes().empty());
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].what, "Nothing was measured there.");
}

TEST_F(MeasureTest, BackspaceTakesAPointBackAndEscapeLeaves) {
  measure.SetKind(MeasureKind::kAngle);
  EXPECT_FALSE(measure.CanTakeBack());
  Click(10, 500);
  Click(10, 540);
  measure.back();
  ASSERT_EQ(measure.Points().size(), 1u);
  EXPECT_EQ(measure.Points()[0].beam, 500);
  measure.leave();
  EXPECT_FALSE(measure.On());
  EXPECT_TRUE(measure.Points().empty());
  Click(10, 500);
  EXPECT_TRUE(measure.Points().empty()) << "the tool is off";
}

TEST_F(MeasureTest, AnotherScanDropsThePointsOfTheOneBefore) {
  measure.SetKind(MeasureKind::kDistance);
  Click(10, 500);
  session.SetScan(std::make_shared<const Scan>(
      WallAndValveScan({.from_rad = -0.01, .to_rad = 0.01, .speed_rad_s = 0.4})));
  EXPECT_TRUE(measure.Points().empty());
}

TEST_F(MeasureTest, TheDistanceFromTheWallIsThatOfWhatStandsBeforeIt) {
  measure.SetKind(MeasureKind::kPlaneDistance);
  EXPECT_TRUE(measure.WantsPlane());
  // Beside the valve: the wall.
  Click(static_cast<int>(cloud->lines / 2), 700);
  ASSERT_TRUE(measure.PlaneSoFar()) << (notices.empty() ? "" : notices[0].what.toStdString());
  EXPECT_LT(measure.PlaneSoFar()->rms_m, 0.002);
  measure.back();
  EXPECT_TRUE(measure.WantsPlane()) << "the plane is taken back, too";
  Click(static_cast<int>(cloud->lines / 2), 700);
  Click(static_cast<int>(cloud->lines / 2), 690);
  ASSERT_EQ(Notes().size(), 1u);
  EXPECT_NEAR(Notes()[0].measurement->value, 0.0, 0.003) << "it lies in the wall";
  EXPECT_THAT(DetailsOf(Notes()[0]).toStdString(), HasSubstr("150 mm of the click"));
}

TEST_F(MeasureTest, ABoxThatIsDrawnGivesThePlaneOfWhatIsInIt) {
  measure.SetKind(MeasureKind::kPlaneDistance);
  const CloudClick a = ClickOn(InRobot(5, 700)), b = ClickOn(InRobot(cloud->lines - 5, 640));
  CloudRectangle rectangle;
  rectangle.clip_from_robot = a.clip_from_robot;
  rectangle.corners = {a.at.cwiseMin(b.at), a.at.cwiseMax(b.at)};
  measure.DrawPlane(rectangle);
  ASSERT_TRUE(measure.PlaneSoFar()) << (notices.empty() ? "" : notices[0].what.toStdString());
  EXPECT_EQ(measure.PlaneSoFar()->made_from, "the returns in the box that was drawn");
  EXPECT_GT(std::abs(measure.PlaneSoFar()->plane.normal.x()), 0.999);
}

TEST_F(MeasureTest, AHeightWithoutAnyGroundIsRefusedInWords) {
  measure.SetKind(MeasureKind::kHeight);
  Click(20, 500);
  EXPECT_TRUE(Notes().empty());
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_THAT(notices[0].what.toStdString(), HasSubstr("The ground is not known"));
}

TEST_F(MeasureTest, AHeightTakesTheGroundOfTheTerrain) {
  TerrainDetection terrain;
  TerrainSurface ground;
  ground.kind = TerrainSurface::Kind::kGround;
  ground.size_m = {2.0, 2.0};
  const auto base_from_robot = scan->rig.robot_from_base.Inverse();
  ground.base_from_object = {base_from_robot.rotation(),
                             base_from_robot * Eigen::Vector3d(1.0, 0.0, -0.5)};
  terrain.surfaces = {ground};
  FoundObject object;
  object.detection = terrain;
  object.rig = scan->rig;
  object.scan_uuid = scan->uuid;
  session.AddObject(object);
  measure.SetKind(MeasureKind::kHeight);
  Click(20, 500);
  ASSERT_EQ(Notes().size(), 1u);
  EXPECT_NEAR(Notes()[0].measurement->value, InRobot(20, 500).z() + 0.5, 1e-6);
  EXPECT_THAT(DetailsOf(Notes()[0]).toStdString(), HasSubstr("the terrain's ground"));
}

TEST_F(MeasureTest, APixelIsTakenByItsDepthUnlessItIsMasked) {
  auto depth = std::make_shared<DepthResult>();
  const CameraModel& camera = scan->rig.camera;
  depth->dense.depth_m = DepthImage(camera.width, camera.height, 2.0f);
  depth->mask = MaskImage(camera.width, camera.height, 255);
  depth->mask(100, 100) = 0;
  measure.SetKind(MeasureKind::kPoint);
  measure.ClickInImage({320, 240});
  EXPECT_EQ(notices.size(), 1u) << "there is no depth map yet";
  session.SetDepth(depth);
  measure.ClickInImage({320.3, 239.8});
  ASSERT_EQ(Notes().size(), 1u);
  EXPECT_EQ(Notes()[0].measurement->points[0].pixel, Eigen::Vector2d(320, 240));
  measure.ClickInImage({100, 100});
  EXPECT_EQ(Notes().size(), 1u);
  EXPECT_EQ(notices.size(), 2u);
}

TEST_F(MeasureTest, UndoTakesAMeasurementBackAndRedoBringsItAgain) {
  measure.SetKind(MeasureKind::kPoint);
  Click(20, 500);
  ASSERT_EQ(Notes().size(), 1u);
  const std::string uuid = Notes()[0].record.uuid;
  ASSERT_TRUE(session.Notes()->Change(uuid, "bolt", "#M8"));
  EXPECT_THAT(TextOf(Notes()[0]).toStdString(), HasSubstr("bolt: Point ("));
  EXPECT_THAT(TextOf(Notes()[0]).toStdString(), HasSubstr("#m8"));
  session.Notes()->Remove(uuid);
  EXPECT_TRUE(Notes().empty());
  session.Undo()->undo();
  ASSERT_EQ(Notes().size(), 1u);
  EXPECT_EQ(Notes()[0].record.text, "bolt");
  session.Undo()->undo();
  EXPECT_EQ(Notes()[0].record.text, "");
  session.Undo()->undo();
  EXPECT_TRUE(Notes().empty());
  session.Undo()->redo();
  ASSERT_EQ(Notes().size(), 1u);
  EXPECT_EQ(Notes()[0].record.uuid, uuid);
  EXPECT_EQ(kept.back().uuid, uuid) << "every step is kept";
  EXPECT_FALSE(kept.back().deleted);
}

TEST_F(MeasureTest, ChoosingOneAsksForItsPlaceAndItsScan) {
  measure.SetKind(MeasureKind::kPoint);
  Click(20, 500);
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero();
  QString scan_wanted;
  QObject::connect(session.Notes(), &NotesModel::centreWanted,
                   [&](const Eigen::Vector3d& place, MeasureFrame) { wanted = place; });
  QObject::connect(session.Notes(), &NotesModel::scanWanted,
                   [&](const QString& uuid) { scan_wanted = uuid; });
  session.Notes()->Select(Notes()[0].record.uuid);
  EXPECT_LT((wanted - InRobot(20, 500)).norm(), 1e-5);
  EXPECT_EQ(scan_wanted.toStdString(), scan->uuid);
}

/// A map of the mission with the scan twice, which the cloud shows.
struct MeasureInMapTest : MeasureTest {
  QTemporaryDir folder;
  QString path = folder.filePath("m.foresight");

  void SetUp() override {
    {
      const auto file = MissionFile::Create(path.toStdString()).value();
      for (int i = 0; i < 2; ++i) {
        Scan copy = *scan;
        if (i > 0) copy.uuid = NewUuid();
        ASSERT_TRUE(AppendScan(file.get(), copy, {}));
      }
    }
    map.Make(path);
    ASSERT_TRUE(WaitFor([&] { return !map.Busy(); }));
    ASSERT_NE(map.Map(), nullptr);
    map.SetShown(true);
  }
};

TEST_F(MeasureInMapTest, AClickTakesAPointOfTheMapAndItIsKeptWithTheMission) {
  measure.SetKind(MeasureKind::kDistance);
  Click(20, 480);
  ASSERT_EQ(measure.Points().size(), 1u);
  EXPECT_EQ(measure.Frame(), MeasureFrame::kMap);
  Click(20, 600);
  ASSERT_EQ(Notes().size(), 1u);
  EXPECT_EQ(Notes()[0].record.scan_uuid, "");
  EXPECT_EQ(Notes()[0].measurement->frame, MeasureFrame::kMap);
  EXPECT_NEAR(Notes()[0].measurement->value, (InRobot(20, 480) - InRobot(20, 600)).norm(), 0.005)
      << "the second scan lies within some millimetres over the first";
  EXPECT_THAT(DetailsOf(Notes()[0]).toStdString(), HasSubstr("m in the map's frame: line "));
  ASSERT_EQ(kept.size(), 1u);
}

TEST_F(MeasureInMapTest, APlaneIsMadeOfTheReturnsOfAllScans) {
  measure.SetKind(MeasureKind::kPlaneDistance);
  Click(static_cast<int>(cloud->lines / 2), 700);
  ASSERT_TRUE(measure.PlaneSoFar()) << (notices.empty() ? "" : notices[0].what.toStdString());
  map.SetShown(false);
  EXPECT_FALSE(measure.PlaneSoFar()) << "it is of the map";
  Click(static_cast<int>(cloud->lines / 2), 700);
  const int of_one_scan = measure.PlaneSoFar().value().points;
  measure.back();
  map.SetShown(true);
  Click(static_cast<int>(cloud->lines / 2), 700);
  EXPECT_GT(measure.PlaneSoFar().value().points, 1.8 * of_one_scan);
}

TEST_F(MeasureInMapTest, PointsOfTheMapAndOfADepthMapDoNotGoTogether) {
  auto depth = std::make_shared<DepthResult>();
  const CameraModel& camera = scan->rig.camera;
  depth->dense.depth_m = DepthImage(camera.width, camera.height, 2.0f);
  depth->mask = MaskImage(camera.width, camera.height, 255);
  session.SetDepth(depth);
  measure.SetKind(MeasureKind::kDistance);
  Click(20, 480);
  measure.ClickInImage({320, 240});
  EXPECT_EQ(measure.Points().size(), 1u);
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].what, "What was clicked before is in the map.");
  measure.back();
  measure.ClickInImage({320, 240});
  EXPECT_EQ(measure.Points().size(), 1u);
  Click(20, 480);
  EXPECT_EQ(measure.Points().size(), 1u);
  EXPECT_EQ(notices.back().what, "What was clicked before is in a scan.");
}

TEST_F(MeasureInMapTest, AnotherScanOnTheScreenLeavesThePointsOfTheMap) {
  measure.SetKind(MeasureKind::kDistance);
  Click(20, 480);
  session.SetScan(std::make_shared<const Scan>(
      WallAndValveScan({.from_rad = -0.01, .to_rad = 0.01, .speed_rad_s = 0.4})));
  EXPECT_EQ(measure.Points().size(), 1u);
  map.clear();
  EXPECT_TRUE(measure.Points().empty()) << "the map is gone";
}

TEST_F(MeasureTest, InReviewTheyAreKeptBesideTheMissionWhichStaysAsItIs) {
  QTemporaryDir folder;
  const QString path = folder.filePath("m.foresight");
  {
    const auto file = MissionFile::Create(path.toStdString()).value();
    ASSERT_TRUE(AppendScan(file.get(), *scan, {}));
    NoteRecord note;
    note.kind = kNoteKind;
    note.text = "of the run";
    ASSERT_TRUE(file->AddNote(note));
  }
  ReviewViewModel review(&session);
  const auto settled = [&] { return WaitFor([&] { return !review.Busy(); }); };
  review.Open(path);
  ASSERT_TRUE(settled());
  session.SetCloud(cloud, scan->rig);
  ASSERT_EQ(Notes().size(), 1u);
  measure.SetKind(MeasureKind::kPoint);
  Click(20, 500);
  ASSERT_TRUE(session.Notes()->Change(Notes()[0].record.uuid, "of the review", "late"));
  ASSERT_TRUE(settled());
  EXPECT_EQ(MissionFile::OpenReadOnly(path.toStdString()).value()->ListNotes()->size(), 1u);
  review.close();
  EXPECT_TRUE(Notes().empty());
  review.Open(path);
  ASSERT_TRUE(settled());
  ASSERT_EQ(Notes().size(), 2u);
  EXPECT_EQ(Notes()[0].record.text, "of the review");
  EXPECT_EQ(Notes()[0].record.tags, "late");
  EXPECT_TRUE(Notes()[1].measurement);
  EXPECT_TRUE(notices.empty());
}

TEST_F(MeasureTest, LiveTheyAreKeptInTheMissionThatIsRecorded) {
  QTemporaryDir folder;
  const QString path = folder.filePath("m.foresight");
  {
    RecordingViewModel recording(&session);
    ASSERT_TRUE(recording.Begin(path));
    recording.keepScan(scan);
    measure.SetKind(MeasureKind::kPoint);
    Click(20, 500);
    NoteRecord note;
    note.kind = kNoteKind;
    note.text = "about it all";
    ASSERT_TRUE(session.Notes()->Add(note));
    ASSERT_TRUE(recording.WriteAll());
  }
  const auto notes = MissionFile::OpenReadOnly(path.toStdString()).value()->ListNotes().value();
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0].kind, kMeasurementKind);
  EXPECT_EQ(notes[0].scan_id, 1);
  EXPECT_EQ(notes[1].text, "about it all");
  EXPECT_EQ(notes[1].scan_id, 0);
  EXPECT_TRUE(notices.empty());
}

}  // namespace
}  // namespace foresight
