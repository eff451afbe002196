#include "core/fitting/handle/fit_handle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "core/base/random.h"
#include "core/fitting/handle/door_things.h"
#include "core/fitting/handle/handle_state.h"
#include "core/fitting/handle/handle_verdict.h"
#include "core/fitting/solids/part_edges.h"
#include "core/geometry/angles.h"
#include "core/simulation/ray_caster.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Robot, frame::Object>;
using LocalPose = Rigid<frame::Object, frame::Object>;

constexpr double kDoor_m = 1.2;  // ahead of the lidar
constexpr double kStandoff_m = 0.055;

/// On a door 1.2 m ahead of a lidar at the origin, x ahead and z up: the frame of a handle whose
/// lever points `turn_rad` from left (y) towards up.
Pose OnDoor(double turn_rad) {
  Eigen::Matrix3d axes;
  axes.col(2) = -Eigen::Vector3d::UnitX();
  axes.col(0) = Eigen::Vector3d(0.0, std::cos(turn_rad), std::sin(turn_rad));
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return Pose(Eigen::Quaterniond(axes), {kDoor_m - kStandoff_m, 0.02, -0.03});
}

void Add(const Shape& shape, const Pose& at, Scene& scene) {
  SceneMesh mesh;
  mesh.robot_from_object = at;
  AppendShape(shape, at, mesh);
  scene.meshes.push_back(std::move(mesh));
}

void AddBar(const Pose& at, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_m,
            Scene& scene) {
  Add(CapsuleShape(radius_m, (to - from).norm()), at * PoseAlong(from, to), scene);
}

void AddRosette(const Pose& at, Scene& scene) {
  Add(CylinderShape(0.026, 0.009),
      at * LocalPose(Eigen::Quaterniond::Identity(), {0.0, 0.0, 0.0045 - kStandoff_m}), scene);
}

std::shared_ptr<Scene> Door() {
  auto scene = std::make_shared<Scene>();
  Add(BoxShape({0.1, 4.0, 4.0}), Pose(Eigen::Quaterniond::Identity(), {kDoor_m + 0.05, 0.0, 0.0}),
      *scene);
  return scene;
}

std::shared_ptr<Scene> DoorWithHandle(const Pose& at, double length_m, double behind_m = 0.0) {
  auto scene = Door();
  AddBar(at, {-behind_m, 0.0, 0.0}, {length_m, 0.0, 0.0}, 0.010, *scene);
  AddBar(at, Eigen::Vector3d::Zero(), {0.0, 0.0, -kStandoff_m}, 0.009, *scene);
  AddRosette(at, *scene);
  return scene;
}

constexpr double kHalf_rad = 0.12;

/// Beams 0.25 deg apart on lines 0.4 deg apart, about 0.14 m round the middle of the view and
/// `aside_rad` to each side; each reads the mean of nine rays over its footprint, so that edges are
/// mixed as a lidar's are.
RaySet RaysOf(const std::shared_ptr<const Scene>& scene, double sigma_m, std::uint64_t seed,
              double aside_rad = kHalf_rad) {
  constexpr double kBeam_rad = 0.00436, kLine_rad = 0.007;
  constexpr double kHeight_rad = 0.012, kWidth_rad = 0.005;
  const RayCaster caster(scene);
  Random random(seed);
  RaySet set;
  set.sigma_m = sigma_m;
  set.footprint_rad = kBeam_rad;
  set.footprint_height_rad = kHeight_rad;
  const auto direction = [](double up, double aside) {
    return Eigen::Vector3d(std::cos(up) * std::cos(aside), std::cos(up) * std::sin(aside),
                           std::sin(up));
  };
  int line = 0;
  for (double up = -kHalf_rad; up < kHalf_rad; up += kLine_rad, ++line) {
    int beam = 0;
    for (double aside = -aside_rad; aside < aside_rad; aside += kBeam_rad, ++beam) {
      double sum_m = 0.0;
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
          sum_m += caster
                       .Cast({Eigen::Vector3f::Zero(),
                              direction(up + i * kHeight_rad / 3.0, aside + j * kWidth_rad / 3.0)
                                  .cast<float>()})
                       .distance_m;
      set.rays.push_back({Eigen::Vector3d::Zero(),
                          direction(up, aside),
                          sum_m / 9.0 + sigma_m * random.Normal(),
                          {beam, line}});
    }
  }
  return set;
}

