// Points, planes and heights in a map of two scans.
#include "core/mapping/measure_in_map.h"

#include <gtest/gtest.h>

#include "core/geometry/angles.h"
#include "tests/core/measure/flat_room.h"

namespace foresight {
namespace {

/// Two rooms of one wall and one floor side by side, the second seen by a robot that stood 3 m to
/// the left and was turned by 5 deg; its place is known to 2 mm.
struct TwoRooms {
  FlatRoom room;
  Rigid<frame::Map, frame::Robot> place{
      Eigen::Quaterniond(Eigen::AngleAxisd(RadiansFromDegrees(5.0), Eigen::Vector3d::UnitZ())),
      Eigen::Vector3d(0.0, 3.0, 0.5)};
  MissionMap map;
  PointPyramid pyramid;

  TwoRooms() {
    map.scans.push_back({1, "first", room.rig, room.cloud, {}});
    CloudAlignment alignment;
    alignment.map_from_robot = place;
    alignment.largest_sigma_m = 0.002;
    map.scans.push_back({2, "second", room.rig, room.cloud, {place, alignment, {}}});
    pyramid = PointPyramid::Build(PointsOfMap(map), {.leaf_points = 500, .grid = 8}, {}).value();
  }

  Eigen::Vector3d InMap(int line, int beam) const { return place * room.InRobot(line, beam); }
  /// A viewer 2 m behind a place who looks along the map's x at it.
  static CloudClick ClickOn(const Eigen::Vector3d& point) {
    const Eigen::Vector3d eye = point - Eigen::Vector3d(2.0, 0.0, 0.0);
    CloudClick click;
    click.clip_from_robot.setZero();
    click.clip_from_robot.row(0) << 0, -1, 0, eye.y();
    click.clip_from_robot.row(1) << 0, 0, 1, -eye.z();
    click.clip_from_robot.row(3) << 1, 0, 0, -eye.x();
    click.reach = {0.002, 0.002};
    return click;
  }
  MeasuredPoint Picked(const Eigen::Vector3d& point) const {
    return PickInMap(map, pyramid, ClickOn(point)).value();
  }
};

TEST(PickInMapTest, SnapsToTheReturnOfTheScanThatItBelongsTo) {
  const TwoRooms rooms;
  const MeasuredPoint picked = rooms.Picked(rooms.InMap(60, 100));
  EXPECT_EQ(picked.scan_uuid, "second");
  EXPECT_EQ(picked.line, 60);
  EXPECT_EQ(picked.beam, 100);
  EXPECT_LT((picked.position_m - rooms.InMap(60, 100)).norm(), 1e-6);
  EXPECT_EQ(picked.placement_sigma_m, 0.002);
  const Eigen::Vector3d sensor = rooms.place * rooms.room.Sensor();
  EXPECT_LT((sensor + picked.range_m * picked.ray - picked.position_m).norm(), 1e-4);
  EXPECT_EQ(rooms.Picked(rooms.room.InRobot(60, 100)).scan_uuid, "first");
}

TEST(PickInMapTest, InventsNothingAndTakesNothingThatIsNotShown) {
  const TwoRooms rooms;
  EXPECT_FALSE(PickInMap(rooms.map, rooms.pyramid, TwoRooms::ClickOn({2.0, 0.0, 9.0})));
  CloudClick click = TwoRooms::ClickOn(rooms.InMap(60, 100));
  click.shown = [](const Eigen::Vector3d&) { return false; };
  EXPECT_FALSE(PickInMap(rooms.map, rooms.pyramid, click));
}

TEST(PickInMapTest, TheDistanceOfPointsOfTwoScansKnowsHowWellTheirPlacesAreKnown) {
  const TwoRooms rooms;
  std::vector<MeasuredPoint> across = {rooms.Picked(rooms.room.InRobot(60, 100)),
                                       rooms.Picked(rooms.InMap(60, 100))};
  std::vector<MeasuredPoint> within = {rooms.Picked(rooms.InMap(60, 60)),
                                       rooms.Picked(rooms.InMap(60, 100))};
  const double expected = (rooms.room.InRobot(60, 100) - rooms.InMap(60, 100)).norm();
  for (auto* points : {&across, &within})
    for (MeasuredPoint& point : *points) point.sigma_m = 0.0;
  const auto measure = [](const std::vector<MeasuredPoint>& points) {
    return Measure(MeasureKind::kDistance, points, std::nullopt, MeasureFrame::kMap).value();
  };
  EXPECT_NEAR(measure(across).value, expected, 1e-6);
  EXPECT_NEAR(measure(across).sigma, 0.002, 1e-6);
  EXPECT_NEAR(measure(within).value, (rooms.InMap(60, 60) - rooms.InMap(60, 100)).norm(), 1e-6);
  EXPECT_NEAR(measure(within).sigma, 0.0, 1e-9) << "the place moves both";
}

TEST(PickInMapTest, AWallIsThePlaneAndFacesWhoMeasuredIt) {
  const TwoRooms rooms;
  const Eigen::Vector3d on_wall = rooms.InMap(60, 100);
  const auto near = ReturnsWithin(rooms.pyramid, on_wall, 0.15);
  ASSERT_GT(near.size(), 30u);
  for (const Eigen::Vector3d& point : near) EXPECT_LE((point - on_wall).norm(), 0.15 + 1e-6);
  const Eigen::Vector3d from = NearestStandpoint(rooms.map, on_wall);
  EXPECT_LT((from - rooms.place * rooms.room.Sensor()).norm(), 1e-9);
  const MeasuredPlane wall = FitMeasuredPlane(near, from).value();
  EXPECT_LT((wall.plane.normal - rooms.place.Rotate(-Eigen::Vector3d::UnitX())).norm(), 1e-3);
}

TEST(PickInMapTest, TheGroundIsThatOfThePointsOwnScan) {
  const TwoRooms rooms;
  for (const auto& [point, floor_m] :
       {std::pair(rooms.Picked(rooms.room.InRobot(70, 100)), FlatRoom::kFloor_m),
        std::pair(rooms.Picked(rooms.InMap(70, 100)), FlatRoom::kFloor_m + 0.5)}) {
    const MeasuredPlane ground = FindGroundInMap(rooms.map, point, {}).value();
    EXPECT_NEAR(ground.centre.z(), floor_m, 0.005);
    const auto height = Measure(MeasureKind::kHeight, {point}, ground, MeasureFrame::kMap).value();
    EXPECT_NEAR(height.value, point.position_m.z() - floor_m, 0.005);
  }
  MeasuredPoint elsewhere;
  elsewhere.scan_uuid = "third";
  EXPECT_FALSE(FindGroundInMap(rooms.map, elsewhere, {}));
}

TEST(PickInMapTest, AMeasurementLiesInTheMapUntilAScanLiesElsewhere) {
  TwoRooms rooms;
  const auto measured = Measure(MeasureKind::kPoint, {rooms.Picked(rooms.InMap(60, 100))},
                                std::nullopt, MeasureFrame::kMap)
                            .value();
  EXPECT_TRUE(LiesInMap(rooms.map, measured));
  rooms.map.scans[1].place.map_from_robot = {rooms.place.rotation(), Eigen::Vector3d(0, 3, 0.6)};
  EXPECT_FALSE(LiesInMap(rooms.map, measured));
  rooms.map.scans.pop_back();
  EXPECT_FALSE(LiesInMap(rooms.map, measured));
}

}  // namespace
}  // namespace foresight
