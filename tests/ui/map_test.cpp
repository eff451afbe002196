#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QTemporaryDir>
#include <fstream>

#include "core/geometry/angles.h"
#include "core/simulation/simulate_scan.h"
#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/clip_box_model.h"
#include "ui/viewmodels/map_view_model.h"
#include "ui/viewmodels/mission_objects.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// A mission with the same place scanned twice.
struct MapTest : testing::Test {
  QTemporaryDir folder;
  QString path = folder.filePath("m.foresight");
  TaskQueue tasks;
  SessionModel session{SessionMode::kReplay, &tasks};
  MapViewModel map{&session};
  std::vector<Notice> notices;

  MapTest() {
    QObject::connect(&session, &SessionModel::noticed,
                     [this](const Notice& notice) { notices.push_back(notice); });
    const auto file = MissionFile::Create(path.toStdString()).value();
    for (int i = 0; i < 2; ++i) {
      Scan scan = WallAndValveScan({.from_rad = -0.3, .to_rad = 0.3, .speed_rad_s = 0.4});
      scan.uuid = NewUuid();
      EXPECT_TRUE(AppendScan(file.get(), scan, {}));
    }
  }
  bool Settled() {
    return WaitFor([&] { return !map.Busy(); });
  }
};

TEST_F(MapTest, TheScansOfAMissionComeTogetherInTheBackground) {
  int made = 0;
  QObject::connect(&map, &MapViewModel::made, [&] { ++made; });
  map.Make(path);
  EXPECT_TRUE(map.Busy());
  EXPECT_NE(map.WhyNoMap(), "");
  ASSERT_TRUE(Settled());
  ASSERT_NE(map.Map(), nullptr) << (notices.empty() ? "" : notices[0].next.toStdString());
  EXPECT_EQ(made, 1);
  const auto texts = map.PlaceTexts();
  ASSERT_EQ(texts.size(), 2u);
  EXPECT_THAT(texts[0].toStdString(), HasSubstr("the map's frame"));
  EXPECT_THAT(texts[1].toStdString(), HasSubstr("mm rms over"));
  std::size_t returns = 0;
  for (const MappedScan& scan : map.Map()->map.scans)
    returns += ReturnsInRobot(scan.cloud, scan.rig).size();
  EXPECT_EQ(map.Map()->pyramid.size(), returns);
}

TEST_F(MapTest, AFileOfOdometryThatIsFarOffLeavesAScanOutAndABadFileIsNamed) {
  const QString csv = folder.filePath("robot.csv");
  const auto write = [&csv](const char* rows) {
    std::ofstream(csv.toStdString()) << "scan,x_m,y_m,z_m,qw,qx,qy,qz\n" << rows;
  };
  // Far from the truth: the same place 40 m away does not come together.
  write("1,0,0,0,1,0,0,0\n2,40,0,0,1,0,0,0\n");
  map.Make(path, csv);
  ASSERT_TRUE(Settled());
  ASSERT_NE(map.Map(), nullptr);
  EXPECT_FALSE(map.Map()->map.scans[1].place.InMap());
  write("1,0,0,0,0,0,0,0\n");
  map.Make(path, csv);
  ASSERT_TRUE(Settled());
  ASSERT_FALSE(notices.empty());
  EXPECT_THAT((notices.back().what + notices.back().next).toStdString(),
              HasSubstr("robot.csv:2: the quaternion"));
}