/// Of the lever's direction, against the true frame.
double TurnError_deg(const HandleDetection& found, const Pose& truth) {
  const Eigen::Vector3d x = found.best.base_from_object.Rotate(Eigen::Vector3d::UnitX());
  return DegreesFromRadians(
      std::acos(std::clamp(x.dot(truth.Rotate(Eigen::Vector3d::UnitX())), -1.0, 1.0)));
}

double PivotError_m(const HandleDetection& found, const Pose& truth) {
  return (found.best.base_from_object.translation() - truth.translation()).norm();
}

TEST(FitHandle, FindsPivotDirectionLengthAndDoorOfALeverThatPointsEitherWay) {
  for (const double turn : {0.0, std::numbers::pi, 0.5}) {
    const Pose truth = OnDoor(turn);
    const auto found = FitHandle(RaysOf(DoorWithHandle(truth, 0.125), 0.004, 3), {}, {});
    ASSERT_TRUE(found) << found.error().message;
    // Beams are 5 mm apart along a line and lines 8 mm; the ranges' noise is 4 mm.
    EXPECT_LT(PivotError_m(*found, truth), 0.015) << turn;
    EXPECT_LT(TurnError_deg(*found, truth), 5.0) << turn;
    EXPECT_NEAR(found->best.model.length_m, 0.125, 0.015) << turn;
    EXPECT_LT(found->door.normal.dot(Eigen::Vector3d::UnitX()), -0.999);
    // By beams alone a lever that goes on behind its pivot does nearly as well the other way round.
    EXPECT_GT(found->evidence.mirror_margin_nats, 0.5) << turn;
    const auto points_the_other_way = [&](const HandleCandidate& alternative) {
      return alternative.base_from_object.Rotate(Eigen::Vector3d::UnitX())
                 .dot(truth.Rotate(Eigen::Vector3d::UnitX())) < 0.0;
    };
    EXPECT_EQ(found->alternatives.size(), 3u) << "turned round, shorter, longer";
    EXPECT_EQ(
        std::count_if(found->alternatives.begin(), found->alternatives.end(), points_the_other_way),
        1);
  }
}

TEST(FitHandle, FindsThePivotOfMostLeversThatGoOnBehindIt) {
  // Seen from the front only the rosette tells where on the bar the pivot is.
  const Pose truth = OnDoor(0.0);
  constexpr int kSeeds = 10;
  int right = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto found = FitHandle(RaysOf(DoorWithHandle(truth, 0.110, 0.045), 0.004, seed), {}, {});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_LT(TurnError_deg(*found, truth), 5.0);
    EXPECT_GT(found->evidence.alternative_margin_nats, 0.0);
    // A lever that ended at its pivot would have it 45 mm further back.
    right += PivotError_m(*found, truth) < 0.015 &&
             std::abs(found->best.model.length_m - 0.110) < 0.015 &&
             std::abs(found->best.model.behind_m - 0.045) < 0.015;
  }
  EXPECT_GE(right, 6) << "of " << kSeeds;
}

TEST(FitHandle, FindsThePivotOfABowedLever) {
  const Pose truth = OnDoor(0.0);
  constexpr double kLength_m = 0.130, kBow_m = 0.014, kLift_m = 0.010;
  constexpr int kPieces = 10;
  const auto at = [&](int i) {
    const double s = static_cast<double>(i) / kPieces, off = 4.0 * s * (1.0 - s);
    return Eigen::Vector3d(s * kLength_m, off * kBow_m, off * kLift_m);
  };
  auto scene = Door();
  for (int i = 0; i < kPieces; ++i) AddBar(truth, at(i), at(i + 1), 0.009, *scene);
  AddBar(truth, Eigen::Vector3d::Zero(), {0.0, 0.0, -kStandoff_m}, 0.008, *scene);
  AddRosette(truth, *scene);
  double across_m = 0.0;
  constexpr int kTries = 3;
  for (int i = 0; i < kTries; ++i) {
    const auto found = FitHandle(RaysOf(scene, 0.004, 30 + static_cast<std::uint64_t>(i)), {}, {});
    ASSERT_TRUE(found) << found.error().message;
    const Eigen::Vector3d pivot = truth.Inverse() * Pose(found->best.base_from_object.rotation(),
                                                         found->best.base_from_object.translation())
                                                        .translation();
    EXPECT_LT(pivot.norm(), 0.015);
    EXPECT_NEAR(found->best.model.bow_m, kBow_m, 0.007);
    across_m += pivot.y() / kTries;
  }
  // A straight lever would lie two thirds of the bow beside it.
  EXPECT_NEAR(across_m, 0.0, 0.004);
}

