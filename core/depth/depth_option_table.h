#pragma once

#include "core/depth/pipeline.h"
#include "core/options/option.h"

namespace foresight {

/// Every option of a depth map beside its method: the one list that the command line, records and
/// panels are made from. Which of them do anything depends on the method. `keep_iterations` is not
/// among them: it changes no result.
OptionTable<DepthOptions> DepthOptionTable();

/// The options as one line of JSON, the method among them, docs/formats.md; and the reverse: what
/// is missing there is the method's own. Fails with kBadData.
std::string DepthOptionsToJson(const DepthOptions& options);
Result<DepthOptions> DepthOptionsFromJson(const std::string& json);

}  // namespace foresight
