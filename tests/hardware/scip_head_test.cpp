// A head whose lidar is on the wire: the scan that the operator gets.
#include <gtest/gtest.h>

#include "hardware/head/capture_head.h"
#include "tests/hardware/scip_bench.h"

namespace foresight {
namespace {

/// A head in real time: simulated motor and camera, the lidar over a socket.
struct WiredHead {
  WiredHead() {
    auto scip = std::move(bench.lidar);
    lidar = scip.get();
    HeadDevices devices;
    devices.lidar = std::move(scip);
    devices.motor = std::make_unique<SimulatedMotor>(bench.world, bench.clock, bench.shaft);
    devices.camera = std::make_unique<SimulatedCamera>(bench.world, bench.clock, bench.shaft);
    devices.clock = bench.clock;
    head = std::make_unique<CaptureHead>(std::move(devices), TinyRig(), CaptureOptions());
  }

  /// A whole scan; at its tenth line `action` is called.
  std::shared_ptr<const Scan> RunScan(const std::function<void()>& action) {
    const auto assembler = std::make_shared<ScanAssembler>();
    const auto watch = std::make_shared<ScanWatch>();
    watch->action = action;
    if (!head->Home() || !Eventually([&] { return head->Status().state == HeadState::kReady; }))
      return nullptr;
    const auto sinks =
        std::make_shared<ScanFanout>(std::vector<std::shared_ptr<ScanSink>>{assembler, watch});
    if (!head->StartScan(TinyPlan(), sinks) || !watch->WaitForEnd()) return nullptr;
    return assembler->Snapshot();
  }

  ScipBench bench;
  ScipLidar* lidar = nullptr;
  std::unique_ptr<CaptureHead> head;
};

TEST(ScipHead, ScansThroughTheWireWithoutLosingALine) {
  WiredHead wired;
  const auto scan = wired.RunScan([] {});
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete) << scan->reason;
  EXPECT_GE(scan->lines.size(), 40u);
  for (std::size_t i = 1; i < scan->lines.size(); ++i)
    EXPECT_EQ(scan->lines[i].seq, scan->lines[i - 1].seq + 1);
  EXPECT_EQ(wired.head->Status().lost_lines, 0);
}

TEST(ScipHead, AConnectionLostInMidScanIsAGapInACompleteScan) {
  WiredHead wired;
  const auto scan = wired.RunScan([&] { wired.bench.emulator->InjectReset(); });
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete) << scan->reason;
  EXPECT_EQ(wired.lidar->Health().reconnects, 1);
  EXPECT_GT(wired.head->Status().lost_lines, 0);
  // The lines behind the gap are where they belong.
  for (const LidarLine& line : scan->lines)
    EXPECT_LT(std::abs(wired.bench.StampError_s(line)), ScipBench::MostStampError_s(*wired.lidar));
}

}  // namespace
}  // namespace foresight
