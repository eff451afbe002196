#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "app/ctl/fit_arguments.h"
#include "core/detection/outline.h"
#include "core/registration/recover_grid.h"
#include "core/registration/register_scan.h"

namespace foresight {

/// What a fit is made in: a scan of a mission, a depth map, or a point cloud.
struct FitSubject {
  SensorRig rig;
  double motor_rad = 0.0;  ///< of the image that regions are drawn on
  Roi roi;

  std::optional<OpenedScan> scan;
  RegisteredScan cloud;                 ///< of the scan
  DepthImage depth_m;                   ///< of a depth map
  std::vector<Eigen::Vector3d> points;  ///< of a point cloud, in base
  GridPlaces places;                    ///< of its points, on the grid they were measured on
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
};

/// A detection, with the depth map that it was made on where there is one.
struct FitAnswer {
  Result<Detection> detection;
  std::optional<DepthResult> depth;
};

/// Reads what the arguments name. Fails with kBadData, kIo, and kInvalidOptions for a region that
/// is none.
Result<FitSubject> OpenFitSubject(const FitArguments& arguments, const RunContext& context);

/// What a --source stands for.
FitSource FitSourceOf(const std::string& source);
/// How the depth map of a --source is made. Fails as DepthOptionsFrom does.
Result<DepthOptions> DepthOptionsFor(const FitArguments& arguments, const std::string& source);

/// Fits to one source; a scan's depth map is made by its method.
FitAnswer FitIn(const FitSubject& subject, const FitArguments& arguments, const std::string& source,
                const RunContext& context);

/// There is an answer, and it is no: whoever reads JSON wants it as JSON.
bool IsNegative(const Error& error);

/// The answer drawn into what was looked at: the camera's image, the depth map in colours, or
/// the cloud as seen from its viewpoint.
ColorImage PictureOf(const FitSubject& subject, const Detection& detection);
ColorImage PictureOf(const FitSubject& subject, const std::vector<Outline>& outlines);

}  // namespace foresight
