// The window at the far end of a link that a script makes and breaks: tests/link/window_trial.py.
// Skipped without it.
#include <gtest/gtest.h>

#include <QElapsedTimer>
#include <QPushButton>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/workstation/main_window.h"
#include "app/workstation/open_head.h"
#include "core/geometry/angles.h"
#include "tests/display/mouse.h"
#include "tests/display/stall_meter.h"
#include "tests/ui/wait_for.h"
#include "ui/views/cloud_pane.h"
#include "ui/views/image_pane.h"

namespace foresight {
namespace {

constexpr int kPatience_ms = 240'000;

std::string Variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

double UtcNow() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

struct LinkedWindow : testing::Test {
  void SetUp() override {
    LinkArguments link;
    link.head = Variable("FORESIGHT_TRIAL_HEAD");
    if (link.head.empty()) GTEST_SKIP() << "tests/link/window_trial.py runs this";
    link.keys = Variable("FORESIGHT_TRIAL_KEYS");
    link.thin = !Variable("FORESIGHT_TRIAL_THIN").empty();
    const auto opened = Connect(link);
    ASSERT_TRUE(opened) << opened.error().message;
    bench = std::make_unique<Workbench>(opened->head, opened->mode, opened->stand);
    bench->recording.Begin(QString::fromStdString(Variable("FORESIGHT_TRIAL_MISSION")));
    opened->archive->Use(bench->recording.File());
    window = std::make_unique<MainWindow>(bench.get());
    window->show();
    clock.start();
  }
  void TearDown() override {
    if (!bench) return;
    QCoreApplication::processEvents();  // what the last news changed is laid out
    window->grab().save(QString::fromStdString(Variable("FORESIGHT_TRIAL_MISSION") + ".png"));
    for (const LogEntry& entry : bench->log.Entries())
      report["log"].push_back(entry.notice.what.toStdString());
    EXPECT_TRUE(bench->recording.WriteAll());
    std::printf("TRIAL %s\n", report.dump().c_str());
  }

  /// A blackout may be longer than one attempt.
  static Result<OpenedHead> Connect(const LinkArguments& link) {
    QElapsedTimer timer;
    timer.start();
    for (;;) {
      auto opened = OpenRemoteHead(link);
      if (opened || timer.elapsed() > kPatience_ms) return opened;
    }
  }

  double Seconds() const { return 1e-3 * static_cast<double>(clock.elapsed()); }
  QPushButton* Button(const char* name) const {
    return window->findChild<QPushButton*>(QString::fromLatin1(name));
  }
  HeadState State() const { return bench->head.LastStatus().state; }
  SessionModel& Session() const { return bench->live.session; }

  /// Presses until it is so, as an operator does whose command was lost in a blackout.
  bool PressUntil(const std::function<void()>& press, const std::function<bool()>& so,
                  int* presses) const {
    constexpr int kAgain_ms = 12'000;  // a command is void after 8 s
    QElapsedTimer timer;
    timer.start();
    while (timer.elapsed() < kPatience_ms) {
      press();
      ++*presses;
      if (WaitFor(so, kAgain_ms)) return true;
    }
    return false;
  }
  bool BeReady() {
    int presses = 0;
    const bool ready = State() == HeadState::kReady ||
                       PressUntil([this] { bench->head.home(); },
                                  [this] { return State() == HeadState::kReady; }, &presses);
    report["home_presses"] = presses;
    return ready;
  }
  /// Presses Scan, and again where the press was lost, until something of a scan is here.
  bool BeginScan(const char* name) {
    auto* button = Button("scanButton");
    int presses = 0;
    stalls.TakeWorst();
    const bool begun = PressUntil(
        [&] {
          const auto may_press = [&] {
            return Session().ShownScan() || (!bench->head.Scanning() && button->isEnabled());
          };
          if (WaitFor(may_press, kPatience_ms) && !Session().ShownScan()) Click(button);
        },
        [this] { return Session().ShownScan() != nullptr; }, &presses);
    report[name] = presses;
    return begun;
  }

