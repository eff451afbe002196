// mission_driver [--window] MISSION [OTHER]: the workstation, with or without its window, on a fast
// simulated head with a small camera. Twice it scans, fits the valve and accepts it; in between it
// opens the mission OTHER for review and rejects an object there. Standard output says what the
// window would show as kept, a line each, only after the program itself shows it so:
//   lines SCAN COUNT DIGEST       so many lines of a running scan are in the file
//   scan SCAN DIGEST              the whole scan is
//   object OBJECT                 and so on
//   accepted OBJECT
//   rejected OBJECT               in the file beside OTHER
//   end
// "go-on" in place of OTHER: only goes on in the mission that was interrupted, with one command.
#include <QApplication>
#include <QFileInfo>
#include <QStandardPaths>
#include <QTimer>
#include <cstdio>
#include <map>
#include <set>

#include "app/workstation/main_window.h"
#include "core/simulation/scene.h"
#include "hardware/simulated/simulated_head.h"
#include "tests/support/small_camera.h"
#include "tests/workstation/scan_digest.h"
#include "ui/panels/theme.h"
#include "ui/views/vtk_setup.h"

namespace foresight {
namespace {

constexpr int kStep_ms = 5;

void Say(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

/// Carries out the script, and says what is kept, by looking at the view-models.
class Script {
 public:
  Script(Workbench* bench, const Scene& scene, QString other)
      : bench_(bench), scene_(scene), other_(std::move(other)) {
    PlanFields plan;
    plan.from_deg = -12.0;
    plan.to_deg = 12.0;
    plan.speed_deg_s = 4.0;
    bench_->head.SetPlan(plan);
    bench_->head.home();
    QObject::connect(&timer_, &QTimer::timeout, [this] { Step(); });
    timer_.start(kStep_ms);
  }

 private:
  void Step() {
    SayWhatIsKept();
    if ((this->*steps_[step_])()) ++step_;
    if (steps_[step_] == nullptr) {
      timer_.stop();
      Say("end");
      QCoreApplication::exit(bench_->recording.WriteAll() ? 0 : 1);
    }
  }

  bool Scan() {
    if (!bench_->Idle() || !bench_->head.CanScan()) return false;
    objects_before_ = bench_->live.session.Objects().size();
    return bench_->commands.Run("head.scan");
  }
  bool Fit() {
    const SessionModel& session = bench_->live.session;
    if (!bench_->Idle() || !session.CurrentScan() || !session.Depth()) return false;
    bench_->live.fit.SetTool(ObjectKind::kValve, true);
    const auto [low, high] = AroundValve();
    bench_->live.fit.DrawRegion({low, high});
    return true;
  }
  bool Accept() {
    if (bench_->live.session.Objects().size() == objects_before_) return false;
    return bench_->commands.Run("object.accept");
  }
  bool Accepted() {
    return bench_->Idle() && said_.count("accepted " + bench_->live.session.Selected()->uuid) > 0;
  }
  bool OpenOther() {
    if (!other_.isEmpty()) bench_->reviewer.Open(other_);
    return true;
  }
  bool RejectThere() {
    if (other_.isEmpty()) return true;
    if (!bench_->ShowsReview() || !bench_->Idle() || bench_->review.session.Objects().empty())
      return false;
    bench_->review.session.SelectObject(0);
    return bench_->commands.Run("object.reject");
  }
  bool RejectedThere() {
    if (other_.isEmpty()) return true;
    if (bench_->reviewer.Busy()) return false;
    SayOnce("rejected " + bench_->review.session.Objects()[0].uuid);
    return bench_->commands.Run("view.live");
  }

  void SayOnce(const std::string& line) {
    if (said_.insert(line).second) Say(line);
  }
  void SayWhatIsKept() {
    if (bench_->head.Scanning()) {
      bench_->head.Poll();  // more often than by itself: more is said of the sweep
      if (!bench_->recording.Busy()) bench_->recording.refreshList();
    }
    for (const ScanSummary& summary : bench_->recording.Scans()) SayScan(summary);
    const bool nothing_waits = bench_->recording.Waiting() == 0 && !bench_->recording.Busy();
    for (const FoundObject& object : bench_->live.session.Objects()) {
      if (object.kept) SayOnce("object " + object.uuid);
      if (nothing_waits && object.decision == Decision::kAccepted)
        SayOnce("accepted " + object.uuid);
    }
  }
  void SayScan(const ScanSummary& summary) {
    const auto& scan = bench_->live.session.ShownScan();
    if (!scan || scan->uuid != summary.uuid || summary.lines == 0) return;
    const auto lines = static_cast<std::size_t>(summary.lines);
    if (summary.state == ScanState::kComplete && scan->lines.size() == lines) {
      if (said_.insert(summary.uuid).second)
        Say("scan " + summary.uuid + " " + DigestOfScan(*scan));
    } else if (const std::size_t known = std::min(lines, scan->lines.size());
               known > said_lines_[summary.uuid]) {
      said_lines_[summary.uuid] = known;
      Say(fmt::format("lines {} {} {}", summary.uuid, known, DigestOfLines(*scan, known)));
    }
  }

  std::pair<Eigen::Vector2d, Eigen::Vector2d> AroundValve() const {
    const foresight::Scan& scan = *bench_->live.session.CurrentScan();
    const auto camera_from_robot =
        scan.rig.CameraFromBase(bench_->live.session.CurrentImage()->motor_angle_rad) *
        scan.rig.robot_from_base.Inverse();
    const ValveTruth& valve = scene_.valves.at(0);
    const Eigen::Vector3d center = camera_from_robot * valve.robot_from_object.translation();
    const double reach_m = 1.35 * valve.model.rim_radius_m;
    return {*scan.rig.camera.Project(center - Eigen::Vector3d(reach_m, reach_m, 0.0)),
            *scan.rig.camera.Project(center + Eigen::Vector3d(reach_m, reach_m, 0.0))};
  }

  using Step_ = bool (Script::*)();
  static constexpr Step_ steps_[] = {
      &Script::Scan,      &Script::Fit,         &Script::Accept,        &Script::Accepted,
      &Script::OpenOther, &Script::RejectThere, &Script::RejectedThere, &Script::Scan,
      &Script::Fit,       &Script::Accept,      &Script::Accepted,      nullptr};

  Workbench* bench_;
  const Scene& scene_;
  QString other_;
  QTimer timer_;
  std::size_t step_ = 0;
  std::size_t objects_before_ = 0;
  std::map<std::string, std::size_t> said_lines_;
  std::set<std::string> said_;
};

int GoOn(Workbench* bench, const QString& mission) {
  bench->recording.OfferInterrupted(QFileInfo(mission).path());
  if (bench->recording.Interrupted() != mission) return 3;
  if (!bench->recording.BeginInFolder(QFileInfo(mission).path())) return 4;
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, [bench, mission] {
    if (bench->recording.Path() == mission && !bench->recording.Busy()) QCoreApplication::exit(0);
  });
  timer.start(kStep_ms);
  return bench->commands.Run("recording.continue") ? QCoreApplication::exec() : 5;
}

/// The command line without the program's name.
struct Arguments {
  bool window = false;
  QString mission, other;

