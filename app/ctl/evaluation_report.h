#pragma once

#include <optional>
#include <vector>

#include "core/evaluation/method_score.h"
#include "core/evaluation/simulated_trial.h"

namespace foresight {

/// A score and what it was measured with.
struct EvaluationRow {
  MethodScore score;
  /// The method's own depth, whatever it masks, where Foresight's mask keeps Foresight's: methods
  /// at one coverage. None where Foresight was not among the methods.
  std::optional<DepthAccuracy> in_foresight_mask;
  std::optional<CalibrationError> calibration_error;  ///< of simulated scenes
};

/// Prints the rows as a JSON list, or as a table that ends with the calibration's error.
void PrintEvaluation(const std::vector<EvaluationRow>& rows, bool as_json);

}  // namespace foresight