  /// Two corners round the valve of resources/scenes/room.yaml, in pixels of the shown image.
  std::pair<Eigen::Vector2d, Eigen::Vector2d> AroundValve() const {
    const Scene scene = LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml").value();
    const SensorRig& rig = Session().ShownScan()->rig;
    const auto camera_from_robot = rig.CameraFromBase(Session().CurrentImage()->motor_angle_rad) *
                                   rig.robot_from_base.Inverse();
    const Eigen::Vector3d center =
        camera_from_robot * scene.valves.at(0).robot_from_object.translation();
    const double radius_m = 1.35 * scene.valves.at(0).model.rim_radius_m;
    return {*rig.camera.Project(center - Eigen::Vector3d(radius_m, radius_m, 0.0)),
            *rig.camera.Project(center + Eigen::Vector3d(radius_m, radius_m, 0.0))};
  }
  void DragOverTheValve() const {
    bench->live.fit.SetTool(ObjectKind::kValve, true);
    ImageCanvas* canvas = window->Image()->Canvas();
    const auto [a, b] = AroundValve();
    Drag(canvas->viewport(), canvas->WidgetFromPixel(a), canvas->WidgetFromPixel(b));
  }

  std::unique_ptr<Workbench> bench;
  std::unique_ptr<MainWindow> window;
  QElapsedTimer clock;
  StallMeter stalls;
  nlohmann::ordered_json report;
};

TEST_F(LinkedWindow, AMissionFromHomingToTheRobotsAnswer) {
  ASSERT_TRUE(BeReady());
  PlanFields plan;
  plan.from_deg = -50.0;
  plan.to_deg = 20.0;
  plan.image_angles_deg = {-15.0};
  bench->head.SetPlan(plan);
  ASSERT_TRUE(BeginScan("scan_presses"));
  const double begun_s = Seconds();
  ASSERT_TRUE(WaitFor([this] { return window->Cloud()->PointCount() > 0; }, kPatience_ms));
  report["first_cloud_s"] = Seconds() - begun_s;
  ASSERT_TRUE(WaitFor([this] { return Session().CurrentImage() != nullptr; }, kPatience_ms));
  report["first_image_s"] = Seconds() - begun_s;
  ASSERT_TRUE(
      WaitFor([this] { return Session().CurrentScan() && Session().Depth() && bench->Idle(); },
              kPatience_ms));
  report["depth_s"] = Seconds() - begun_s;
  EXPECT_EQ(Session().CurrentScan()->state, ScanState::kComplete)
      << Session().CurrentScan()->reason;
  report["worst_stall_cpu_ms"] = stalls.TakeWorst().cpu_ms;

  DragOverTheValve();
  ASSERT_TRUE(WaitFor([this] { return !Session().Objects().empty(); }, kPatience_ms));
  const VerdictLevel verdict = VerdictOf(Session().Objects()[0].detection).level;
  report["verdict"] = ToString(verdict);
  EXPECT_NE(verdict, VerdictLevel::kUnsure);
  ASSERT_TRUE(WaitFor([this] { return Button("acceptButton")->isEnabled(); }));
  Click(Button("acceptButton"));
  ASSERT_TRUE(WaitFor([this] { return Button("sendButton")->isEnabled(); }, kPatience_ms));
  int presses = 0;
  ASSERT_TRUE(PressUntil(
      [this] {
        if (WaitFor([this] { return Button("sendButton")->isEnabled(); }, kPatience_ms))
          Click(Button("sendButton"));
      },
      [this] { return Session().Objects()[0].robot.startsWith(QStringLiteral("accepted")); },
      &presses));
  report["send_presses"] = presses;
  report["robot"] = Session().Objects()[0].robot.toStdString();
  report["mission_s"] = Seconds();
}

/// The button is pressed with the head in full sweep; the head's log says when the stop came.
TEST_F(LinkedWindow, StopHeadInTheMiddleOfASweep) {
  ASSERT_TRUE(BeReady());
  PlanFields plan;
  plan.from_deg = -30.0;
  plan.to_deg = 80.0;
  plan.speed_deg_s = 5.0;
  bench->head.SetPlan(plan);
  ASSERT_TRUE(BeginScan("scan_presses"));
  constexpr int kFull_ms = 9000;  // by then data fill the path
  QElapsedTimer sweeping;
  sweeping.start();
  WaitFor([&] { return sweeping.elapsed() > kFull_ms; });
  report["stop_pressed_utc_s"] = UtcNow();
  Click(Button("stopButton"));
  EXPECT_TRUE(bench->head.StopLatched());
  ASSERT_TRUE(WaitFor([this] { return State() != HeadState::kSweeping; }, kPatience_ms));
  report["stop_seen_utc_s"] = UtcNow();
  EXPECT_FALSE(Button("scanButton")->isEnabled()) << "nothing turns before the stop is released";
}

}  // namespace
}  // namespace foresight
