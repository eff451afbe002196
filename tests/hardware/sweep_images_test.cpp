// What becomes of a scan whose camera is in trouble.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/hardware/tiny_head.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// A camera that loses, holds back or refuses what a test says.
class TroubledCamera final : public Camera {
 public:
  explicit TroubledCamera(std::unique_ptr<Camera> camera) : camera_(std::move(camera)) {}

  std::string Describe() const override { return "test camera"; }
  Status Connect() override { return camera_->Connect(); }
  Status Configure(const CameraSettings& settings) override { return camera_->Configure(settings); }
  Result<std::int64_t> Trigger() override {
    ++triggers;
    if (on_trigger) on_trigger();
    if (gone) return Fail(ErrorCode::kDevice, "test camera: does not answer");
    return camera_->Trigger();
  }
  Result<std::optional<CameraFrame>> WaitForFrame(std::chrono::milliseconds timeout) override {
    if (held_ && held_->first == 0) return std::exchange(held_, std::nullopt)->second;
    FORESIGHT_TRY(auto frame, camera_->WaitForFrame(timeout));
    if (!frame) return frame;
    if (lost.contains(frame->seq))
      return Fail(ErrorCode::kDevice, "test camera: image {} did not come", frame->seq);
    if (held_) --held_->first;
    if (late.contains(frame->seq)) {
      held_ = {1, std::move(*frame)};
      return std::nullopt;
    }
    return frame;
  }
  CameraHealth Health() const override {
    CameraHealth health = camera_->Health();
    health.connected = !gone;
    health.suspect = suspicions > 0 && suspicions-- > 0;
    return health;
  }

  std::set<std::int64_t> lost;  ///< reported as such, by seq
  std::set<std::int64_t> late;  ///< come after the next one
  std::atomic<bool> gone{false};
  mutable std::atomic<int> suspicions{0};  ///< how often Health() still calls the camera suspect
  int triggers = 0;
  std::function<void()> on_trigger;

 private:
  std::unique_ptr<Camera> camera_;
  std::optional<std::pair<int, CameraFrame>> held_;
};

struct TroubledHead : TinyHead {
  TroubledHead()
      : TinyHead([this](HeadDevices& devices) {
          auto wrapped = std::make_unique<TroubledCamera>(std::move(devices.camera));
          camera = wrapped.get();
          devices.camera = std::move(wrapped);
        }) {}
  TroubledCamera* camera;
};

ScanPlan ThreeImages() {
  ScanPlan plan = TinyPlan();
  plan.image_angles_rad = {RadiansFromDegrees(-4.0), 0.0, RadiansFromDegrees(4.0)};
  return plan;
}

/// Every image was taken where its target says.
void ExpectImagesAtTheirAngles(const Scan& scan) {
  for (const CameraFrame& frame : scan.frames)
    EXPECT_NEAR(DegreesFromRadians(frame.motor_angle_rad),
                DegreesFromRadians(frame.target_angle_rad), 0.03)
        << "image " << frame.seq;
}

TEST(SweepImages, ALostImageIsTakenAgainStandingStill) {
  TroubledHead tiny;
  tiny.camera->lost = {1};
  ASSERT_TRUE(tiny.Home());
  const auto scan = tiny.Run(ThreeImages());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete);
  EXPECT_EQ(scan->reason, "");
  EXPECT_GE(scan->lines.size(), 40u);
  ASSERT_EQ(scan->frames.size(), 3u);
  ExpectImagesAtTheirAngles(*scan);
  const CameraFrame& again = scan->frames.back();
  EXPECT_NEAR(again.target_angle_rad, 0.0, 1e-9);
  EXPECT_EQ(scan->track.AngleAt(again.time_s - 0.03), scan->track.AngleAt(again.time_s + 0.03));
  EXPECT_TRUE(tiny.AtRest());
}

