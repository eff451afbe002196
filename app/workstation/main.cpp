#include <CLI/CLI.hpp>
#include <QApplication>
#include <QDir>
#include <QFile>
#include <QLocale>
#include <QSettings>
#include <QTranslator>

#include "app/common/emulation.h"
#include "app/common/link_arguments.h"
#include "app/common/seed_option.h"
#include "app/workstation/main_window.h"
#include "app/workstation/quit_on_signal.h"
#include "app/workstation/simulated_stand.h"
#include "app/workstation/unattended.h"
#include "core/base/log.h"
#include "core/base/operator_text.h"
#include "core/base/version.h"
#include "hardware/assembly/real_head.h"
#include "hardware/link/client/mission_archive.h"
#include "hardware/simulated/simulated_head.h"
#include "ui/panels/theme.h"
#include "ui/views/vtk_setup.h"

namespace foresight {
namespace {

/// Where the mission lies that was recorded last, also one outside of the default folder.
const QString kLastMission = QStringLiteral("recording/file");

struct Options {
  std::string scene;             ///< empty: the valve scene that comes with the program
  EmulationArguments emulation;  ///< its scene, rig and seed; rig and seed are the simulation's too
  std::string prior;             ///< what the simulated or emulated head believes of itself
  std::string head_config;       ///< of a real head, in place of a scene
  LinkArguments link;            ///< to a head elsewhere
  std::string open;              ///< a mission to review
  std::string mission;  ///< the file to record into; empty: a new one in the user's data folder
  bool fast = false;
  UnattendedOptions unattended;
};

int Parse(int argc, char** argv, Options* options) {
  CLI::App app{"Foresight, the workstation for a rotating lidar-camera head"};
  EmulationArguments& emulation = options->emulation;
  app.add_option("--scene", options->scene, "Scene file that the simulated head looks at");
  CLI::Option* emulate =
      app.add_option("--emulate", emulation.scene,
                     "Scene file: emulate the devices in this process, on real sockets")
          ->excludes("--scene");
  app.add_option("--rig", emulation.rig, "Calibration file of the simulated or emulated head");
  app.add_option("--prior", options->prior,
                 "Calibration file that such a head has in force, as from CAD "
                 "(default: as well calibrated as can be)");
  AddSeedOption(app, "--seed", emulation.seed, "Seed of the simulated noise and faults");
  app.add_option("--faults", emulation.faults, "What goes wrong with emulated devices (YAML)")
      ->needs(emulate);
  app.add_option("--stand-place", emulation.stand_place,
                 "Place of the emulated scene's stand of boards, from 1; 0 = away; default: 1")
      ->needs(emulate);
  app.add_flag("--fast", options->fast, "Let the simulated head's time run as fast as it can")
      ->excludes(emulate);
  CLI::Option* config =
      app.add_option("--head-config", options->head_config,
                     "A real head and its devices (YAML), in place of the simulated one");
  for (const char* other : {"--scene", "--emulate", "--rig", "--prior", "--seed", "--fast"})
    config->excludes(other);
  CLI::Option* head = AddLinkOptions(app, options->link);
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

/// The scene beside the installed program, else the one in the source tree.
std::string DefaultScene() {
  const QDir program(QCoreApplication::applicationDirPath());
  const QString installed =
      program.filePath(QStringLiteral("../share/foresight/scenes/valve.yaml"));
  return QFile::exists(installed) ? installed.toStdString()
                                  : FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml";
}

struct Head {
  std::unique_ptr<EmulatedDevices> emulated;  ///< the devices behind the head, if they are here
  std::shared_ptr<SensorHead> head;
  SessionMode mode = SessionMode::kSimulation;
  std::shared_ptr<MovingStand> stand = nullptr;
  std::shared_ptr<MissionArchive> archive = nullptr;  ///< of a head elsewhere
};

Result<Head> MakeRemoteHead(const Options& options) {
  Head head;
  head.archive = std::make_shared<MissionArchive>();
  FORESIGHT_TRY(const auto remote, ConnectHead(options.link, head.archive));
  head.mode = remote->Simulated() ? SessionMode::kSimulation : SessionMode::kLive;
  head.head = remote;
  return head;
}

/// The drivers of a real head, through the sockets of this computer.
Result<Head> MakeEmulatedHead(const Options& options) {
  Head head;
  FORESIGHT_TRY(head.emulated, StartEmulation(options.emulation));
  HeadConfig config = ConfigFor(*head.emulated);
  if (!options.prior.empty()) {
    FORESIGHT_TRY(config.rig, LoadSensorRig(options.prior));
  }
  head.head = MakeRealHead(config);
  head.stand = StandIn(head.emulated->world());
  return head;
}

/// In this process, without drivers.
Result<Head> MakeHeadOnScene(const Options& options) {
  SimulatedHeadOptions simulation;
  simulation.world.seed = options.emulation.seed;
  simulation.speed = options.fast ? SimulationSpeed::kAsFastAsPossible : SimulationSpeed::kRealTime;
  if (!options.emulation.rig.empty()) {
    FORESIGHT_TRY(simulation.true_rig, LoadSensorRig(options.emulation.rig));
    simulation.believed_rig = simulation.true_rig;
  }
  if (!options.prior.empty()) {
    FORESIGHT_TRY(simulation.believed_rig, LoadSensorRig(options.prior));
  }
  FORESIGHT_TRY(Scene scene, LoadScene(options.scene.empty() ? DefaultScene() : options.scene));
  const auto world = std::make_shared<const World>(std::make_shared<const Scene>(std::move(scene)),
                                                   simulation.true_rig, simulation.world);
  Head head;
  FORESIGHT_TRY(head.head, MakeSimulatedHead(world, simulation));
  head.stand = StandIn(world);
  return head;
}

Result<Head> MakeHead(const Options& options) {
  if (!options.link.head.empty()) return MakeRemoteHead(options);
  if (!options.emulation.scene.empty()) return MakeEmulatedHead(options);
  if (options.head_config.empty()) return MakeHeadOnScene(options);
  FORESIGHT_TRY(const HeadConfig config, LoadHeadConfig(options.head_config));
  return Head{nullptr, MakeRealHead(config),
              config.simulated ? SessionMode::kSimulation : SessionMode::kLive};
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
  QTranslator translation;
  if (translation.load(QLocale(), QStringLiteral("foresight"), QStringLiteral("_"),
                       QCoreApplication::applicationDirPath() + QStringLiteral("/../translations")))
    QCoreApplication::installTranslator(&translation);
  SetTranslator([](const char* english) {
    return QCoreApplication::translate("Core", english).toStdString();
  });
  auto head = MakeHead(options);
  if (!head) {
    LogError("{}", head.error().message);
    return 1;
  }
  const SessionMode mode = head->mode;
  Workbench bench(std::move(head->head), mode, head->stand);
  const QuitOnSignal quit_on_signal([&bench] { bench.head.StopForGood(); });
  QSettings settings;
  bench.recording.OfferInterrupted(RecordingViewModel::DefaultFolder(),
                                   settings.value(kLastMission).toString());
  if (!options.mission.empty())
    bench.recording.Begin(QString::fromStdString(options.mission));
  else
    bench.recording.BeginInFolder(RecordingViewModel::DefaultFolder());
  const auto archive = head->archive;
  const auto remember = [&] {
    if (archive) archive->Use(bench.recording.File());
    if (settings.value(kLastMission) == bench.recording.Path()) return;
    settings.setValue(kLastMission, bench.recording.Path());
    settings.sync();  // the program may be killed at any moment
  };
  remember();
  QObject::connect(&bench.recording, &RecordingViewModel::changed, &bench, remember);
  MainWindow window(&bench);
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
