#pragma once

#include <span>

#include "core/depth/pipeline.h"
#include "core/io/point_cloud_file.h"
#include "core/sensor/camera_frame.h"

namespace foresight {

/// Gives the points of a scan the colour of the image, and the confidence of its depth map, at the
/// pixel where the camera sees them. A point that the depth pipeline rejected (hidden from the
/// camera, flying, alone) or that an earlier image painted stays as it is.
/// @param points of PointsInRobot, or any with the line and beam of the depth map's scan
void PaintCloud(std::span<CloudPoint> points, const CameraFrame& frame, const DepthResult& depth);

}  // namespace foresight
