#pragma once

#include <stdexcept>

#include "core/simulation/simulate_scan.h"

namespace foresight::samples {

/// A sweep of a simulated head at constant speed, with one sharp image at `image_rad`.
inline Scan SweepWorld(const World& world, double from_rad, double to_rad, double speed_rad_s,
                       double image_rad) {
  ScanPlan plan;
  plan.from_rad = from_rad;
  plan.to_rad = to_rad;
  plan.speed_rad_s = speed_rad_s;
  plan.image_angles_rad = {image_rad};
  auto scan = SimulateSweep(world, plan, {});
  if (!scan) throw std::runtime_error(scan.error().message);
  const auto still = [=](double) { return image_rad; };
  scan->frames.push_back(world.CaptureImage(0, 0.0, 0.004, 0.0, still, {}));
  return std::move(*scan);
}

}  // namespace foresight::samples
