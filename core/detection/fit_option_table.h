#pragma once

#include "core/detection/fit_in_scan.h"
#include "core/options/option.h"

namespace foresight {

/// Every option of a fit of this kind: the one list that the command line, records and panels are
/// made from. An option without a flag is not typed: the scan's rig decides it.
OptionTable<FitOptions> FitOptionTable(ObjectKind kind);

/// The kind that the options look for.
ObjectKind ObjectKindOf(const FitOptions& options);

/// The options as one line of JSON, docs/formats.md; and the reverse: what is missing there is the
/// kind's default for a level head. Fails with kBadData.
std::string FitOptionsToJson(const FitOptions& options);
Result<FitOptions> FitOptionsFromJson(ObjectKind kind, const std::string& json);

}  // namespace foresight
