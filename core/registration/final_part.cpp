#include "core/registration/final_part.h"

namespace foresight {

bool IsFinal(const LidarLine& line, const Scan& scan) {
  // The angle of a beam is a fit through the samples around it: it is final when the track reaches
  // beyond the last one's window.
  const auto samples = scan.track.samples();
  const LidarModel& lidar = scan.rig.lidar;
  return !samples.empty() &&
         line.time_s + lidar.BeamTime(lidar.beams - 1) + MotorTrack::kWindow_s <=
             samples.back().time_s;
}

Scan FinalPart(const Scan& scan) {
  if (scan.state != ScanState::kRunning) return scan;
  Scan part = scan;
  std::size_t same = 0;  // as far as all are final, the list is shared
  while (same < scan.lines.size() && IsFinal(scan.lines[same], scan)) ++same;
  part.lines.Truncate(same);
  for (std::size_t i = same; i < scan.lines.size(); ++i)
    if (IsFinal(scan.lines[i], scan)) part.lines.push_back(scan.lines.Share(i));
  return part;
}

}  // namespace foresight