/// A sweep of the room by a robot that stands elsewhere than the scene's own.
Scan RoomFrom(const Rigid<frame::Map, frame::Robot>& standpoint, std::uint64_t seed) {
  const auto room = std::make_shared<const Scene>(
      LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml").value());
  SensorRig rig = DefaultSensorRig();
  const auto mounted = rig.robot_from_base;
  // To the simulation the standpoint is another mounting of the head.
  rig.robot_from_base =
      Rigid<frame::Robot, frame::Robot>(standpoint.rotation(), standpoint.translation()) * mounted;
  WorldOptions options;
  options.seed = seed;
  const World world(room, rig, options);
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(-40.0);
  plan.to_rad = RadiansFromDegrees(40.0);
  plan.speed_rad_s = RadiansFromDegrees(16.0);
  Scan scan = SimulateSweep(world, plan, {}).value();
  scan.uuid = NewUuid();
  scan.rig.robot_from_base = mounted;
  scan.rig.angle_correction = world.CalibratedCorrection();
  return scan;
}

TEST_F(MapTest, TwoScansOfARoomComeTogetherFromOdometryThatIs50MillimetresAnd3DegreesOff) {
  const Rigid<frame::Map, frame::Robot> truth(
      Eigen::Quaterniond(Eigen::AngleAxisd(RadiansFromDegrees(10.0), Eigen::Vector3d::UnitZ())),
      Eigen::Vector3d(0.4, 0.3, 0.0));
  const QString room = folder.filePath("room.foresight"), csv = folder.filePath("robot.csv");
  {
    const auto file = MissionFile::Create(room.toStdString()).value();
    ASSERT_TRUE(AppendScan(file.get(), RoomFrom({}, 21), {}));
    ASSERT_TRUE(AppendScan(file.get(), RoomFrom(truth, 22), {}));
  }
  const Eigen::Vector3d way(0.6, -0.64, 0.48);  // of length 1
  const Eigen::Vector3d axis(0.48, 0.6, 0.64);  // likewise
  const Eigen::Vector3d t = truth.translation() + 0.050 * way;
  const Eigen::Quaterniond q(truth.rotation() * Eigen::AngleAxisd(RadiansFromDegrees(3.0), axis));
  std::ofstream(csv.toStdString())
      << fmt::format("scan,x_m,y_m,z_m,qw,qx,qy,qz\n1,0,0,0,1,0,0,0\n2,{},{},{},{},{},{},{}\n",
                     t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
  map.Make(room, csv);
  ASSERT_TRUE(WaitFor([&] { return !map.Busy(); }, 120'000));
  ASSERT_NE(map.Map(), nullptr) << (notices.empty() ? "" : notices[0].next.toStdString());
  const MapPlace& place = map.Map()->map.scans.at(1).place;
  ASSERT_TRUE(place.InMap()) << place.failure;
  EXPECT_LT((place.map_from_robot.translation() - truth.translation()).norm(), 0.005);
  EXPECT_LT(DegreesFromRadians(place.map_from_robot.rotation().angularDistance(truth.rotation())),
            0.1);
}

TEST_F(MapTest, NothingHasChangedBetweenTwoScansOfTheSame) {
  map.Make(path);
  ASSERT_TRUE(Settled());
  map.FindChanges(0, 1);
  ASSERT_TRUE(Settled());
  EXPECT_TRUE(map.Changes().empty());
  EXPECT_THAT(map.ChangesText().toStdString(), HasSubstr("Nothing has changed."));
}

TEST_F(MapTest, ACancelledMapLeavesTheOneBefore) {
  map.Make(path);
  ASSERT_TRUE(Settled());
  const auto before = map.Map();
  map.Make(path);
  map.cancel();
  ASSERT_TRUE(Settled());
  EXPECT_TRUE(map.Map() == before || map.Map()->pyramid.size() == before->pyramid.size());
  EXPECT_TRUE(notices.empty()) << "who cancels knows it";
}

TEST_F(MapTest, AMissionThatIsNotThereIsToldInWords) {
  map.Make(folder.filePath("none.foresight"));
  ASSERT_TRUE(Settled());
  EXPECT_EQ(map.Map(), nullptr);
  ASSERT_EQ(notices.size(), 1u);
}

TEST(ClipBoxTest, BeginsAsTheMiddleHalfAndIsRememberedWhileItIsOff) {
  ClipBoxModel clip;
  EXPECT_FALSE(clip.Box());
  clip.SetBounds({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 8, 2)});
  clip.toggle();
  ASSERT_TRUE(clip.Box());
  EXPECT_EQ(clip.Box()->min(), Eigen::Vector3d(1, 2, 0.5));
  EXPECT_EQ(clip.Box()->max(), Eigen::Vector3d(3, 6, 1.5));
  clip.SetBox({Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0, 3, 1)});
  EXPECT_EQ(clip.Box()->min(), Eigen::Vector3d(0, 1, 1)) << "sides the wrong way round";
  EXPECT_NEAR(clip.Box()->sizes().z(), ClipBoxModel::kShortest_m, 1e-12);
  clip.toggle();
  EXPECT_FALSE(clip.Box());
  clip.toggle();
  EXPECT_EQ(clip.Box()->min(), Eigen::Vector3d(0, 1, 1));
  clip.SetBox({Eigen::Vector3d(std::nan(""), 1, 1), Eigen::Vector3d(0, 3, 1)});
  EXPECT_EQ(clip.Box()->min(), Eigen::Vector3d(0, 1, 1)) << "no number, no side";
}

}  // namespace
}  // namespace foresight
