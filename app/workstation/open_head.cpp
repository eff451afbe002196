#include "app/workstation/open_head.h"

#include <QCoreApplication>
#include <QDir>
#include <QFile>

#include "app/common/connect_head.h"
#include "app/common/simulated_stand.h"
#include "hardware/assembly/real_head.h"
#include "hardware/link/client/remote_head.h"
#include "hardware/simulated/simulated_head.h"

namespace foresight {
namespace {

/// The scene beside the installed program, else the one in the source tree.
std::string DefaultScene() {
  const QDir program(QCoreApplication::applicationDirPath());
  const QString installed =
      program.filePath(QStringLiteral("../share/foresight/scenes/valve.yaml"));
  return QFile::exists(installed) ? installed.toStdString()
                                  : FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml";
}

/// The drivers of a real head, through the sockets of this computer.
Result<OpenedHead> MakeEmulatedHead(const HeadChoice& choice) {
  OpenedHead head;
  FORESIGHT_TRY(head.emulated, StartEmulation(choice.emulation));
  HeadConfig config = ConfigFor(*head.emulated);
  if (!choice.prior.empty()) {
    FORESIGHT_TRY(config.rig, LoadSensorRig(choice.prior));
  }
  head.head = MakeRealHead(config);
  head.stand = StandIn(head.emulated->world());
  return head;
}

/// In this process, without drivers.
Result<OpenedHead> MakeHeadOnScene(const HeadChoice& choice) {
  SimulatedHeadOptions simulation;
  simulation.world.seed = choice.emulation.seed;
  simulation.speed = choice.fast ? SimulationSpeed::kAsFastAsPossible : SimulationSpeed::kRealTime;
  if (!choice.emulation.rig.empty()) {
    FORESIGHT_TRY(simulation.true_rig, LoadSensorRig(choice.emulation.rig));
    simulation.believed_rig = simulation.true_rig;
  }
  if (!choice.prior.empty()) {
    FORESIGHT_TRY(simulation.believed_rig, LoadSensorRig(choice.prior));
  }
  FORESIGHT_TRY(Scene scene, LoadScene(choice.scene.empty() ? DefaultScene() : choice.scene));
  const auto world = std::make_shared<const World>(std::make_shared<const Scene>(std::move(scene)),
                                                   simulation.true_rig, simulation.world);
  OpenedHead head;
  FORESIGHT_TRY(head.head, MakeSimulatedHead(world, simulation));
  head.stand = StandIn(world);
  return head;
}

}  // namespace

Result<OpenedHead> OpenRemoteHead(const LinkArguments& link) {
  OpenedHead head;
  head.archive = std::make_shared<MissionArchive>();
  FORESIGHT_TRY(const auto remote, ConnectHead(link, HeadUse::kOperate, head.archive));
  head.stand = remote->Stand();
  head.mode = remote->Simulated() ? SessionMode::kSimulation : SessionMode::kLive;
  head.head = remote;
  return head;
}

Result<OpenedHead> OpenHead(const HeadChoice& choice) {
  if (!choice.link.head.empty()) return OpenRemoteHead(choice.link);
  if (!choice.emulation.scene.empty()) return MakeEmulatedHead(choice);
  if (choice.head_config.empty()) return MakeHeadOnScene(choice);
  FORESIGHT_TRY(const HeadConfig config, LoadHeadConfig(choice.head_config));
  return OpenedHead{nullptr, MakeRealHead(config),
                    config.simulated ? SessionMode::kSimulation : SessionMode::kLive};
}

}  // namespace foresight
