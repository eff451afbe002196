// Images of one scan against each other, and its ways up and down.
#include "core/selfcheck/turn_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/evaluation/check_trial.h"
#include "core/geometry/angles.h"
#include "core/selfcheck/pass_check.h"

namespace foresight {
namespace {

using testing::HasSubstr;

CheckTrial TrialInRoom(const CheckTrialOptions& options) {
  auto scene = LoadScene(std::string(FORESIGHT_SOURCE_DIR) + "/resources/scenes/room.yaml");
  EXPECT_TRUE(scene) << scene.error().message;
  auto trial = MakeCheckTrial(std::make_shared<const Scene>(std::move(*scene)), 4, options, {});
  EXPECT_TRUE(trial) << trial.error().message;
  return std::move(*trial);
}

const CheckTrial& RoomTrial() {
  static const CheckTrial kTrial = TrialInRoom({});
  return kTrial;
}

Result<TurnCheck> Checked(const Scan& scan, const TurnCheckOptions& options = {}) {
  auto cloud = RegisterScan(scan, {});
  EXPECT_TRUE(cloud) << cloud.error().message;
  return CheckTurns(scan, *cloud, options, {});
}

Scan WithImages(std::initializer_list<int> images) {
  Scan scan = RoomTrial().scan;
  scan.frames = {};
  for (const int image : images) scan.frames.push_back(RoomTrial().scan.frames.begin()[image]);
  return scan;
}

TEST(CheckTurns, FollowsARoomFromImageToImage) {
  const auto check = Checked(RoomTrial().scan);
  ASSERT_TRUE(check) << check.error().message;
  EXPECT_EQ(check->images, 3);
  EXPECT_TRUE(check->bend_seen);
  EXPECT_NEAR(check->spread_rad, RadiansFromDegrees(30.0), RadiansFromDegrees(0.5));
  EXPECT_GT(check->points, 1000);
  EXPECT_GT(check->explained, 0.9);
  // The rig is 0.05 deg and 1 mm off, the motor 0.03 deg between two images.
  EXPECT_LT(std::abs(check->drift[TurnCheck::kCameraY]), RadiansFromDegrees(0.06));
  EXPECT_LT(std::abs(check->drift[TurnCheck::kCameraZ]), RadiansFromDegrees(0.06));
  EXPECT_LT(std::abs(check->drift[TurnCheck::kScale]), 0.003);
  EXPECT_LT(std::abs(check->drift[TurnCheck::kBend]), RadiansFromDegrees(0.06));
}

TEST(CheckTurns, TwoImagesSayNothingOfTheBend) {
  const auto check = Checked(WithImages({0, 2}));
  ASSERT_TRUE(check) << check.error().message;
  EXPECT_FALSE(check->bend_seen);
  EXPECT_EQ(check->drift[TurnCheck::kBend], 0.0);
  EXPECT_EQ(check->Sigma(TurnCheck::kBend), std::numeric_limits<double>::infinity());
  EXPECT_LT(check->Sigma(TurnCheck::kCameraZ), RadiansFromDegrees(0.05));
}

TEST(CheckTurns, OneImageAsksForThree) {
  const auto check = Checked(WithImages({1}));
  ASSERT_FALSE(check);
  EXPECT_EQ(check.error().code, ErrorCode::kTooFewPoints);
  EXPECT_THAT(check.error().message, HasSubstr("take three"));
}

TEST(CheckTurns, ImagesWithoutAPatternSayNothing) {
  Scan scan = WithImages({0, 1, 2});
  std::vector<CameraFrame> frames(scan.frames.begin(), scan.frames.end());
  scan.frames = {};
  for (CameraFrame& frame : frames) {
    for (Rgb8& pixel : frame.image.values()) pixel = {90, 90, 90};
    scan.frames.push_back(frame);
  }
  const auto check = Checked(scan);
  ASSERT_FALSE(check);
  EXPECT_THAT(check.error().message, HasSubstr("scan where surfaces have a pattern"));
}

TEST(CheckTurns, CanBeCancelled) {
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto cloud = RegisterScan(RoomTrial().scan, {});
  ASSERT_TRUE(cloud);
  const auto check = CheckTurns(RoomTrial().scan, *cloud, {}, context);
  ASSERT_FALSE(check);
  EXPECT_EQ(check.error().code, ErrorCode::kCancelled);
}

TEST(CheckPasses, SeesAnOffsetOfTheStampsToATenthOfAMillisecond) {
  CheckTrialOptions one_image;  // images take longer than the lines, and are not asked
  one_image.plan.image_angles_rad = {0.0};
  Scan scan = TrialInRoom(one_image).scan;
  const auto seen = [&] {
    const auto cloud = RegisterScan(scan, {});
    EXPECT_TRUE(cloud) << cloud.error().message;
    const auto check = CheckPasses(scan, *cloud, {});
    EXPECT_TRUE(check) << check.error().message;
    return check.value_or(PassCheck());
  };
  const PassCheck good = seen();
  // The motor's backlash of 0.03 deg between the ways is 0.75 ms at 20 deg/s.
  EXPECT_NEAR(good.stamp_s, -0.00075, 0.0003);
  EXPECT_LT(good.sigma_s, 0.0003);
  EXPECT_GT(good.patches, 1000);
  scan.rig.lidar.stamp_offset_s -= 0.004;
  EXPECT_NEAR(seen().stamp_s - good.stamp_s, 0.004, 0.0004);
}

TEST(CheckPasses, ASweepOneWayAsksForOneThereAndBack) {
  CheckTrialOptions options;
  options.plan.passes = 1;
  options.plan.to_rad = options.plan.from_rad + 0.1;
  options.plan.image_angles_rad = {options.plan.from_rad};
  const auto trial = MakeCheckTrial(nullptr, 3, options, {});
  ASSERT_TRUE(trial) << trial.error().message;
  const auto cloud = RegisterScan(trial->scan, {});
  ASSERT_TRUE(cloud);
  const auto check = CheckPasses(trial->scan, *cloud, {});
  ASSERT_FALSE(check);
  EXPECT_THAT(check.error().message, HasSubstr("there and back"));
}

}  // namespace
}  // namespace foresight
