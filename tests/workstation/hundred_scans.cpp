#include "tests/workstation/hundred_scans.h"

#include <gtest/gtest.h>

#include <QElapsedTimer>
#include <QTemporaryDir>
#include <fstream>

#include "core/base/memory.h"
#include "core/geometry/angles.h"
#include "core/simulation/simulate_scan.h"
#include "tests/ui/fake_head.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

constexpr int kScans = 100;

double Resident_MB() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmRSS:", 0) == 0) return std::stod(line.substr(6)) / 1024.0;
  return 0.0;
}

/// 480 lines and the image of the default camera.
Scan WholeScan() {
  const auto scene = std::make_shared<const Scene>(
      LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml").value());
  ScanPlan plan;
  plan.speed_rad_s = RadiansFromDegrees(5.0);
  plan.image_angles_rad = {0.0};
  return SimulateScan(World(scene, DefaultSensorRig(), {}), plan, {}).value();
}

}  // namespace

void RecordHundredScans(const std::function<std::unique_ptr<QObject>(Workbench*)>& show) {
  const Scan first = WholeScan();
  ASSERT_NEAR(static_cast<double>(first.lines.size()), 480.0, 2.0);
  const auto head = std::make_shared<FakeHead>(first.rig);
  Workbench bench(head, SessionMode::kSimulation);
  const auto window = show(&bench);
  const QTemporaryDir missions;
  ASSERT_TRUE(bench.recording.BeginInFolder(missions.path()));
  double after_ten_MB = 0.0, most_MB = 0.0;
  for (int i = 1; i <= kScans; ++i) {
    Scan scan = first;
    scan.uuid = NewUuid();
    bench.head.scan();
    head->Deliver(scan, scan.lines.size());
    bench.head.Poll();
    head->Finish(scan, ScanState::kComplete);
    bench.head.Poll();
    ASSERT_TRUE(WaitFor(
        [&] {
          return bench.Idle() && bench.live.session.Depth() != nullptr &&
                 bench.recording.Waiting() == 0;
        },
        60'000));
    most_MB = std::max(most_MB, Resident_MB());
    if (i == 10) after_ten_MB = Resident_MB();
    if (i % 10 == 0) std::printf("after %d scans: %.0f MB\n", i, Resident_MB());
  }
  GiveMemoryBack();
  std::printf("most: %.0f MB; at the end, without free memory: %.0f MB\n", most_MB, Resident_MB());
  EXPECT_LT(most_MB, 800.0);
  EXPECT_LT(Resident_MB(), after_ten_MB + 100.0) << "scans before the last one are let go";

  QElapsedTimer timer;
  timer.start();
  const auto file = MissionFile::OpenReadOnly(bench.recording.Path().toStdString()).value();
  const auto scans = file->ListScans();
  const double listing_s = 1e-3 * static_cast<double>(timer.elapsed());
  ASSERT_TRUE(scans);
  EXPECT_EQ(scans->size(), static_cast<std::size_t>(kScans));
  std::printf("opening and listing the mission: %.3f s\n", listing_s);
  EXPECT_LT(listing_s, 0.2);
}

}  // namespace foresight
