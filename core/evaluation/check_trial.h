#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/fit_populations.h"
#include "core/selfcheck/check_scan.h"
#include "core/selfcheck/rig_damage.h"

namespace foresight {

/// None; the camera and the lidar turned by `turn_rad` about each axis; the stamps late by
/// `stamp_s`; a plate that turns by `scale` of its turn too far, and one that is off by `turn_rad`
/// six times a turn.
std::vector<RigDamage> UsualDamages(double turn_rad, double stamp_s, double scale = 0.01);

struct CheckTrialOptions {
  /// Where random scenes come from, with their noise; rigs are off as this says, whatever a world
  /// says of them.
  FitWorld world = FitWorld::kHome;
  /// Up and down at 20 deg/s from -30 to 30 deg, with three images.
  ScanPlan plan = CheckPlan();
  /// What a calibration leaves of each rig.
  CalibrationError calibration_error{.rotation_rad = 0.00087, .translation_m = 0.001};
  RigCheckOptions check;
  /// Draws the calibration's error and the damages' signs, as scans of one mission share them;
  /// none = the scan's own seed.
  std::optional<std::uint64_t> rig_seed;

  static ScanPlan CheckPlan();
};

/// The outcome of one check.
struct CheckOutcome {
  std::uint64_t seed = 0;
  std::string scene;
  std::string damage;
  double sign = 1.0;
  RigCheck check;
  double seconds = 0.0;
};

/// Pixels to which a map gives about the same confidence, masked or not, and how they are.
struct ConfidenceTruth {
  static constexpr int kClasses = 10;  ///< of 0.1 each, the last with 1

  std::int64_t pixels = 0;
  double promised = 0.0;   ///< sum of their confidence
  std::int64_t right = 0;  ///< within 50 mm or 1 %
};

/// What the check of a scan's depth says, and what is true.
struct DepthCheckOutcome {
  std::uint64_t seed = 0;
  std::string scene;
  DepthCheck check;
  /// Quantiles of |map - truth| over the pixels that the mask of the whole scan's map keeps and
  /// that the lidar could see.
  double true_q50_m = 0.0;
  double true_q80_m = 0.0;
  double true_q95_m = 0.0;
  double true_right = 0.0;  ///< fraction of these pixels within 50 mm or 1 %
  /// Of all pixels with a depth that the lidar could see.
  std::array<ConfidenceTruth, ConfidenceTruth::kClasses> confidence;
};

/// A simulated scan as the head brings it home, and the world that it was taken in.
struct CheckTrial {
  std::uint64_t seed = 0;
  World world;
  Scan scan;  ///< its rig is off as a calibration leaves it
};

/// One scan of a scene, drawn by the seed from the world's valves, drills and terrains (`scene`
/// null) or with its noise drawn by the seed.
Result<CheckTrial> MakeCheckTrial(std::shared_ptr<const Scene> scene, std::uint64_t seed,
                                  const CheckTrialOptions& options, const RunContext& context);

/// Checks the scan with a rig for each damage.
Result<std::vector<CheckOutcome>> CheckDamages(const CheckTrial& trial,
                                               const std::vector<RigDamage>& damages,
                                               const CheckTrialOptions& options,
                                               const RunContext& context);

/// Checks the depth of the scan's middle image, and compares with the truth.
Result<DepthCheckOutcome> CheckDepthOfTrial(const CheckTrial& trial, const DepthOptions& depth,
                                            const DepthCheckOptions& options,
                                            const RunContext& context);

/// MakeCheckTrial, then CheckDamages.
Result<std::vector<CheckOutcome>> RunCheckTrial(std::shared_ptr<const Scene> scene,
                                                std::uint64_t seed,
                                                const std::vector<RigDamage>& damages,
                                                const CheckTrialOptions& options,
                                                const RunContext& context);

}  // namespace foresight
