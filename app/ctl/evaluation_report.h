#pragma once

#include <optional>
#include <vector>

#include "core/evaluation/method_score.h"
#include "core/evaluation/simulated_trial.h"

namespace foresight {

/// A score and what it was measured with.
struct EvaluationRow {
  MethodScore score;
  std::optional<CalibrationError> calibration_error;  ///< of simulated scenes
};

/// Prints the rows as a JSON list, or as a table that ends with the calibration's error.
void PrintEvaluation(const std::vector<EvaluationRow>& rows, bool as_json);

}  // namespace foresight
