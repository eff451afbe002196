// Emulated devices and the real drivers on them, in real time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hardware/assembly/real_head.h"
#include "hardware/head/real_time_clock.h"
#include "tests/hardware/emulated_head.h"
#include "tests/hardware/small_sweep.h"

namespace foresight {
namespace {

TEST(EmulatedCamera, ThatGoesForGoodInASweepCostsItsImagesButNoLine) {
  EmulatedHead bench(FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml");
  const auto scan =
      bench.Execute(SmallSweep(), [&bench] { bench.devices->camera().InjectVanish(1e6); });
  ASSERT_TRUE(scan) << bench.head->Status().message;
  EXPECT_EQ(scan->state, ScanState::kComplete) << scan->reason;
  EXPECT_NEAR(static_cast<double>(scan->lines.size()), 81.0, 2.0);
  EXPECT_TRUE(scan->frames.empty());
  EXPECT_THAT(scan->reason, testing::HasSubstr("the image at -15.00 deg did not come"));
  EXPECT_FALSE(bench.devices->MotorTurns());
  ASSERT_TRUE(bench.WaitFor(HeadState::kFault));
  EXPECT_THAT(bench.head->Status().message, testing::HasSubstr("camera"));

  bench.devices->camera().ClearFaults();
  const auto after = bench.Execute(SmallSweep());
  ASSERT_TRUE(after) << bench.head->Status().message;
  EXPECT_EQ(after->reason, "");
  EXPECT_EQ(after->frames.size(), 1u);
}

TEST(RealTimeClock, RunsAtTheWallsPaceFromZero) {
  const auto wall = std::chrono::steady_clock::now();
  RealTimeClock clock;
  const double begin_s = clock.Now();
  clock.Sleep(std::chrono::milliseconds(20));
  const double end_s = clock.Now();
  const double wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  EXPECT_GE(begin_s, 0.0);
  EXPECT_GE(end_s - begin_s, 0.02);
  EXPECT_LE(end_s, wall_s);
}

TEST(EmulatedDevices, TwoEmulatorsFindAddressesForThemselves) {
  const auto scene = std::make_shared<const Scene>(TinyWorld()->scene());
  const auto first = EmulatedDevices::Start(scene, {});
  const auto second = EmulatedDevices::Start(scene, {});
  ASSERT_TRUE(first) << first.error().message;
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_NE((*first)->lidar().address(), (*second)->lidar().address());
  EXPECT_NE((*first)->motor().address(), (*second)->motor().address());
  EXPECT_NE((*first)->camera().address(), (*second)->camera().address());
  EmulatedDevicesOptions taken;
  taken.camera = (*first)->camera().address();
  const auto third = EmulatedDevices::Start(scene, taken);
  ASSERT_FALSE(third);
  EXPECT_EQ(third.error().code, ErrorCode::kDevice);
}

}  // namespace
}  // namespace foresight
