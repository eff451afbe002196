#pragma once

#include <memory>
#include <string>

#include "app/common/emulation.h"
#include "app/common/link_arguments.h"
#include "hardware/api/moving_stand.h"
#include "hardware/api/sensor_head.h"
#include "hardware/link/client/mission_archive.h"
#include "ui/viewmodels/session_model.h"

namespace foresight {

/// Which head the window is for.
struct HeadChoice {
  std::string scene;             ///< empty: the valve scene that comes with the program
  EmulationArguments emulation;  ///< its scene, rig and seed; rig and seed are the simulation's too
  std::string prior;             ///< what the simulated or emulated head believes of itself
  std::string head_config;       ///< of a real head, in place of a scene
  LinkArguments link;            ///< to a head elsewhere
  bool fast = false;
};

struct OpenedHead {
  std::unique_ptr<EmulatedDevices> emulated;  ///< the devices behind the head, if they are here
  std::shared_ptr<SensorHead> head;
  SessionMode mode = SessionMode::kSimulation;
  std::shared_ptr<MovingStand> stand = nullptr;
  std::shared_ptr<MissionArchive> archive = nullptr;  ///< of a head elsewhere
};

/// Fails as the files of the choice and the head's devices or the link do.
Result<OpenedHead> OpenHead(const HeadChoice& choice);
/// The head at the far end of a link alone; takes up to 15 s.
Result<OpenedHead> OpenRemoteHead(const LinkArguments& link);

}  // namespace foresight
