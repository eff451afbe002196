// What is on the doors of HandlePopulation is what it is said to be, by its shape.
#include "core/evaluation/handle_population.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <string>

#include "core/evaluation/door_hardware.h"
#include "core/simulation/scene_objects.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

constexpr int kDrawnLevers = 60;

using LocalPose = Rigid<frame::Object, frame::Object>;

/// Our own handle, which was drawn by other code; the door is z = 0.
DoorHardware HardwareOf(const HandleModel& model) {
  HandleObject handle;
  handle.model = model;
  handle.robot_from_object = {Eigen::Quaterniond::Identity(), {0.0, 0.0, model.standoff_m}};
  Scene scene;
  AddHandle(handle, scene);
  DoorHardware hardware;
  hardware.parts = scene.meshes;
  return hardware;
}

DoorHardware BarOnPosts(double length_m, std::initializer_list<double> posts) {
  constexpr double kOut_m = 0.05;
  SceneMesh mesh;
  const auto bar = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    AppendShape(CapsuleShape(0.01, (to - from).norm()),
                Rigid<frame::Robot, frame::Object>() * PoseAlong(from, to), mesh);
  };
  bar({0.0, 0.0, kOut_m}, {length_m, 0.0, kOut_m});
  for (const double x : posts) bar({x, 0.0, 0.0}, {x, 0.0, kOut_m});
  DoorHardware hardware;
  hardware.parts = {mesh};
  return hardware;
}

TEST(DoorThings, OurOwnHandlesAreLeversWithEitherEndAndPlate) {
  for (const bool returned : {false, true})
    for (const auto plate : {HandleModel::Plate::kRosette, HandleModel::Plate::kLong}) {
      HandleModel model;
      model.returned = returned;
      model.plate = plate;
      const DoorThingMeasures measures = MeasureDoorThing(HardwareOf(model));
      EXPECT_TRUE(measures.IsLeverHandle()) << returned << " " << ToString(plate);
      // From the round end at the pivot, half of it beyond the axis, to the other round end.
      EXPECT_NEAR(measures.length_m, model.length_m + 2.0 * model.radius_m, 0.012);
      EXPECT_NEAR(measures.height_m, model.standoff_m + model.radius_m, 0.002);
    }
}

TEST(DoorThings, ALeverMayGoOnBehindItsPivotForLessThanHalfOfItself) {
  HandleModel model;
  model.length_m = 0.100;
  model.behind_m = 0.050;
  EXPECT_TRUE(MeasureDoorThing(HardwareOf(model)).IsLeverHandle());
  model.behind_m = model.length_m;
  EXPECT_FALSE(MeasureDoorThing(HardwareOf(model)).IsLeverHandle()) << "a bar on a post";
}

TEST(DoorThings, ABarIsALeverByWhereItsPostsAreAndNotByItsName) {
  EXPECT_TRUE(MeasureDoorThing(BarOnPosts(0.13, {0.0})).IsLeverHandle());
  EXPECT_FALSE(MeasureDoorThing(BarOnPosts(0.13, {0.0, 0.13})).IsLeverHandle()) << "a pull bar";
  EXPECT_FALSE(MeasureDoorThing(BarOnPosts(0.13, {0.065})).IsLeverHandle()) << "a T";
  EXPECT_FALSE(MeasureDoorThing(BarOnPosts(0.04, {0.0})).IsLeverHandle()) << "a thumb turn";
  EXPECT_FALSE(MeasureDoorThing(BarOnPosts(0.13, {})).IsLeverHandle()) << "nothing carries it";
}

TEST(DoorThings, APlateUnderTheWholeLeverDoesNotCarryIt) {
  DoorHardware lever = BarOnPosts(0.13, {0.0});
  SceneMesh plate;
  AppendShape(BoxShape({0.20, 0.04, 0.012}), {Eigen::Quaterniond::Identity(), {0.06, 0.0, 0.006}},
              plate);
  lever.parts.push_back(plate);
  EXPECT_TRUE(MeasureDoorThing(lever).IsLeverHandle());
}