TEST(FitHandle, ABareDoorIsNoHandle) {
  const auto found = FitHandle(RaysOf(Door(), 0.008, 5), {}, {});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kNoConvergence);
}

TEST(FitHandle, AKnobALightSwitchAndAPullBarAreNotLikely) {
  const Pose at = OnDoor(0.0);
  auto knob = Door();
  Add(SphereShape(0.028), at, *knob);
  AddBar(at, Eigen::Vector3d::Zero(), {0.0, 0.0, -kStandoff_m}, 0.010, *knob);
  AddRosette(at, *knob);
  auto light_switch = Door();
  Add(BoxShape({0.08, 0.08, 0.05}),
      at * LocalPose(Eigen::Quaterniond::Identity(), {0.0, 0.0, 0.025 - kStandoff_m}),
      *light_switch);
  auto pull_bar = Door();
  const Eigen::Vector3d end(0.08, 0.0, 0.0), down(0.0, 0.0, -kStandoff_m);
  AddBar(at, -end, end, 0.010, *pull_bar);
  AddBar(at, end, end + down, 0.010, *pull_bar);
  AddBar(at, -end, -end + down, 0.010, *pull_bar);
  auto on_rosettes = Door();
  AddBar(at, -end, end, 0.010, *on_rosettes);
  for (const Eigen::Vector3d& post : {Eigen::Vector3d(0.6 * end), Eigen::Vector3d(-0.6 * end)}) {
    AddBar(at, post, post + down, 0.010, *on_rosettes);
    AddRosette(at * LocalPose(Eigen::Quaterniond::Identity(), post), *on_rosettes);
  }
  int fitted = 0;
  for (const auto& scene : {knob, light_switch, pull_bar, on_rosettes}) {
    const auto found = FitHandle(RaysOf(scene, 0.008, 7), {}, {});
    if (!found) continue;
    ++fitted;
    EXPECT_EQ(found->verdict.level, VerdictLevel::kUnsure)
        << found->evidence.best_alternative << " " << found->evidence.alternative_margin_nats << " "
        << found->evidence.mirror_margin_nats << " " << found->verdict.probability << ": "
        << found->verdict.reason;
    EXPECT_FALSE(found->verdict.reason.empty());
  }
  EXPECT_GE(fitted, 3);
}

TEST(FitHandle, ABowWithALockBesideItIsTakenForABow) {
  const Pose at = OnDoor(0.0);
  constexpr double kHalf_m = 0.095, kOut_m = 0.050;
  constexpr int kPieces = 16;
  const auto rod = [&](int i) {
    const double angle = std::numbers::pi * i / kPieces;
    return Eigen::Vector3d(kHalf_m * std::cos(angle), 0.0,
                           kOut_m * std::sqrt(std::max(0.0, std::sin(angle))) - kStandoff_m);
  };
  auto scene = Door();
  for (int i = 0; i < kPieces; ++i) AddBar(at, rod(i), rod(i + 1), 0.007, *scene);
  // Stands out, so that what lies before the door reaches as far as that.
  AddBar(at, {-0.12, -0.10, -kStandoff_m}, {-0.12, -0.10, -0.02}, 0.020, *scene);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto found = FitHandle(RaysOf(scene, 0.006, seed), {}, {});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->evidence.best_alternative, "bow") << seed;
    EXPECT_LT(found->evidence.alternative_margin_nats, 0.0) << seed;
    EXPECT_EQ(found->verdict.level, VerdictLevel::kUnsure) << seed << found->verdict.reason;
  }
}

