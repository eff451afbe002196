// Scans of one place from two standpoints come together, and what was moved in between is found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/geometry/angles.h"
#include "core/mapping/scan_changes.h"
#include "core/mapping/scan_map.h"
#include "core/simulation/simulate_scan.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const std::string kRoom = FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml";
/// The second standpoint, 0.5 m and 10 deg from the first.
const Rigid<frame::Map, frame::Robot> kSecond(
    Eigen::Quaterniond(Eigen::AngleAxisd(RadiansFromDegrees(10.0), Eigen::Vector3d::UnitZ())),
    Eigen::Vector3d(0.4, 0.3, 0.0));

struct Taken {
  SensorRig rig;
  RegisteredScan cloud;
};

/// A sweep of the scene by a robot that stands elsewhere than the scene's own.
Taken Take(std::shared_ptr<const Scene> scene, const Rigid<frame::Map, frame::Robot>& standpoint,
           std::uint64_t seed) {
  SensorRig rig = DefaultSensorRig();
  const auto mounted = rig.robot_from_base;
  // To the simulation the standpoint is another mounting of the head.
  rig.robot_from_base =
      Rigid<frame::Robot, frame::Robot>(standpoint.rotation(), standpoint.translation()) * mounted;
  WorldOptions options;
  options.seed = seed;
  const World world(std::move(scene), rig, options);
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(-40.0);
  plan.to_rad = RadiansFromDegrees(40.0);
  plan.speed_rad_s = RadiansFromDegrees(16.0);
  Scan scan = SimulateSweep(world, plan, {}).value();
  scan.rig.robot_from_base = mounted;
  scan.rig.angle_correction = world.CalibratedCorrection();
  return {scan.rig, RegisterScan(scan, {}).value()};
}

/// A first guess that is `shift_m` and `turn_deg` off in a direction of its own.
Rigid<frame::Map, frame::Robot> OffBy(const Rigid<frame::Map, frame::Robot>& pose, double shift_m,
                                      double turn_deg, std::uint64_t seed) {
  Random random(seed);
  const auto direction = [&random] {
    return Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
  };
  const Eigen::AngleAxisd turn(RadiansFromDegrees(turn_deg), direction());
  return {Eigen::Quaterniond(pose.rotation() * turn), pose.translation() + shift_m * direction()};
}

double TurnDeg(const Rigid<frame::Map, frame::Robot>& a, const Rigid<frame::Map, frame::Robot>& b) {
  return DegreesFromRadians(a.rotation().angularDistance(b.rotation()));
}

std::string RoomWithMovedDrill() {
  std::string text = ReadFile(kRoom).value();
  const std::string place = "position_m: [1.32, -0.58, 0.85]";
  const std::size_t at = text.find(place);
  EXPECT_NE(at, std::string::npos) << "the drill of the room stands elsewhere now";
  return text.replace(at, place.size(), "position_m: [1.40, -0.88, 0.85]");
}

class Mapping : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    room_ = std::make_shared<const Scene>(LoadScene(kRoom).value());
    first_ = Take(room_, {}, 11);
    second_ = Take(room_, kSecond, 12);
  }
  static inline std::shared_ptr<const Scene> room_;
  static inline Taken first_;
  static inline Taken second_;
};

TEST_F(Mapping, TwoScansComeTogetherWithin5MillimetresAndATenthOfADegree) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto places = PlaceScans({{first_.cloud, first_.rig, Rigid<frame::Map, frame::Robot>()},
                                    {second_.cloud, second_.rig, OffBy(kSecond, 0.05, 3.0, seed)}},
                                   {}, {})
                            .value();
    ASSERT_TRUE(places[1].InMap()) << places[1].failure;
    EXPECT_LT((places[1].map_from_robot.translation() - kSecond.translation()).norm(), 0.005);
    EXPECT_LT(TurnDeg(places[1].map_from_robot, kSecond), 0.1);
    EXPECT_LT(places[1].alignment->rms_m, 0.01) << "the lidar's noise";
    EXPECT_GT(places[1].alignment->overlap_ratio, 0.7);
    EXPECT_THAT(places[1].alignment->undetermined, IsEmpty());
  }
}

