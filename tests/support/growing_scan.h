#pragma once

#include <memory>
#include <stdexcept>
#include <vector>

#include "core/geometry/angles.h"
#include "core/registration/register_scan.h"
#include "core/simulation/scene.h"
#include "tests/support/valve_scan.h"

namespace foresight::samples {

/// The default head with an image of another size, and the same view.
inline SensorRig RigWithImage(int width, int height) {
  SensorRig rig = DefaultSensorRig();
  const double scale = static_cast<double>(width) / rig.camera.width;
  rig.camera.width = width;
  rig.camera.height = height;
  rig.camera.fx *= scale;
  rig.camera.fy *= scale;
  rig.camera.cx = (width - 1) / 2.0;
  rig.camera.cy = (height - 1) / 2.0;
  return rig;
}

/// A sweep of 60 deg over the room with an image at 0 deg.
inline Scan SweepOverRoom(const SensorRig& rig, double speed_rad_s) {
  auto scene = LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml");
  if (!scene) throw std::runtime_error(scene.error().message);
  const World world(std::make_shared<const Scene>(std::move(*scene)), rig, {});
  return SweepWorld(world, RadiansFromDegrees(-30.0), RadiansFromDegrees(30.0), speed_rad_s, 0.0);
}

/// What was known of a scan when its `lines`-th line had just come: the motor's track ends with it,
/// so that the angles at its last beams change a little when more is known.
inline RegisteredScan RegisteredAfter(const Scan& scan, int lines) {
  Scan part = scan;
  part.frames.clear();
  part.lines.Truncate(static_cast<std::size_t>(lines));
  std::vector<MotorSample> samples;
  for (const MotorSample& sample : scan.track.samples())
    if (sample.time_s <= part.lines.back().time_s + scan.rig.lidar.period_s)
      samples.push_back(sample);
  part.track = *MotorTrack::FromSamples(std::move(samples));
  auto registered = RegisterScan(part, {});
  if (!registered) throw std::runtime_error(registered.error().message);
  return std::move(*registered);
}

}  // namespace foresight::samples
