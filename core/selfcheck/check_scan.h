#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/depth/depth_method.h"
#include "core/selfcheck/check_rig.h"
#include "core/selfcheck/depth_check.h"
#include "core/selfcheck/half_fits.h"

namespace foresight {

struct ScanCheckOptions {
  DepthOptions depth = DefaultsOf(DepthMethod::kForesight);  ///< of the map that is checked
  DepthCheckOptions depth_check;
  RigCheckOptions rig;
  HalfFitsLimits objects;
};

/// What a lamp shows, the gravest last.
enum class CheckLight { kNotSeen, kGood, kAmber, kRed };
/// "not seen", "good", "amber", "red".
const char* ToString(CheckLight light);

/// One thing that a scan says about itself.
struct CheckPoint {
  std::string name;  ///< "depth", "camera against lidar", "lidar against motor", "stamps", "camera
                     ///< and motor", "object"
  CheckLight light = CheckLight::kNotSeen;
  std::string sentence;  ///< what was measured and, unless good, what to do
};

/// What a scan says about itself.
struct ScanCheck {
  CheckLight light = CheckLight::kNotSeen;  ///< the gravest of all points
  std::string advice;                       ///< one sentence: what to do
  std::vector<CheckPoint> points;
  std::vector<std::string> cannot_see;  ///< what this scan says nothing of, a sentence each

  std::optional<DepthCheck> depth;
  std::string no_depth;  ///< why there is none
  RigCheck rig;
  std::vector<HalfFits> objects;
  double seconds = 0.0;
};

/// What the measurements mean. From a drift of so many times its limit on the light is red.
inline constexpr double kRedLimits = 3.0;
ScanCheck JudgeScan(const SensorRig& rig, const Result<DepthCheck>& depth, const RigCheck& checked,
                    const std::vector<HalfFits>& objects);

/// How far the image's edges lie from the lidar's in the middle of the image, px: to the right and
/// down. @pre check.camera
Eigen::Vector2d EdgesOff_px(const SensorRig& rig, const RigCheck& check);

/// Checks depth, calibration and objects of one scan on the scan itself, with `scan.rig`. Neither a
/// board nor a truth is needed.
/// @param cloud RegisterScan's, of this scan
/// @param frame the image whose depth map is checked, one of the scan's; nullptr = none
/// @param kept what was accepted in the scan
/// Fails with kCancelled; a scan that says nothing is no failure. Costs two depth maps, and for
/// each object two fits.
Result<ScanCheck> CheckScan(const Scan& scan, const RegisteredScan& cloud, const CameraFrame* frame,
                            const std::vector<KeptObject>& kept, const ScanCheckOptions& options,
                            const RunContext& context);

}  // namespace foresight