TEST_F(Mapping, AScanOfAnotherPlaceIsLeftOutAndSaysWhy) {
  const auto elsewhere = std::make_shared<const Scene>(
      LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/terrain.yaml").value());
  const Taken other = Take(elsewhere, {}, 13);
  const auto places = PlaceScans({{first_.cloud, first_.rig, std::nullopt},
                                  {other.cloud, other.rig, std::nullopt},
                                  {second_.cloud, second_.rig, std::nullopt}},
                                 {}, {})
                          .value();
  EXPECT_FALSE(places[1].InMap());
  EXPECT_THAT(places[1].failure, HasSubstr("% of the points"));
}

TEST_F(Mapping, AlongABareWallTheShiftIsToldToBeUnknown) {
  Random random(5);
  std::vector<Eigen::Vector3f> wall, other;
  for (auto* cloud : {&wall, &other})
    for (int i = 0; i < 40'000; ++i)
      cloud->emplace_back(static_cast<float>(2.0 + 0.005 * random.Normal()),
                          static_cast<float>(4.0 * random.Uniform() - 2.0),
                          static_cast<float>(2.0 * random.Uniform()));
  const auto alignment = AlignClouds(wall, other, {}, {}, {}).value();
  ASSERT_FALSE(alignment.undetermined.empty());
  EXPECT_THAT(alignment.undetermined.front(), HasSubstr("the shift along"));
  EXPECT_LT(std::abs(alignment.weakest_shift.x()), 0.2) << "across the wall it is known";
}

TEST_F(Mapping, NothingChangedWhereNothingWasMoved) {
  const auto places = PlaceScans({{first_.cloud, first_.rig, Rigid<frame::Map, frame::Robot>()},
                                  {second_.cloud, second_.rig, OffBy(kSecond, 0.04, 2.0, 4)}},
                                 {}, {})
                          .value();
  const ScanChanges changes =
      FindChanges({first_.cloud, places[0].map_from_robot * first_.rig.robot_from_base},
                  {second_.cloud, places[1].map_from_robot * second_.rig.robot_from_base}, {}, {})
          .value();
  EXPECT_THAT(changes.changes, IsEmpty());
  EXPECT_GT(changes.not_seen_before, 1000u) << "from elsewhere other things are seen";
}

TEST_F(Mapping, AMovedDrillIsMarkedAndNothingElse) {
  const auto changed_room =
      std::make_shared<const Scene>(SceneFromYaml(RoomWithMovedDrill(), kRoom).value());
  const Taken later = Take(changed_room, kSecond, 14);
  const auto places = PlaceScans({{first_.cloud, first_.rig, Rigid<frame::Map, frame::Robot>()},
                                  {later.cloud, later.rig, OffBy(kSecond, 0.04, 2.0, 5)}},
                                 {}, {})
                          .value();
  ASSERT_TRUE(places[1].InMap()) << places[1].failure;
  const ScanChanges changes =
      FindChanges({first_.cloud, places[0].map_from_robot * first_.rig.robot_from_base},
                  {later.cloud, places[1].map_from_robot * later.rig.robot_from_base}, {}, {})
          .value();
  ASSERT_EQ(changes.changes.size(), 2u);
  for (const ScanChange& change : changes.changes) {
    const bool gone = change.kind == ScanChange::Kind::kGone;
    const Eigen::Vector3d grip =
        gone ? Eigen::Vector3d(1.32, -0.58, 0.97) : Eigen::Vector3d(1.40, -0.88, 0.97);
    // The box round the drill, which points away from its grip, is centred off it.
    EXPECT_LT((change.centre - grip).norm(), 0.12) << ToString(change.kind);
    EXPECT_LT(change.size_m.maxCoeff(), 0.5);
  }
  EXPECT_NE(changes.changes[0].kind, changes.changes[1].kind);
}

TEST_F(Mapping, OptionsThatMakeNoSenseAreRefusedByName) {
  AlignCloudsOptions align;
  align.voxel_m = 0.0;
  EXPECT_THAT(align.Check().error().message, HasSubstr("voxel_m"));
  ScanChangeOptions change;
  change.min_beams_through = 0;
  EXPECT_THAT(change.Check().error().message, HasSubstr("min_beams_through"));
  EXPECT_EQ(PlaceScans({}, {}, {}).error().code, ErrorCode::kInvalidInput);
}

TEST_F(Mapping, ItStopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto places = PlaceScans(
      {{first_.cloud, first_.rig, std::nullopt}, {second_.cloud, second_.rig, std::nullopt}}, {},
      context);
  ASSERT_FALSE(places);
  EXPECT_EQ(places.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace foresight
