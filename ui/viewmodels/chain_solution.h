#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/run_context.h"
#include "core/calibration/chain_residuals.h"
#include "core/calibration/intrinsics.h"
#include "core/calibration/stand_coverage.h"
#include "ui/viewmodels/calibration_check.h"

namespace foresight {

/// A calibration of the chain with what is shown of it; made in a worker thread.
struct ChainSolution {
  ChainCalibration found;
  StandCoverage coverage;
  std::vector<BoardFit> boards;
  std::vector<LidarImagePoint> points;
  std::map<std::string, double> rms_px;  ///< by the image's file
  std::vector<ImageErrors> errors;       ///< of all corners, for the map of residuals
};

/// CalibrateChain as `foresightctl calibrate` calls it.
Result<ChainSolution> SolveSession(const CalibrationSession& session, CalibrationStage stage,
                                   const RunContext& context);

/// What was found against limits, in words.
std::vector<CalibrationCheck> JudgeSolution(const ChainSolution& solution,
                                            const CalibrationSession& session);

}  // namespace foresight
