#pragma once

#include <vector>

#include "core/base/image.h"
#include "core/detection/detection.h"
#include "core/pictures/legend.h"
#include "core/registration/register_scan.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// From where a scan's cloud is looked at, in the robot's frame.
enum class CloudSide { kAbove, kAside };

/// A cloud in colours of its height with the outlines of what was found, and what the colours mean.
/// From above the forward direction is up, and returns higher than half a metre over the head are
/// left out: they would be a ceiling. From aside one looks from the robot's right.
ColorImage PaintScanCloud(const RegisteredScan& cloud, const SensorRig& rig,
                          const std::vector<Detection>& objects, CloudSide side);

/// The image with the best answer of every object.
ColorImage PaintObjects(ColorImage image, const std::vector<Detection>& objects,
                        const SensorRig& rig, double motor_rad);

}  // namespace foresight
