#pragma once

#include "core/base/run_context.h"
#include "core/calibration/chain_problem.h"

namespace foresight {

struct MotorCalibrationOptions {
  ChainNoise noise;
  /// The paper's Section III-B as printed: board B stands as drawn, a stop has one angle for all
  /// poses (no repeatability), and the result is in the paper's gauge.
  bool as_in_the_paper = false;
  /// What happens to stops that the images do not tie to the reference.
  enum class LooseStops { kRefuse, kLeaveOut } loose_stops = LooseStops::kRefuse;
  /// How far a plate's angle may lie from the commanded one.
  double most_angle_error_rad = 0.0349;  ///< 2 deg
  /// How far the axis may lie from the CAD's.
  double most_axis_error_rad = 0.35;  ///< 20 deg

  Status Check() const;
};

/// How well the corners of one image fit.
struct ImageFit {
  std::string source;
  int corners = 0;
  double rms_px = 0.0;
  double mean_px = 0.0;
};

/// Camera, motor and poses of the stand; the camera's own parameters are as they were given.
struct MotorCalibration {
  ChainState state;  ///< the lidar as in the session's prior
  ChainData data;    ///< corners of the stand
  ChainFit fit;
  std::vector<ImageFit> images;
  double mean_error_px = 0.0;  ///< mean distance between corners and their images
  std::vector<std::string> notes;
};

/// Where the motor's axis is and how far each stop turns the plate, Eq. (4)-(5): 12 unknown angles
/// but for A_0 = 0, camera_from_head without turn and shift along the axis (they are those of the
/// session's prior), one pose of the stand after the other. Needs no start but the sign of the
/// commanded angles.
///
/// Fails with kInvalidInput, saying in words what to do, where a stop is seen in no image or tied
/// to no other, boards are exchanged or mirrored, the stand moved, or the plate does not turn as
/// commanded: nothing that the images leave open is solved silently. Under a second.
Result<MotorCalibration> CalibrateMotor(const CalibrationSession& session,
                                        const CameraModel& camera,
                                        const MotorCalibrationOptions& options,
                                        const RunContext& context);

/// The same axis with the paper's choice of gauge: no turn (rotation vector) and no shift along the
/// camera's x. Fails with kInvalidInput where the axis is across the camera's x: there the paper's
/// gauge does not exist.
Result<Rigid<frame::Camera, frame::Head>> InPaperGauge(
    const Rigid<frame::Camera, frame::Head>& camera_from_head);

/// Root mean square and mean of the corners' distances, an image each.
std::vector<ImageFit> FitsOfImages(const ChainState& state, const std::vector<CornerSet>& corners);

}  // namespace foresight
