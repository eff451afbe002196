// How fast a large mission opens for review in the window, and how fast its panes fill.
//   review_pace FOLDER [SCANS]
// Makes FOLDER/review-pace.foresight of SCANS (100) scans of 480 lines with an image of 1288 x 964,
// three objects and ten messages each, unless it is there, and prints the times from the command to
// what is on the screen.
#include <ctime>

#include <QApplication>
#include <QDir>
#include <QElapsedTimer>
#include <QFileInfo>
#include <QStandardPaths>
#include <algorithm>
#include <cstdio>

#include "app/workstation/main_window.h"
#include "core/geometry/angles.h"
#include "core/simulation/simulate_scan.h"
#include "tests/ui/fake_head.h"
#include "tests/ui/wait_for.h"
#include "ui/panels/mission_panel.h"
#include "ui/panels/theme.h"
#include "ui/panels/timeline_view.h"
#include "ui/viewmodels/mission_objects.h"
#include "ui/views/cloud_pane.h"
#include "ui/views/image_pane.h"
#include "ui/views/vtk_setup.h"

namespace foresight {
namespace {

/// CPU time of this thread: on a machine that others share it tells more than the clock does.
double ThreadCpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// The same of all threads.
double ProcessCpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr int kLimit_ms = 60'000;

Scan WholeScan() {
  const auto scene = std::make_shared<const Scene>(
      LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml").value());
  ScanPlan plan;
  plan.speed_rad_s = RadiansFromDegrees(5.0);
  plan.image_angles_rad = {0.0};
  return SimulateScan(World(scene, DefaultSensorRig(), {}), plan, {}).value();
}

Status MakeMission(const std::string& path, int scans) {
  FORESIGHT_TRY(const auto mission, MissionFile::Create(path));
  Scan scan = WholeScan();
  const std::int64_t start = 1'790'000'000 * kSecond_ns;
  for (int i = 0; i < scans; ++i) {
    scan.uuid = NewUuid();
    scan.start_utc_ns = start + 60 * i * kSecond_ns;
    FORESIGHT_CHECK(AppendScan(mission.get(), scan, {}));
    for (int j = 0; j < 3; ++j) {
      FoundObject object;
      ValveDetection valve;
      valve.origin.roi = ImageRoi::Rectangle(0.0, {10, 10}, {50, 50});
      object.detection = valve;
      object.rig = scan.rig;
      object.scan_uuid = scan.uuid;
      DetectionRecord record = RecordOf(object, "anna");
      record.utc_ns = scan.start_utc_ns + (28 + j) * kSecond_ns;
      FORESIGHT_TRY(const std::int64_t id, mission->AddDetection(record));
      FORESIGHT_CHECK(mission->AddDetectionEvent(
          id, {record.utc_ns + kSecond_ns, "anna", DetectionEvent::Action::kAccepted, ""}));
    }
    for (int j = 0; j < 10; ++j)
      FORESIGHT_CHECK(mission->AddEvent({0, scan.start_utc_ns + (25 + j) * kSecond_ns, "head",
                                         j == 0 ? "warning" : "info", "a message", ""}));
  }
  return mission->Close();
}

/// The pane of the document that is shown.
template <class PaneOf>
PaneOf* Visible(QWidget& window) {
  for (PaneOf* pane : window.findChildren<PaneOf*>())
    if (pane->isVisible()) return pane;
  return nullptr;
}

/// Seconds from a command to what it puts on the screen.
struct Times {
  double image = 0.0, cloud = 0.0, depth = 0.0;
  double cpu = 0.0;  ///< of all threads, until the cloud was there
};

Times Watch(Workbench& bench, MainWindow& window, const std::function<void()>& command,
            const std::string& scan_uuid) {
  Times times;
  const double cpu = ProcessCpu_s();
  QElapsedTimer timer;
  timer.start();
  const auto seconds = [&] { return 1e-3 * static_cast<double>(timer.elapsed()); };
  command();
  const SessionModel& session = bench.review.session;
  const auto shown = [&] {
    return session.CurrentScan() && session.CurrentScan()->uuid == scan_uuid;
  };
  WaitFor(
      [&] {
        return shown() && bench.ShowsReview() && Visible<ImagePane>(window) != nullptr &&
               !Visible<ImagePane>(window)->HintShown();
      },
      kLimit_ms);
  times.image = seconds();
  WaitFor(
      [&] {
        return session.Cloud() && Visible<CloudPane>(window) != nullptr &&
               Visible<CloudPane>(window)->PointCount() > 0;
      },
      kLimit_ms);
  times.cloud = seconds();
  times.cpu = ProcessCpu_s() - cpu;
  WaitFor([&] { return session.Depth() != nullptr; }, kLimit_ms);
  times.depth = seconds();
  WaitFor([&] { return bench.tasks.Idle(); }, kLimit_ms);
  return times;
}

void Print(const char* what, const Times& times) {
  std::printf("%-16s image after %.2f s, cloud %.2f s (CPU of all threads %.2f s), depth %.2f s\n",
              what, times.image, times.cloud, times.cpu, times.depth);
}

int Measure(const QString& path, int scans) {
  const auto file = MissionFile::OpenReadOnly(path.toStdString()).value();
  const auto list = file->ListScans().value();
  Workbench bench(std::make_shared<FakeHead>(DefaultSensorRig()), SessionMode::kLive);
  MainWindow window(&bench);
  window.show();
  QElapsedTimer rest;
  rest.start();
  WaitFor([&] { return rest.elapsed() > 2000; });
  std::printf("%d scans, %.1f MB\n", scans, 1e-6 * static_cast<double>(QFileInfo(path).size()));

  Print("mission opened:",
        Watch(
            bench, window, [&] { bench.reviewer.Open(path); }, list.back().uuid));
  rest.start();
  WaitFor([&] { return bench.timeline.Timeline() != nullptr; }, kLimit_ms);
  std::printf("thumbnails decoded: %d of %d\n", window.Mission()->Reviewed()->DecodedThumbnails(),
              scans);
  for (const std::size_t scan : {list.size() / 2, std::size_t{0}})
    Print("another scan:",
          Watch(
              bench, window, [&] { bench.reviewer.showScan(static_cast<int>(scan)); },
              list[scan].uuid));

  double cpu_ms = ThreadCpu_ms();
  QElapsedTimer read;
  read.start();
  const auto timeline = ReadTimeline(*file, nullptr).value();
  std::printf("timeline read: %.3f s (CPU %.3f s), %zu entries\n",
              1e-3 * static_cast<double>(read.elapsed()), 1e-3 * (ThreadCpu_ms() - cpu_ms),
              timeline.entries.size());
  auto* view = window.findChild<TimelineView*>();
  constexpr int kTimes = 20;
  cpu_ms = ThreadCpu_ms();
  for (int i = 0; i < kTimes; ++i) view->grab();
  std::printf("timeline drawn: CPU %.1f ms, %d marks for %zu entries\n",
              (ThreadCpu_ms() - cpu_ms) / kTimes, view->DrawnMarks(), timeline.entries.size());

  // Moments of the sweep of the scan that is shown.
  bench.replay.SeekTo(list[0].begin_utc_ns + kSecond_ns);
  WaitFor([&] { return !bench.replay.Loading(); }, kLimit_ms);
  WaitFor([&] { return bench.tasks.Idle(); }, kLimit_ms);
  double worst_ms = 0.0, all_ms = 0.0;
  constexpr int kMoments = 100;
  for (int i = 1; i <= kMoments; ++i) {
    cpu_ms = ThreadCpu_ms();
    bench.replay.SeekTo(list[0].begin_utc_ns + i * kSecond_ns / 5);
    const double took_ms = ThreadCpu_ms() - cpu_ms;
    worst_ms = std::max(worst_ms, took_ms);
    all_ms += took_ms;
  }
  std::printf("another moment of a scan: CPU of the window's thread %.2f ms, at most %.2f ms\n",
              all_ms / kMoments, worst_ms);
  bench.replay.leave();
  WaitFor([&] { return bench.tasks.Idle(); }, kLimit_ms);
  return 0;
}

int Run(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: review_pace FOLDER [SCANS]\n");
    return 2;
  }
  SetUpVtk();  // before the QApplication
  QStandardPaths::setTestModeEnabled(true);
  const QApplication application(argc, argv);
  ApplyTheme(qApp);
  const int scans = argc > 2 ? std::atoi(argv[2]) : 100;
  QDir().mkpath(QString::fromLocal8Bit(argv[1]));
  const QString path =
      QDir(QString::fromLocal8Bit(argv[1])).filePath(QStringLiteral("review-pace.foresight"));
  if (!QFileInfo::exists(path))
    if (const Status made = MakeMission(path.toStdString(), scans); !made) {
      std::fprintf(stderr, "%s\n", made.error().message.c_str());
      return 3;
    }
  return Measure(path, scans);
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  return foresight::Run(argc, argv);
}