TEST(SweepImages, AnImageThatNeverComesIsNamedAndTheScanIsComplete) {
  TroubledHead tiny;
  tiny.camera->lost = {1, 3};
  ASSERT_TRUE(tiny.Home());
  const auto scan = tiny.Run(ThreeImages());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete);
  EXPECT_EQ(scan->reason, "the image at 0.00 deg did not come: test camera: image 3 did not come");
  EXPECT_EQ(scan->frames.size(), 2u);
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  EXPECT_EQ(tiny.head->Status().message, scan->reason);
  EXPECT_EQ(tiny.camera->triggers, 4) << "once more, not for ever";
}

TEST(SweepImages, ALateImageOfAnEarlierTriggerFindsItsOwnAngle) {
  TroubledHead tiny;
  tiny.camera->late = {0};
  ASSERT_TRUE(tiny.Home());
  const auto scan = tiny.Run(ThreeImages());
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->frames.size(), 3u);
  EXPECT_EQ(scan->frames[0].seq, 1) << "it came after the next one";
  EXPECT_EQ(scan->frames[1].seq, 0);
  ExpectImagesAtTheirAngles(*scan);
}

TEST(SweepImages, ALateImageOfAnEarlierScanGoesNowhere) {
  TroubledHead tiny;
  tiny.camera->late = {0};
  ASSERT_TRUE(tiny.Home());
  ASSERT_TRUE(tiny.Run(TinyPlan()));  // its image is replaced by one at rest, 1, and comes later
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  const auto second = std::make_shared<ScanAssembler>();
  ASSERT_TRUE(tiny.head->StartScan(ThreeImages(), second));
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  const auto scan = second->Snapshot();
  EXPECT_EQ(scan->reason, "");
  ASSERT_EQ(scan->frames.size(), 3u);
  for (const CameraFrame& frame : scan->frames) EXPECT_GE(frame.seq, 2);
  ExpectImagesAtTheirAngles(*scan);
}

TEST(SweepImages, ACameraThatIsGoneIsAFaultButTheLinesAreComplete) {
  TroubledHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.watch->action = [&] { tiny.camera->gone = true; };
  const auto scan = tiny.Run(ThreeImages());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete);
  EXPECT_EQ(scan->reason,
            "the images at 0.00, 4.00 deg did not come: test camera: does not answer");
  EXPECT_GE(scan->lines.size(), 40u);
  EXPECT_EQ(scan->frames.size(), 1u);
  ASSERT_TRUE(tiny.WaitFor(HeadState::kFault));
  EXPECT_THAT(tiny.head->Status().message, HasSubstr(scan->reason));
  EXPECT_THAT(tiny.head->Status().message, HasSubstr("check the device's power and cable"));
  EXPECT_TRUE(tiny.AtRest());
}

TEST(SweepImages, ACameraThatAnswersAtLastIsNoFault) {
  TroubledHead tiny;
  tiny.camera->lost = {0, 1};
  ASSERT_TRUE(tiny.Home());
  tiny.watch->action = [&] { tiny.camera->suspicions = 20; };
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete);
  EXPECT_THAT(scan->reason, HasSubstr("did not come"));
  EXPECT_TRUE(tiny.WaitFor(HeadState::kReady));
}

TEST(SweepImages, PlannedStandingStillAnImageIsTriedOnceMoreToo) {
  TroubledHead tiny;
  tiny.camera->lost = {0};
  ASSERT_TRUE(tiny.Home());
  ScanPlan plan = TinyPlan();
  plan.image_mode = ScanPlan::ImageMode::kStopAndShoot;
  const auto scan = tiny.Run(plan);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->reason, "");
  EXPECT_EQ(scan->frames.size(), 1u);
}

TEST(SweepImages, AnAbortWhileAnImageIsTakenAgainStopsTheMotor) {
  TroubledHead tiny;
  tiny.camera->lost = {0};
  ASSERT_TRUE(tiny.Home());
  tiny.camera->on_trigger = [&] {
    if (tiny.camera->triggers == 2) tiny.head->AbortScan();
  };
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kAborted);
  EXPECT_GE(scan->lines.size(), 40u);
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  EXPECT_TRUE(tiny.AtRest());
}

}  // namespace
}  // namespace foresight
