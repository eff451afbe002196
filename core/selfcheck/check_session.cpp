#include "core/selfcheck/check_session.h"

#include <cmath>

#include "core/calibration/calibrate_chain.h"
#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

using State = RigFinding::State;

class Comparison {
 public:
  Comparison(const ChainCalibration& fresh, const SensorRig& rig, const SessionCheckLimits& limits)
      : fresh_(fresh), rig_(rig), limits_(limits) {}

  std::vector<RigFinding> Make() {
    AddCamera();
    AddAxis();
    AddAngles();
    if (fresh_.ranges.count > 0) AddLidar();
    return std::move(findings_);
  }

 private:
  /// A difference of the unknown that the covariance calls `unknown`.
  void Add(const std::string& unknown, const std::string& in_words, double value, double limit) {
    const int at = fresh_.covariance->Find(unknown);
    if (at < 0) return;
    RigFinding finding{.name = unknown,
                       .in_words = in_words,
                       .unit = fresh_.covariance->unknowns[static_cast<std::size_t>(at)].unit,
                       .value = value,
                       .sigma = fresh_.covariance->Sigma(at),
                       .limit = limit};
    const double size = std::abs(value);
    finding.state = !(finding.sigma * limits_.seen_sigmas < limit)          ? State::kNotSeen
                    : size > limit && size > limits_.sigmas * finding.sigma ? State::kDrifted
                                                                            : State::kFine;
    findings_.push_back(std::move(finding));
  }

  void AddCamera() {
    const double error = fresh_.mean_error_px;
    findings_.push_back({.name = "corners",
                         .in_words = "corners as the rig's camera has them, in the mean",
                         .unit = "px",
                         .value = error,
                         .sigma = error / std::sqrt(std::max(1, fresh_.corners.count)),
                         .limit = limits_.corner_px,
                         .state = error > limits_.corner_px ? State::kDrifted : State::kFine});
  }

  void AddAxis() {
    // In the old head's axes the new axis is (1, turn z, -turn y).
    const Eigen::Vector3d axis = rig_.camera_from_head.Inverse().Rotate(
        fresh_.rig.camera_from_head.Rotate(Eigen::Vector3d::UnitX()));
    const Eigen::Vector3d off =
        rig_.camera_from_head.Inverse() * fresh_.rig.camera_from_head.translation();
    Add("axis turn y", "the motor's axis, about the head's y axis", -axis.z(), limits_.turn_rad);
    Add("axis turn z", "the motor's axis, about the head's z axis", axis.y(), limits_.turn_rad);
    Add("axis shift y", "the motor's axis, along the head's y axis", off.y(), limits_.shift_m);
    Add("axis shift z", "the motor's axis, along the head's z axis", off.z(), limits_.shift_m);
  }

  void AddAngles() {
    const double zero = rig_.angle_correction.PlateAngle(0.0);
    for (const auto& knot : fresh_.rig.angle_correction.knots()) {
      const double degrees = DegreesFromRadians(knot.motor_rad);
      Add(fmt::format("plate angle at {:.6g} deg", degrees),
          fmt::format("the plate's angle at {:.6g} deg", degrees),
          knot.plate_rad - (rig_.angle_correction.PlateAngle(knot.motor_rad) - zero),
          limits_.turn_rad);
    }
  }

  void AddLidar() {
    const auto step = StepBetween(rig_.camera_from_lidar, fresh_.rig.camera_from_lidar);
    for (int axis = 0; axis < 3; ++axis) {
      const char name = "xyz"[axis];
      Add(fmt::format("lidar turn {}", name),
          fmt::format("the lidar against the camera, about the lidar's {} axis", name), step[axis],
          limits_.turn_rad);
      Add(fmt::format("lidar shift {}", name),
          fmt::format("the lidar against the camera, along the lidar's {} axis", name),
          step[3 + axis], limits_.shift_m);
    }
    Add("range offset", "the lidar's ranges",
        fresh_.rig.lidar.range_offset_m - rig_.lidar.range_offset_m, limits_.range_m);
    Add("stamp offset", "the lidar's stamps against the encoder's",
        fresh_.rig.lidar.stamp_offset_s - rig_.lidar.stamp_offset_s, limits_.stamp_s);
  }

  const ChainCalibration& fresh_;
  const SensorRig& rig_;
  const SessionCheckLimits& limits_;
  std::vector<RigFinding> findings_;
};

}  // namespace

Result<SessionCheck> CheckSession(CalibrationSession session, const SensorRig& rig,
                                  const SessionCheckLimits& limits, const RunContext& context) {
  session.prior = rig;
  session.intrinsic_views.clear();  // with them the camera would be found afresh
  ChainCalibrationOptions options;
  options.noise_from_residuals = true;
  FORESIGHT_TRY(const ChainCalibration fresh, CalibrateChain(session, options, context));
  SessionCheck check;
  check.mean_error_px = fresh.mean_error_px;
  check.range_rms_m = fresh.ranges.rms;
  check.notes = fresh.notes;
  check.findings = Comparison(fresh, rig, limits).Make();
  for (const RigFinding& finding : check.findings)
    if (finding.state == State::kDrifted) check.drifted.push_back(InWords(finding));
  return check;
}

}  // namespace foresight
