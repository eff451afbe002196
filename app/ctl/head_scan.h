#pragma once

#include <string>

#include "core/base/result.h"
#include "hardware/api/head_link.h"

namespace foresight {

/// The id of the head's scan whose id begins with `wanted`; empty = of the newest. Fails with
/// kInvalidInput where there is none, or more than one.
Result<std::string> ChooseScanOfHead(const HeadLink& head, const std::string& address,
                                     const std::string& wanted);

}  // namespace foresight
