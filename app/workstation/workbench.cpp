#include "app/workstation/workbench.h"

namespace foresight {

Workbench::Workbench(std::shared_ptr<SensorHead> sensor_head, SessionMode mode)
    : session(mode),
      head(std::move(sensor_head)),
      depth(&session),
      compare(&session, &depth),
      fit(&session),
      gallery(&session, &fit),
      mission(&session),
      exporter(&session),
      flow(&head, &session, mode),
      live(&head, &session) {
  head.SetRecorderSource([this] { return mission.Recorder(); });
  QObject::connect(&head, &HeadViewModel::scanEnded, &mission, &MissionViewModel::keepScan);
  QObject::connect(&fit, &FitViewModel::objectFound, &mission, &MissionViewModel::keepObject);
}

bool Workbench::Idle() {
  return !head.Scanning() && !depth.Runner()->Busy() && !compare.Runner()->Busy() &&
         !fit.Runner()->Busy() && !gallery.Runner()->Busy() && !mission.Runner()->Busy() &&
         !exporter.Runner()->Busy();
}

}  // namespace foresight
