#include <gtest/gtest.h>

#include <QStandardPaths>

#include "app/common/emulation.h"
#include "app/workstation/workbench.h"
#include "hardware/assembly/real_head.h"
#include "tests/support/sanitized.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

/// The default camera, 1288 x 964, over the wire, in a sweep of 6 s with an image after 1.5 s: a
/// machine that has other things to do as well takes three times as long for it as a quiet one.
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
  bench.head.SetPlan(plan);
  bench.head.scan();
  ASSERT_TRUE(WaitFor([&] { return bench.live.session.CurrentScan() != nullptr; }, 60'000));
  const int lines = static_cast<int>(bench.live.session.CurrentScan()->lines.size());
  std::printf("of %d lines: image shown at line %d, live depth at line %d\n", lines, lines_at_image,
              lines_at_depth);
  EXPECT_GE(lines_at_image, lines / 4 - 5) << "it is not taken before";
  EXPECT_LE(lines_at_image, lines - 40) << "a second before the end";
  EXPECT_GT(lines_at_depth, 0);
  EXPECT_LT(lines_at_depth, lines);
}

}  // namespace
}  // namespace foresight
