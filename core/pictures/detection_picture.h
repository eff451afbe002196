#pragma once

#include "core/base/image.h"
#include "core/detection/detection.h"
#include "core/detection/outline.h"
#include "core/pictures/projected_wireframe.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// The colour of a verdict, told apart also by the colour-blind: green, orange, grey.
Rgb8 ColorOf(VerdictLevel level);

/// Draws a detection's candidate into a picture taken at `motor_rad`: CONFIRMED solid, LIKELY
/// dashed, UNSURE thin and grey, with a dark rim so that it is seen on any ground. A region that
/// was drawn on this picture is drawn too.
void DrawDetection(ColorImage& picture, const Detection& detection, int candidate,
                   const SensorRig& rig, double motor_rad);

/// Outlines alone, in the same way.
void DrawOutlines(ColorImage& picture, const std::vector<Outline>& outlines, const SensorRig& rig,
                  double motor_rad);

/// The lines of a region in the picture at `motor_rad`: its closed polygon where it was drawn on
/// this picture (else nothing), the edges of a box.
PixelLines RegionLines(const Roi& roi, const SensorRig& rig, double motor_rad);

/// The outline of a region: its polygon where it was drawn on the picture at `motor_rad`, the edges
/// of a box.
void DrawRegion(ColorImage& picture, const Roi& roi, const SensorRig& rig, double motor_rad);

/// What a region shows of a picture, with half as much again on each side; all of it for a box.
ColorImage AroundRegion(const ColorImage& picture, const Roi& roi);

/// The twelve edges of a box, in base.
Wireframe WireframeOf(const BoxRoi& box);

}  // namespace foresight