  Arguments(int argc, char** argv) {
    QStringList words;
    for (int i = 1; i < argc; ++i) words.append(QString::fromLocal8Bit(argv[i]));
    window = words.removeAll(QStringLiteral("--window")) > 0;
    mission = words.value(0);
    other = words.value(1);
  }
};

int Drive(const Arguments& arguments) {
  QStandardPaths::setTestModeEnabled(true);
  const std::string file = FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml";
  const Scene scene = LoadScene(file).value();
  SimulatedHeadOptions options;
  options.speed = SimulationSpeed::kAsFastAsPossible;
  options.true_rig = options.believed_rig = SmallCameraRig();
  Workbench bench(std::shared_ptr<SensorHead>(MakeSimulatedHead(file, options).value()),
                  SessionMode::kSimulation);
  std::unique_ptr<MainWindow> window;
  if (arguments.window) {
    window = std::make_unique<MainWindow>(&bench);
    window->show();
  }
  if (arguments.other == QLatin1String("go-on")) return GoOn(&bench, arguments.mission);
  if (!bench.recording.Begin(arguments.mission)) return 2;
  const Script script(&bench, scene, arguments.other);
  return QCoreApplication::exec();
}

int Run(int argc, char** argv) {
  const Arguments arguments(argc, argv);
  if (!arguments.window) {
    const QCoreApplication application(argc, argv);
    return Drive(arguments);
  }
  SetUpVtk();  // before the QApplication
  QApplication application(argc, argv);
  ApplyTheme(&application);
  return Drive(arguments);
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  return foresight::Run(argc, argv);
}
