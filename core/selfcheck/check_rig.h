#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/selfcheck/camera_check.h"
#include "core/selfcheck/pass_check.h"
#include "core/selfcheck/plate_check.h"
#include "core/selfcheck/turn_check.h"

namespace foresight {

/// From where on a measured drift counts, docs/calibration_check.md.
struct RigCheckLimits {
  double camera_turn_rad = 0.0035;  ///< 0.2 deg, 2 px of the usual camera
  /// About the motor's axis, 0.3 deg: edges between beams run along the motor's way, so the image
  /// says less there.
  double camera_turn_along_motor_rad = 0.0052;
  double lidar_turn_rad = 0.0035;       ///< 0.2 deg, 10 mm at 3 m
  double stamp_turn_rad = 0.0021;       ///< 0.12 deg between the ways up and down
  double camera_on_plate_rad = 0.0035;  ///< 0.2 deg
  double motor_scale = 0.005;           ///< 0.15 deg in a scope of 30 deg
  double motor_bend_rad = 0.0026;       ///< 0.15 deg
  double sigmas = 3.0;                  ///< a drift is at least so many deviations
  double least_gain_sigmas = 2.0;       ///< and fits the images better by so many
  /// And by this part of what edges stand out, over the root of the scans gathered: beside an
  /// outline there often is another edge, a shade or the thing's other side, that fits a little
  /// better, but not the same way in each scan.
  double least_gain_of_contrast = 0.07;
  double seen_sigmas = 2.5;  ///< a limit of fewer deviations is not seen
};

struct RigCheckOptions {
  PlateCheckOptions plate;
  CameraCheckOptions camera;
  TurnCheckOptions turns;
  PassCheckOptions passes;
  RigCheckLimits limits;
};

/// One direction in which a head can drift.
struct RigFinding {
  enum class State { kFine, kDrifted, kNotSeen };

  std::string name;      ///< "camera turn x", as JSON has it
  std::string in_words;  ///< "the camera against the lidar, about the camera's x axis"
  std::string unit;      ///< "rad", "m", "s", "px", or "1" of a ratio
  double value = 0.0;    ///< in the unit; NaN where nothing was measured
  double sigma = 0.0;
  double limit = 0.0;
  State state = State::kNotSeen;
};

/// "camera against lidar, about the camera's y axis: off by 0.31 deg +- 0.02 deg, the limit is 0.20
/// deg".
std::string InWords(const RigFinding& finding);

/// How well a rig fits a scan that was just taken with it.
struct RigCheck {
  std::optional<PlateCheck> plate;
  std::string no_plate;  ///< why there is none
  std::optional<CameraCheck> camera;
  std::string no_camera;
  std::optional<TurnCheck> turns;
  std::string no_turns;
  std::optional<PassCheck> passes;
  std::string no_passes;
  std::vector<RigFinding> findings;
  std::vector<std::string> drifted;     ///< what and by how much, a sentence each; empty = fine
  std::vector<std::string> cannot_see;  ///< what this scan says nothing of, a sentence each

  bool Drifted() const { return !drifted.empty(); }
  bool SawAnything() const;
};

/// What the measurements mean. Each may be missing, with the reason.
RigCheck JudgeRig(const SensorRig& rig, const Result<PlateCheck>& plate,
                  const Result<CameraCheck>& camera, const Result<TurnCheck>& turns,
                  const Result<PassCheck>& passes, const RigCheckLimits& limits);

/// Rates `scan.rig` on the scan itself: camera against lidar by image and depth edges, lidar
/// against the motor by planes, the lidar's stamps against the encoder's by surfaces seen on the
/// way up and down, camera against the motor and the motor's way by images at several angles. Needs
/// no board and no truth. Of an imported scan only the edges are looked at. Fails as RegisterScan
/// does, and with kCancelled; a scan that says nothing is no failure.
Result<RigCheck> CheckRig(const Scan& scan, const RigCheckOptions& options,
                          const RunContext& context);
/// The same of a scan that was registered with its rig.
Result<RigCheck> CheckRig(const Scan& scan, const RegisteredScan& cloud,
                          const RigCheckOptions& options, const RunContext& context);

/// "fine", "drifted", "not seen".
const char* ToString(RigFinding::State state);

}  // namespace foresight
