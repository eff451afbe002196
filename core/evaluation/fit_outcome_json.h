#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// One outcome as one line of JSON without its line end. Of the verdict level, probability,
/// features and failed gates are kept; numbers survive the round trip, NaN as null.
std::string FitOutcomeToJson(const FitOutcome& outcome);

/// The reverse; fails with kBadData.
Result<FitOutcome> FitOutcomeFromJson(std::string_view line);

/// A file with an outcome a line. A last line without its end, as a run that was cut leaves it, is
/// not read. Fails with kIo and kBadData, naming the line.
Result<std::vector<FitOutcome>> LoadFitOutcomes(const std::filesystem::path& path);

}  // namespace foresight
