#pragma once

#include <string>
#include <vector>

#include "app/common/exit_code.h"
#include "core/base/run_context.h"
#include "core/depth/pipeline.h"

namespace foresight {

/// Scores depth methods on missions, which have no truth: maps of every `keep_one_in`-th line
/// against the beams of all other lines, a row a scan with an image and method. Scans without an
/// image are told on standard error. Fails with kInvalidInput where no scan has one.
Result<ExitCode> EvaluateHoldOut(const std::vector<std::string>& missions,
                                 const std::vector<DepthMethod>& methods, int keep_one_in,
                                 bool json, const RunContext& context);

}  // namespace foresight