TEST(FitHandle, OfABarThatLooksTheSameEitherWayTheDoorsEdgeSaysWhichWayItPoints) {
  constexpr double kEnd_m = 0.06;
  for (const double side : {-1.0, 1.0}) {  // of the frame, which stands 20 mm before the leaf
    auto scene = Door();
    const Pose middle = OnDoor(0.0);
    AddBar(middle, {-kEnd_m, 0.0, 0.0}, {kEnd_m, 0.0, 0.0}, 0.010, *scene);
    Add(BoxShape({0.1, 1.0, 4.0}),
        Pose(Eigen::Quaterniond::Identity(), {kDoor_m + 0.03, 0.02 + side * 0.63, 0.0}), *scene);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      RaySet rays = RaysOf(scene, 0.012, seed);
      rays.around = std::make_shared<const RaySet>(RaysOf(scene, 0.012, seed, 0.4));
      const auto found = FitHandle(rays, {}, {});
      ASSERT_TRUE(found) << found.error().message;
      const Eigen::Vector3d lever = found->best.base_from_object.Rotate(Eigen::Vector3d::UnitX());
      EXPECT_LT(side * lever.y(), -0.9) << "seed " << seed;
      EXPECT_GT(found->evidence.edges_nats, 3.0);
    }
  }
}

TEST(FitHandle, ALeverThatTheNearestEdgeSpeaksAgainstIsNotConfirmed) {
  const RaySet rays = RaysOf(DoorWithHandle(OnDoor(0.0), 0.125), 0.004, 3);
  auto found = FitHandle(rays, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  const auto objects = [&](double edges_nats) {
    found->evidence.edges_nats = edges_nats;
    const auto gates = AssessHandle(rays, *found, {}, 0.0).failed_gates;
    return std::any_of(gates.begin(), gates.end(), [](const std::string& gate) {
      return gate.find("by where the door ends") != std::string::npos;
    });
  };
  EXPECT_TRUE(objects(-4.0));
  EXPECT_FALSE(objects(0.0));  // no edge was found
  EXPECT_FALSE(objects(4.0));
}

TEST(FitHandle, OfTwentyLeversAtUsualNoiseMostAreRight) {
  // Lengths 95 to 155 mm, noise 4 to 14 mm, any direction.
  constexpr int kSeeds = 20;
  int right = 0, likely = 0, likely_wrong = 0;
  for (std::uint64_t seed = 101; seed <= 100 + kSeeds; ++seed) {
    Random random(seed, 77);
    const double length_m = random.Uniform(0.095, 0.155), sigma_m = random.Uniform(0.004, 0.014);
    const Pose truth = OnDoor(random.Uniform(-std::numbers::pi, std::numbers::pi));
    const auto scene = DoorWithHandle(truth, length_m);
    RaySet rays = RaysOf(scene, sigma_m, seed);
    rays.around = std::make_shared<const RaySet>(RaysOf(scene, sigma_m, seed, 0.4));
    const auto found = FitHandle(rays, {}, {});
    if (!found) continue;
    const bool is_right = PivotError_m(*found, truth) < 0.020 && TurnError_deg(*found, truth) < 8.0;
    right += is_right;
    const bool is_likely = found->verdict.level != VerdictLevel::kUnsure;
    likely += is_likely;
    likely_wrong += is_likely && !is_right;
  }
  EXPECT_GE(right, 18) << "of " << kSeeds;
  EXPECT_EQ(likely_wrong, 0) << "of " << likely;
  // From the front only the rosette tells the pivot's end: the odds reach 22000 : 1 for about half.
  EXPECT_GE(likely, kSeeds / 3);
}

TEST(FitHandle, TheSameSeedGivesTheSameAnswer) {
  const RaySet rays = RaysOf(DoorWithHandle(OnDoor(0.0), 0.11), 0.010, 9);
  const auto once = FitHandle(rays, {}, {}), again = FitHandle(rays, {}, {});
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->best.base_from_object.translation(), again->best.base_from_object.translation());
  EXPECT_EQ(once->best.model.length_m, again->best.model.length_m);
}

