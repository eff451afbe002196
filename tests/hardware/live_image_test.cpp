// An image reaches the operator when it was taken, and not when the sweep is over.
#include <gtest/gtest.h>

#include "hardware/simulated/simulated_head.h"
#include "tests/hardware/emulated_head.h"

namespace foresight {
namespace {

/// -30 to 30 deg at 10 deg/s: 6 s, the image after 3 s.
ScanPlan Plan() {
  ScanPlan plan;
  plan.image_angles_rad = {0.0};
  return plan;
}

/// Remembers how many lines had come when the image came.
class ImageWatch final : public ScanSink {
 public:
  void OnScanStarted(const Scan&) override {}
  void OnLine(const LidarLine&) override { ++lines_; }
  void OnMotorSamples(std::span<const MotorSample>) override {}
  void OnFrame(const CameraFrame& frame) override {
    lines_at_image_ = lines_;
    image_deg_ = DegreesFromRadians(frame.motor_angle_rad);
  }
  void OnScanEnded(ScanState, const std::string&) override {}

  int lines() const { return lines_; }
  int lines_at_image() const { return lines_at_image_; }
  double image_deg() const { return image_deg_; }

 private:
  int lines_ = 0;
  int lines_at_image_ = -1;
  double image_deg_ = NAN;
};

/// A head whose image is rendered in a tenth of a second: what is asked here is when it is handed
/// on.
EmulatedDevicesOptions SmallDevices() {
  EmulatedDevicesOptions options;
  options.true_rig = TinyRig();
  return options;
}

void ExpectTheImageInTime(SensorHead& head) {
  const auto image = std::make_shared<ImageWatch>();
  const auto watch = std::make_shared<ScanWatch>();
  ASSERT_TRUE(head.StartScan(
      Plan(), std::make_shared<ScanFanout>(std::vector<std::shared_ptr<ScanSink>>{image, watch})));
  while (!watch->WaitForEnd()) {
  }
  // 50 ms: on a machine with much else to do the shutter waits for its turn.
  EXPECT_NEAR(image->image_deg(), 0.0, 0.5);
  EXPECT_GE(image->lines_at_image(), image->lines() / 2 - 5) << "it was taken in the middle";
  EXPECT_LT(image->lines_at_image(), 2 * image->lines() / 3) << "of " << image->lines() << " lines";
  testing::Test::RecordProperty("lines_at_image", image->lines_at_image());
}

const std::string kRoom = FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml";

TEST(LiveImage, ComesFromTheSimulatedHeadBeforeTheLastThirdOfTheLines) {
  SimulatedHeadOptions options;
  options.true_rig = options.believed_rig = SmallDevices().true_rig;
  options.operator_timeout_s = 0.0;
  const auto head = MakeSimulatedHead(kRoom, options).value();
  ASSERT_TRUE(head->Home());
  while (head->Status().state == HeadState::kHoming)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ExpectTheImageInTime(*head);
}

TEST(LiveImage, ComesOverTheWireBeforeTheLastThirdOfTheLines) {
  EmulatedHead bench(std::make_shared<const Scene>(LoadScene(kRoom).value()), SmallDevices());
  ASSERT_TRUE(bench.Home());
  ExpectTheImageInTime(*bench.head);
}

}  // namespace
}  // namespace foresight
