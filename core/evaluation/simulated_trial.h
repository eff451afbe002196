#pragma once

#include <cstdint>
#include <memory>

#include "core/evaluation/method_score.h"
#include "core/geometry/angles.h"
#include "core/sensor/scan_plan.h"
#include "core/simulation/world.h"

namespace foresight {

/// How far a believed calibration is from the true head: a turn about and a shift along directions
/// drawn at random, of exactly these sizes.
struct CalibrationError {
  double rotation_rad = RadiansFromDegrees(0.1);  ///< one pixel of the default camera
  double translation_m = 0.003;

  Status Check() const;
};

/// The rig that a calibration with such an error would hold: `true_rig` with another
/// camera_from_lidar. The seed draws the directions.
SensorRig MiscalibratedRig(const SensorRig& true_rig, const CalibrationError& error,
                           std::uint64_t seed);

/// -40 to 20 deg at 10 deg/s, one image at -10 deg: the objects of the shipped scenes are in
/// view.
ScanPlan SimulatedTrialPlan();

struct SimulatedTrialOptions {
  ScanPlan plan = SimulatedTrialPlan();  ///< upwards; only its first image is used
  WorldOptions world;                    ///< its seed draws the calibration's error too
  SensorRig true_rig = DefaultSensorRig();
  CalibrationError calibration_error;

  Status Check() const;
};

/// A scene as the head brings it home: a scan registered with the believed rig, and the truth.
struct SimulatedTrial {
  std::string scene;
  SensorRig rig;  ///< the believed one
  RegisteredScan cloud;
  CameraFrame frame;
  /// z in the true camera, at its true place when the image was taken. NaN where the lidar could
  /// not see the surface during the sweep, or where there is none.
  DepthImage truth_m;
};

/// z in the true camera at the pixels of the image at `image_rad` that the lidar could see during
/// the plan's upward sweep, NaN at the others. Fails with kCancelled.
Result<DepthImage> TruthSeenByLidar(const World& world, double image_rad, const ScanPlan& plan,
                                    const RunContext& context);

/// Simulates the scan once; methods are then run on it with EvaluateOnTrial.
Result<SimulatedTrial> MakeSimulatedTrial(std::shared_ptr<const Scene> scene,
                                          const SimulatedTrialOptions& options,
                                          const RunContext& context);

/// Runs the depth pipeline on a trial and scores every pixel. What the calibration's error moves is
/// part of the score.
Result<ScoredDepth> RunOnTrial(const SimulatedTrial& trial, const DepthOptions& options,
                               const RunContext& context);

/// The same, the score alone.
Result<MethodScore> EvaluateOnTrial(const SimulatedTrial& trial, const DepthOptions& options,
                                    const RunContext& context);

}  // namespace foresight