TEST(FitHandle, RefusesTooFewRaysOptionsThatAreNoneAndACancelledOne) {
  const RaySet rays = RaysOf(DoorWithHandle(OnDoor(0.0), 0.11), 0.010, 9);
  FitHandleOptions options;
  options.min_length_m = 0.5;
  EXPECT_EQ(FitHandle(rays, options, {}).error().code, ErrorCode::kInvalidOptions);
  std::stop_source stop;
  stop.request_stop();
  RunContext cancelled;
  cancelled.stop = stop.get_token();
  EXPECT_EQ(FitHandle(rays, {}, cancelled).error().code, ErrorCode::kCancelled);
  EXPECT_EQ(FitHandle(RaySet(), {}, {}).error().code, ErrorCode::kTooFewPoints);
}

TEST(FitHandle, TheLeverThatPointsTheOtherWayIsOnTheSameBarWhereAnotherBarIsNear) {
  const Pose truth = OnDoor(0.0);
  auto scene = DoorWithHandle(truth, 0.110);
  // A shorter rod over it, a little nearer.
  AddBar(truth, {0.090, 0.085, 0.01}, {0.010, 0.085, 0.01}, 0.008, *scene);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto found = FitHandle(RaysOf(scene, 0.006, seed), {}, {});
    ASSERT_TRUE(found) << found.error().message;
    const auto way = [](const HandleCandidate& lever) {
      return lever.base_from_object.Rotate(Eigen::Vector3d::UnitX());
    };
    const HandleCandidate& best = found->best;
    const Eigen::Vector3d end =
        best.base_from_object * Eigen::Vector3d(best.model.length_m, 0.0, 0.0);
    const auto turned =
        std::find_if(found->alternatives.begin(), found->alternatives.end(),
                     [&](const HandleCandidate& other) { return way(other).dot(way(best)) < 0.0; });
    ASSERT_NE(turned, found->alternatives.end());
    EXPECT_LT((turned->base_from_object.translation() - end).norm(), 0.045) << seed;
  }
}

TEST(FitHandle, LengthsThatNoOtherThingHasAreNoFault) {
  const RaySet rays = RaysOf(DoorWithHandle(OnDoor(0.0), 0.11), 0.006, 2);
  FitHandleOptions options;
  options.min_length_m = 0.42;
  options.max_length_m = 0.60;
  const auto found = FitHandle(rays, options, {});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->verdict.level, VerdictLevel::kUnsure) << found->verdict.reason;
}

TEST(DoorThing, APlateLiesWhereItIsPutAndIsTurned) {
  const double turn = 0.5, half_long = 0.10, half_wide = 0.02;
  const Rigid<frame::Base, frame::Object> pose(Eigen::Quaterniond::Identity(), {0.3, 0.0, 0.0});
  const DoorThing thing(
      {},
      {{.front_m = 0.01, .at = {0.05, -0.02}, .turn_rad = turn, .half_m = {half_wide, half_long}}},
      pose);
  const auto clearance = [&](double along_m, double beside_m) {
    const Eigen::Vector2d own_x(std::cos(turn), std::sin(turn)), own_y(-own_x.y(), own_x.x());
    const Eigen::Vector2d at = Eigen::Vector2d(0.35, -0.02) + along_m * own_y + beside_m * own_x;
    const RangeRay ray{.origin = {at.x(), at.y(), 1.0}, .direction = {0.0, 0.0, -1.0}};
    const auto passed = thing.Intersect(ray, 1.0);
    EXPECT_TRUE(passed);
    return passed ? passed->clearance_m : 0.0;
  };
  EXPECT_NEAR(clearance(0.0, 0.0), -half_wide, 1e-9);
  EXPECT_NEAR(clearance(half_long + 0.03, 0.0), 0.03, 1e-9);
  EXPECT_NEAR(clearance(0.0, -half_wide - 0.01), 0.01, 1e-9);
  const auto parts = thing.Parts();
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_LT(parts[0].Distance({0.05 - 0.09 * std::sin(turn), -0.02 + 0.09 * std::cos(turn), 0.005}),
            0.0);
  EXPECT_GT(parts[0].Distance({0.05 + 0.09 * std::sin(turn), -0.02 + 0.09 * std::cos(turn), 0.005}),
            0.0);
}

