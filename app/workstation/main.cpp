#include <CLI/CLI.hpp>
#include <QApplication>
#include <QLocale>
#include <QSettings>
#include <QTranslator>

#include "app/common/seed_option.h"
#include "app/workstation/head_switch.h"
#include "app/workstation/main_window.h"
#include "app/workstation/open_head.h"
#include "app/workstation/quit_on_signal.h"
#include "app/workstation/unattended.h"
#include "core/base/log.h"
#include "core/base/log_file.h"
#include "core/base/operator_text.h"
#include "core/base/version.h"
#include "ui/panels/theme.h"
#include "ui/views/vtk_setup.h"

namespace foresight {
namespace {

/// Where the mission lies that was recorded last, also one outside of the default folder.
const QString kLastMission = QStringLiteral("recording/file");

struct Options {
  HeadChoice head;
  std::string open;     ///< a mission to review
  std::string mission;  ///< the file to record into; empty: a new one in the user's data folder
  UnattendedOptions unattended;
};

int Parse(int argc, char** argv, Options* options) {
  CLI::App app{"Foresight, the workstation for a rotating lidar-camera head"};
  HeadChoice& choice = options->head;
  EmulationArguments& emulation = choice.emulation;
  app.add_option("--scene", choice.scene, "Scene file that the simulated head looks at");
  CLI::Option* emulate =
      app.add_option("--emulate", emulation.scene,
                     "Scene file: emulate the devices in this process, on real sockets")
          ->excludes("--scene");
  app.add_option("--rig", emulation.rig, "Calibration file of the simulated or emulated head");
  app.add_option("--prior", choice.prior,
                 "Calibration file that such a head has in force, as from CAD "
                 "(default: as well calibrated as can be)");
  AddSeedOption(app, "--seed", emulation.seed, "Seed of the simulated noise and faults");
  app.add_option("--faults", emulation.faults, "What goes wrong with emulated devices (YAML)")
      ->needs(emulate);
  app.add_option("--stand-place", emulation.stand_place,
                 "Place of the emulated scene's stand of boards, from 1; 0 = away; default: 1")
      ->needs(emulate);
  app.add_flag("--fast", choice.fast, "Let the simulated head's time run as fast as it can")
      ->excludes(emulate);
  CLI::Option* config =
      app.add_option("--head-config", choice.head_config,
                     "A real head and its devices (YAML), in place of the simulated one");
  for (const char* other : {"--scene", "--emulate", "--rig", "--prior", "--seed", "--fast"})
    config->excludes(other);
  CLI::Option* head = AddLinkOptions(app, choice.link);
  for (const char* other :
       {"--scene", "--emulate", "--rig", "--prior", "--seed", "--fast", "--head-config"})
    head->excludes(other);
  app.add_option("--open", options->open, "Mission file to look at, beside the live session");
  app.add_option("--mission", options->mission,
                 "Mission file to record into, a new one or one to continue "
                 "(default: a new one in the user's data folder)");
  app.add_flag("--scan", options->unattended.scan, "Start a scan as soon as the head is ready");
  app.add_option("--screenshot", options->unattended.screenshot,
                 "Save an image of the window when all is computed, then quit");
  app.set_version_flag("--version", ProgramVersion());
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& stop) {
    return app.exit(stop) == 0 ? -1 : 2;
  }
  return 0;
}

/// One head and its window, until the window closes. `next` is the head that the operator connected
/// to in its place, if any.
int Sit(OpenedHead head, const Options& options, std::optional<OpenedHead>* next) {
  const SessionMode mode = head.mode;
  Workbench bench(std::move(head.head), mode, head.stand);
  const QuitOnSignal quit_on_signal([&bench] { bench.head.StopForGood(); });
  QSettings settings;
  bench.recording.OfferInterrupted(RecordingViewModel::DefaultFolder(),
                                   settings.value(kLastMission).toString());
  if (!options.mission.empty())
    bench.recording.Begin(QString::fromStdString(options.mission));
  else
    bench.recording.BeginInFolder(RecordingViewModel::DefaultFolder());
  const auto archive = head.archive;
  const auto remember = [&] {
    if (archive) archive->Use(bench.recording.File());
    if (settings.value(kLastMission) == bench.recording.Path()) return;
    settings.setValue(kLastMission, bench.recording.Path());
    settings.sync();  // the program may be killed at any moment
  };
  remember();
  QObject::connect(&bench.recording, &RecordingViewModel::changed, &bench, remember);
  HeadSwitch head_switch(&bench, options.head.link.keys);
  MainWindow window(&bench);
  head_switch.Use(&window);
  QObject::connect(&head_switch, &HeadSwitch::opened, &window, [&] {
    *next = head_switch.TakeHead();
    window.CloseUnasked();
  });
  QObject::connect(&window, &MainWindow::stayed, &window, [&] { next->reset(); });
  const bool attended = options.unattended.screenshot.empty();
  window.show();
  if (attended) window.RestoreLayout(settings);  // every image shows the same layout
  // A real motor turns when the operator says so.
  if (mode == SessionMode::kSimulation || options.unattended.scan) bench.head.home();
  if (!options.open.empty()) bench.reviewer.Open(QString::fromStdString(options.open));
  Unattended unattended(&bench, &window, options.unattended);
  const int outcome = QApplication::exec();
  if (!bench.recording.WriteAll())
    LogError("{}: not everything could be written", bench.recording.Path().toStdString());
  if (attended) window.SaveLayout(&settings);
  return outcome;
}

int Run(int argc, char** argv) {
  Options options;
  if (const int outcome = Parse(argc, argv, &options); outcome != 0)
    return outcome < 0 ? 0 : outcome;
  SetUpVtk();
  QApplication application(argc, argv);
  QApplication::setOrganizationName(QStringLiteral("foresight"));
  QApplication::setApplicationName(QStringLiteral("workstation"));
  ApplyTheme(&application);
  if (const auto log = LogFileOf("workstation"); !log.empty())
    if (const Status kept = KeepLogFile(log); !kept)
      LogWarning("the log is not kept: {}", kept.error().message);
  QTranslator translation;
  if (translation.load(QLocale(), QStringLiteral("foresight"), QStringLiteral("_"),
                       QCoreApplication::applicationDirPath() + QStringLiteral("/../translations")))
    QCoreApplication::installTranslator(&translation);
  SetTranslator([](const char* english) {
    return QCoreApplication::translate("Core", english).toStdString();
  });
  auto head = OpenHead(options.head);
  if (!head) {
    LogError("{}", head.error().message);
    return 1;
  }
  std::optional<OpenedHead> next = std::move(*head);
  int outcome = 0;
  while (next) {
    OpenedHead present = std::move(*next);
    next.reset();
    outcome = Sit(std::move(present), options, &next);
    options.open.clear();
    options.unattended = {};
  }
  return outcome;
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  QApplication::setHighDpiScaleFactorRoundingPolicy(
      Qt::HighDpiScaleFactorRoundingPolicy::Round);  // VTK's panes need whole factors
  try {
    return foresight::Run(argc, argv);
  } catch (const std::exception& fault) {
    foresight::LogError("internal fault: {}", fault.what());
    return 70;
  }
}
