#include <gtest/gtest.h>

#include <QStandardPaths>

#include "app/common/emulation.h"
#include "app/workstation/workbench.h"
#include "hardware/assembly/real_head.h"
#include "tests/support/sanitized.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

/// The default camera, 1288 x 964, over the wire. The sweep is slow, 30 s, so that a machine with
/// much else to do shows the image in time; the test ends as soon as its depth is there.
TEST(FullSizeCamera, ItsImageAndItsDepthAreShownWhileTheFirstSweepGoesOn) {
  if (kSanitized) GTEST_SKIP() << "an image takes longer than a sweep";
  EmulationArguments arguments;
  arguments.scene = FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml";
  auto devices = StartEmulation(arguments);
  ASSERT_TRUE(devices) << devices.error().message;
  Workbench bench(MakeRealHead(ConfigFor(**devices)), SessionMode::kSimulation);
  int lines_at_image = -1, lines_at_depth = -1;
  QObject::connect(&bench.live.session, &SessionModel::imageChanged, [&] {
    if (bench.head.Scanning() && bench.live.session.CurrentImage() != nullptr && lines_at_image < 0)
      lines_at_image = bench.head.LastStatus().lines;
  });
  QObject::connect(&bench.live_depth, &LiveDepthViewModel::changed, [&] {
    if (bench.live_depth.HasOwnImage() && bench.live_depth.Depth() && lines_at_depth < 0)
      lines_at_depth = bench.head.LastStatus().lines;
  });
  bench.head.home();
  ASSERT_TRUE(WaitFor([&] { return bench.head.CanScan(); }, 30'000));
  PlanFields plan;
  plan.from_deg = -15.0;
  plan.to_deg = 45.0;
  plan.speed_deg_s = 2.0;
  plan.image_angles_deg = {-10.0};
  bench.head.SetPlan(plan);
  bench.head.scan();
  const auto ended = [&] { return bench.live.session.CurrentScan() != nullptr; };
  ASSERT_TRUE(WaitFor([&] { return lines_at_depth >= 0 || ended(); }, 60'000));
  std::printf("image shown at line %d, live depth at line %d\n", lines_at_image, lines_at_depth);
  EXPECT_FALSE(ended()) << "the sweep goes on while its image and depth are shown";
  constexpr int kLinesBeforeImage = 100;  // 5 deg at 2 deg/s, 40 lines/s
  EXPECT_GE(lines_at_image, kLinesBeforeImage - 5) << "it is not taken before";
  EXPECT_GE(lines_at_depth, lines_at_image);
  bench.head.abort();
  ASSERT_TRUE(WaitFor(ended, 60'000));
}

}  // namespace
}  // namespace foresight