TEST(DoorThing, ABarThatGoesOnAsTheNextIsOutlinedAlongItsSidesAlone) {
  const auto parts = DoorThing({{{0.0, 0.0, 0.0}, {0.05, 0.002, 0.0}, 0.01},
                                {{0.05, 0.002, 0.0}, {0.10, 0.0, 0.0}, 0.01},
                                {{0.10, 0.0, 0.0}, {0.10, 0.0, -0.04}, 0.01}},
                               {}, {})
                         .Parts();
  using Ends = std::array<bool, 2>;
  EXPECT_EQ(parts[0].joined, (Ends{false, true}));
  EXPECT_EQ(parts[1].joined, (Ends{true, false})) << "a return is a corner";
  EXPECT_EQ(parts[2].joined, (Ends{false, false}));
  const Eigen::Vector3d eye(0.0, 0.5, 0.0);
  SolidPart free = parts[0];
  free.joined = {false, false};
  const auto open = EdgesSeenFrom(free, eye), joined = EdgesSeenFrom(parts[0], eye);
  EXPECT_LT(joined.size(), open.size());
  for (const PartEdge& edge : joined)
    EXPECT_LE(std::max(edge.from.z(), edge.to.z()), 0.5 * free.size_m.z() + 1e-9);
}

TEST(HandleState, APivotFurtherAlongABowedLeverIsOnTheSameBar) {
  HandleState lever;
  lever.values << 0.02, -0.01, 0.4, 0.05, 0.130, 0.0, 0.014, 0.006, 0.009;
  const DoorFrame base_from_door;
  const HandleModel before = lever.Model();
  const auto pose = lever.Pose(base_from_door);
  const HandleState moved = WithPivotAlong(lever, 0.040);
  const Eigen::Vector3d pivot = pose.Inverse() * moved.Pose(base_from_door).translation();
  // On the old bar, and so are the new bar's middle and its end but for the lift: levers lie level.
  EXPECT_NEAR(before.Distance(pivot), -before.radius_m, 0.001);
  const auto on_old = [&](double along_m, double bow, double lift) {
    return pose.Inverse() * (moved.Pose(base_from_door) * Eigen::Vector3d(along_m, bow, lift));
  };
  const HandleModel after = moved.Model();
  EXPECT_NEAR(before.Distance(on_old(0.5 * after.length_m, after.bow_m, after.lift_m)),
              -before.radius_m, 0.004);
  EXPECT_NEAR(before.Distance(on_old(after.length_m, 0.0, 0.0)), -before.radius_m, 0.005);
}

TEST(BeamLikelihood, AFootprintOnBarAndDoorReadsARangeInBetween) {
  RaySet rays;
  rays.sigma_m = 0.005;
  rays.footprint_rad = 0.010;
  rays.rays.push_back({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), 1.18});
  const Plane door{-Eigen::Vector3d::UnitX(), -kDoor_m};
  BeamOptions options;
  options.early_return = 0.0;
  options.mixed_ranges = true;
  const BeamLikelihood likelihood(rays, {&door, 1}, options);
  // A bar across the beam whose edge runs through the beam's middle.
  const DoorThing bar({{{0.0, -0.1, 0.0}, {0.0, 0.1, 0.0}, 0.010}}, {},
                      {Eigen::Quaterniond::Identity(), {1.15, 0.0, 0.010}});
  const auto expected = likelihood.Expect(0, CoverBy(bar));
  ASSERT_TRUE(expected);
  EXPECT_NEAR(expected->fraction, 0.5, 0.02);
  EXPECT_TRUE(expected->mixed);
  EXPECT_NEAR(expected->range_m, 0.5 * (expected->object_m + kDoor_m), 0.002);
}

TEST(BeamLikelihood, ARayThatWentThroughSpeaksAgainstTheObject) {
  RaySet rays;
  rays.rays.push_back({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), kDoor_m});
  const Plane door{-Eigen::Vector3d::UnitX(), -kDoor_m};
  const BeamLikelihood likelihood(rays, {&door, 1});
  const DoorThing ball({{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.03}}, {},
                       {Eigen::Quaterniond::Identity(), {1.1, 0.0, 0.0}});
  EXPECT_LT(LogLikelihoodOf(ball, likelihood), likelihood.Nothing() - 1.0);
  const DoorThing aside({{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.03}}, {},
                        {Eigen::Quaterniond::Identity(), {1.1, 0.2, 0.0}});
  EXPECT_EQ(LogLikelihoodOf(aside, likelihood), likelihood.Nothing());
}

}  // namespace
}  // namespace foresight
