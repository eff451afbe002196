#pragma once

#include "app/common/exit_code.h"
#include "app/ctl/fit_arguments.h"
#include "core/base/run_context.h"

namespace foresight {

/// The fit by the head's own program in a scan that the head has, printed as that of a scan here:
/// the same numbers, and what crossed the link. The region's calibration is the one in force at the
/// head; the head refuses it for a scan with another one.
Result<ExitCode> FitAtHead(const FitArguments& arguments, const RunContext& context);

}  // namespace foresight
