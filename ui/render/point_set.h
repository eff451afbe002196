#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/image.h"
#include "core/base/result.h"
#include "core/depth/upsample.h"
#include "core/detection/residuals.h"
#include "core/registration/register_scan.h"
#include "core/sensor/camera_frame.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// What the colours of a point set mean.
enum class PointColor { kHeight, kRange, kIntensity, kImage };

/// Points to draw, in the robot's frame (z up), metres, in random order: any first n of them are a
/// fair sample.
struct PointSet {
  std::vector<Eigen::Vector3f> points;
  std::vector<float> values;  ///< to be mapped to colours; empty when colors are given
  std::vector<Rgb8> colors;   ///< empty when values are given
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Zero();  ///< where they were seen from
};

/// The lidar's returns. kImage is taken as kHeight.
PointSet PointsOf(const RegisteredScan& scan, const SensorRig& rig, PointColor color);

/// Points of a region coloured by how far they are from what was fitted: blue = the template lies
/// nearer, white = they agree, orange = it lies further away, full colour at 30 mm.
PointSet PointsOf(const std::vector<Residual>& residuals, const SensorRig& rig);
inline constexpr double kFullResidual_m = 0.030;

/// Points with a value each.
PointSet PointsOf(std::vector<Eigen::Vector3f> points, std::vector<float> values,
                  const Eigen::Vector3f& viewpoint);

/// The depths that the mask keeps, every `stride`-th pixel, unprojected.
PointSet PointsOf(const DepthImage& depth_m, const MaskImage* mask, const CameraFrame& capture,
                  const SensorRig& rig, PointColor color, int stride);

}  // namespace foresight
