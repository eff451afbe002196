#include "ui/views/templates_in_picture.h"

#include <iterator>

namespace foresight {
namespace {

template <class Lines>
void Append(Lines* all, Lines more) {
  all->insert(all->end(), std::make_move_iterator(more.begin()),
              std::make_move_iterator(more.end()));
}

}  // namespace

PixelLines TemplatesInPicture(const SessionModel& session) {
  PixelLines all;
  const CameraFrame* picture = session.Picture();
  if (picture == nullptr) return all;
  for (const FoundValve& valve : session.Valves())
    if (session.IsCurrent(valve))
      Append(&all, ProjectValve(valve.detection.best, valve.rig, picture->motor_angle_rad));
  return all;
}

Wireframe TemplatesInRobot(const SessionModel& session) {
  Wireframe all;
  for (const FoundValve& valve : session.Valves())
    if (session.IsCurrent(valve)) Append(&all, ValveInRobot(valve.detection.best, valve.rig));
  return all;
}

}  // namespace foresight