TEST(HandlePopulation, NearlyAllThatAreDrawnAsLeversAreByTheirShape) {
  // Of those that go on behind their pivot for half of their length some are bars on a post.
  int levers = 0;
  for (std::uint64_t seed = 1; seed <= kDrawnLevers; ++seed) {
    Random random(seed);
    levers += MeasureDoorThing(DrawLever(random, {}, {})).IsLeverHandle() ? 1 : 0;
  }
  EXPECT_GE(levers, kDrawnLevers - 2);
}

TEST(HandlePopulation, ShowsLeversToBothSidesAndEveryOtherThing) {
  std::set<std::string> drawn;
  int right = 0, left = 0, negatives = 0;
  constexpr int kScenes = 300;
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    const FitTrialScene scene = HandlePopulation().MakeScene(seed);
    drawn.insert(scene.what);
    ASSERT_EQ(scene.positive, scene.scene->handles.size() == 1u) << scene.what;
    negatives += scene.positive ? 0 : 1;
    if (!scene.positive) continue;
    const double y =
        scene.scene->handles.front().robot_from_object.Rotate(Eigen::Vector3d::UnitX()).y();
    (y > 0.0 ? left : right) += 1;
  }
  EXPECT_NEAR(negatives, kScenes / 6, 25);
  EXPECT_GT(right, kScenes / 4);
  EXPECT_GT(left, kScenes / 4);
  for (const char* name : {"a bare door", "a knob", "a pull bar", "a bar on a post", "a cable",
                           "a bracket", "a switch box", "a pipe"})
    EXPECT_TRUE(drawn.contains(name)) << name;
}

// Beams take rosette and lock for a long plate. The image, which shows none, then spoke for the
// lever that points the other way.
TEST(HandlePopulation, ALockBelowARosetteTurnsNoLeverRound) {
  for (const std::uint64_t seed : {49u, 284u}) {
    const auto outcomes = RunFitTrial(HandlePopulation(), seed, {}, {});
    ASSERT_TRUE(outcomes) << outcomes.error().message;
    EXPECT_TRUE(outcomes->front().all_ok) << seed << ": " << outcomes->front().reason;
  }
}

class Judged : public testing::Test {
 protected:
  Judged() {
    std::uint64_t seed = 1;
    while (!HandlePopulation().MakeScene(seed).positive) ++seed;
    trial_ = MakeFitTrial(HandlePopulation(), seed, {}, {}).value();
    const HandleTruth& truth = trial_->scene.scene->handles.front();
    found_.best.base_from_object = trial_->TrueBaseFromRobot() * truth.robot_from_object;
    found_.best.model = truth.model;
    found_.covariance = PoseCovariance::Identity();
  }
  FitOutcome Judge() const { return HandlePopulation().Judge(*trial_, Detection(found_)).front(); }
  void Move(const LocalPose& pose) {
    found_.best.base_from_object = found_.best.base_from_object * pose;
  }

  std::optional<FitTrial> trial_;
  HandleDetection found_;
};

TEST_F(Judged, TheTruthIsRightInEveryRespect) {
  EXPECT_TRUE(Judge().pose_ok && Judge().all_ok);
}

TEST_F(Judged, ALeverThatPointsTheOtherWayIsWrongAndAFlip) {
  Move({Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ())),
        {found_.best.model.length_m, 0.0, 0.0}});
  EXPECT_FALSE(Judge().pose_ok);
  for (const auto& [name, error] : Judge().errors)
    if (name == "flip") {
      EXPECT_EQ(error, 1.0);
    }
}

TEST_F(Judged, ALengthThatIsOffBy25MillimetresIsNotRightInEveryRespect) {
  found_.best.model.length_m += 0.025;
  EXPECT_TRUE(Judge().pose_ok);
  EXPECT_FALSE(Judge().all_ok);
}

TEST_F(Judged, APivotThatIsOffBy17MillimetresIsRightWhereItCountsOnly) {
  Move({Eigen::Quaterniond::Identity(), {0.017, 0.0, 0.0}});
  EXPECT_TRUE(Judge().pose_ok);
  EXPECT_FALSE(Judge().all_ok);
}

}  // namespace
}  // namespace foresight
